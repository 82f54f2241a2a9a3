/* parameters.c: see parameters.h. */
#include "render/parameters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const HEURISTICS[] = {"balance", "power", NULL};
static const char *const STRATEGIES[] = {"spatial", "power", "uniform", NULL};

enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */

static bool is_of_file(const struct setting *item) { return strcmp(item->origin, "-P") != 0; }

/* What all integrators have: names and types. */
static const char *const COMMON[][2] = {
    {"maxdepth", "integer"}, {"heuristic", "string"}, {"rrthreshold", "float"}, {"lightsamplestrategy", "string"}};
enum { N_COMMON = sizeof COMMON / sizeof COMMON[0] };

/* The first of these integrators that has such a parameter, or NULL; *type, unless NULL, is the parameter's. */
static const struct integrator *owner(const struct integrator *const *m, const char *name, const char **type)
{
    const char *unwanted;
    type = type != NULL ? type : &unwanted;
    for (int i = 0; i < N_COMMON; i++)
        if (strcmp(COMMON[i][0], name) == 0) {
            *type = COMMON[i][1];
            return *m;
        }
    for (; *m != NULL; m++)
        for (const struct setting_help *p = (*m)->parameters; p->name != NULL; p++)
            if (strcmp(p->name, name) == 0) {
                *type = p->type;
                return *m;
            }
    return NULL;
}

/* --- adapting ---------------------------------------------------------------------------------------- */

static void warn(const struct message_sink *sink, const struct setting *item, const char *text)
{
    struct error line;
    error_set(&line, "%s: \"%s\" %s", item->origin, item->name, text);
    if (sink != NULL && sink->warn != NULL)
        sink->warn(sink->context, line.text);
}

/* Parameters of pbrt-v3's integrators that choose what to show, and what does so here; NULL: none of them. */
static const char *other_way(const char *name)
{
    static const char *const WAYS[][2] = {
        {"pixelbounds", "is not used: the whole picture is rendered; --cropwindow renders a part of it"},
        {"visualizestrategies", "is not used; --strategies DIR writes a picture of every strategy"},
        {"visualizeweights", "is not used; --strategies DIR writes a picture of every strategy"}};
    for (size_t i = 0; i < sizeof WAYS / sizeof WAYS[0]; i++)
        if (strcmp(WAYS[i][0], name) == 0)
            return WAYS[i][1];
    return NULL;
}

static void replace(struct settings *s, const struct setting *item, const char *value)
{
    char *name = mem_copy_text(item->name), *origin = mem_copy_text(item->origin);
    settings_set(s, name, value, origin);
    free(name);
    free(origin);
}

/* Lights picked uniformly give the same picture with more noise, so "uniform" becomes "power"; of what it does not know
 * pbrt-v3 makes "spatial". */
static void adapt_strategy(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    int which;
    bool known = settings_choice(s, item->name, 0, STRATEGIES, &which, NULL);
    if ((known && which < 2) || (!known && !is_of_file(item)))
        return;
    warn(sink, item, known ? "is \"power\" instead of \"uniform\", which only has more noise"
                           : "is \"spatial\": its value is unknown");
    replace(s, item, STRATEGIES[known ? 1 : 0]);
}

/* pbrt-v3 has no limit. */
static void adapt_depth(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char text[64];
    if (!is_of_file(item) || !(strtod(item->value, NULL) > PATH_MAX_DEPTH))
        return;
    snprintf(text, sizeof text, "is cut to %d, the longest path here", PATH_MAX_DEPTH);
    warn(sink, item, text);
    snprintf(text, sizeof text, "%d", PATH_MAX_DEPTH);
    replace(s, item, text);
}

/* As of all parameters in a file, with the wrong type or number of values the default counts. True, with a warning, if
 * it is to be taken out. */
static bool mistyped(const struct setting *item, const struct message_sink *sink)
{
    const char *type;
    char text[96];
    if (item->type == NULL || owner(integrator_list(), item->name, &type) == NULL)
        return false;
    if (strcmp(item->type, type) != 0)
        snprintf(text, sizeof text, "cannot be of type \"%s\", so it is not used", item->type);
    else if (item->n_values != 1)
        snprintf(text, sizeof text, "wants 1 value, not %d; it is passed over", item->n_values);
    else
        return false;
    warn(sink, item, text);
    return true;
}

/* Whole numbers are cut; those that no parameter's range reaches stay as they are. */
static void adapt_integer(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char text[96];
    if (item->type == NULL || strcmp(item->type, "integer") != 0 || item->n_values != 1)
        return;
    double number = strtod(item->value, NULL), whole = trunc(number);
    if (whole == number || fabs(number) > 1e15)
        return;
    snprintf(text, sizeof text, "is %.12g, which counts as %.12g", number, whole);
    warn(sink, item, text);
    snprintf(text, sizeof text, "%.0f", whole + 0.0);
    replace(s, item, text);
}

/* A parameter that nobody reads. One of the integrator that the file names is right there: --integrator may have
 * replaced it. True, with a warning, if it is to be taken out. */
static bool unread(const struct scene *scene, const struct setting *item, const struct integrator *const *readers,
                   const struct message_sink *sink)
{
    const struct integrator *own[] = {scene->integrator != NULL ? integrator_find(scene->integrator) : NULL, NULL};
    const struct integrator *has = owner(integrator_list(), item->name, NULL);
    char text[128];
    if (!is_of_file(item) || owner(readers, item->name, NULL) != NULL || owner(own, item->name, NULL) != NULL)
        return false;
    snprintf(text, sizeof text, "is not used: it is a parameter of %s", has != NULL ? has->name : "");
    warn(sink, item, has != NULL ? text : "is not used: no integrator here has such a parameter");
    return true;
}

/* True if the parameter is to be taken out. */
static bool adapt(struct scene *scene, const struct setting *item, const struct integrator *const *readers,
                  const struct message_sink *sink)
{
    const char *way = other_way(item->name);
    if (mistyped(item, sink))
        return true;
    if (way != NULL) {
        if (strcmp(item->value, "false") != 0)
            warn(sink, item, way);
        return true;
    }
    adapt_integer(&scene->settings, item, sink);
    if (strcmp(item->name, "lightsamplestrategy") == 0)
        adapt_strategy(&scene->settings, item, sink);
    else if (strcmp(item->name, "maxdepth") == 0)
        adapt_depth(&scene->settings, item, sink);
    else
        return unread(scene, item, readers, sink);
    return false;
}

void parameters_adapt(struct scene *scene, const struct integrator *const *readers, const struct message_sink *sink)
{
    for (int i = 0; i < scene->settings.n;)
        if (adapt(scene, &scene->settings.item[i], readers, sink))
            settings_remove(&scene->settings, i);
        else
            i++;
}

/* --- reading ----------------------------------------------------------------------------------------- */

bool parameters_max_depth(const struct scene *scene, int wanted, int *out, struct error *err)
{
    long depth = wanted;
    if (wanted <= 0 && !settings_int(&scene->settings, "maxdepth", DEFAULT_MAX_DEPTH, 0, PATH_MAX_DEPTH, &depth, err))
        return false;
    *out = (int)depth;
    return true;
}

static bool unknown(const struct setting *item, struct error *err)
{
    return error_set(err, "%s: no integrator has a parameter \"%s\"; asbdpt --help lists them", item->origin,
                     item->name);
}

/* Parameters of any integrator are known: --integrator may have replaced the scene's. */
static bool all_known(const struct scene *scene, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++)
        if (owner(integrator_list(), scene->settings.item[i].name, NULL) == NULL)
            return unknown(&scene->settings.item[i], err);
    return true;
}

bool parameters_belong(const struct scene *scene, const struct integrator *const *readers, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++) {
        const struct setting *item = &scene->settings.item[i];
        const struct integrator *has = owner(integrator_list(), item->name, NULL);
        if (is_of_file(item) || owner(readers, item->name, NULL) != NULL)
            continue;
        if (has == NULL)
            return unknown(item, err);
        if (readers[1] != NULL)
            return error_set(err, "-P: \"%s\" is a parameter of %s, the integrators here are %s and %s", item->name,
                             has->name, readers[0]->name, readers[1]->name);
        return error_set(err, "-P: \"%s\" is a parameter of %s, the integrator here is %s; try --integrator %s",
                         item->name, has->name, readers[0]->name, has->name);
    }
    return true;
}

bool parameters_read(const struct scene *scene, const struct integrator *m, int max_depth, struct render_job *job,
                     struct error *err)
{
    const struct settings *s = &scene->settings;
    double fallback = m->rr_threshold != NULL ? m->rr_threshold(s) : DEFAULT_RR_THRESHOLD;
    int heuristic, strategy;
    if (!all_known(scene, err) || !settings_choice(s, "heuristic", 0, HEURISTICS, &heuristic, err) ||
        !settings_real(s, "rrthreshold", fallback, 0, 1e6, &job->rr_threshold, err) ||
        !settings_choice(s, "lightsamplestrategy", 0, STRATEGIES, &strategy, err) ||
        !parameters_max_depth(scene, max_depth, &job->max_depth, err) || (m->check != NULL && !m->check(s, err)))
        return false;
    job->power_heuristic = heuristic == 1;
    job->spatial_lights = strategy == 0;
    return true;
}
