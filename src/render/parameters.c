/* parameters.c: see parameters.h. */
#include "render/parameters.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const HEURISTICS[] = {"balance", "power", NULL};
static const char *const STRATEGIES[] = {"spatial", "power", "uniform", NULL};

enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */

static bool is_of_file(const struct setting *item) { return strcmp(item->origin, "-P") != 0; }

/* The first of these integrators that has such a parameter, or NULL. */
static const struct integrator *owner(const struct integrator *const *m, const char *name)
{
    static const char *const COMMON[] = {"maxdepth", "heuristic", "rrthreshold", "lightsamplestrategy", NULL};
    for (int i = 0; COMMON[i] != NULL; i++)
        if (strcmp(COMMON[i], name) == 0)
            return *m;
    for (; *m != NULL; m++)
        for (const struct setting_help *p = (*m)->parameters; p->name != NULL; p++)
            if (strcmp(p->name, name) == 0)
                return *m;
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

/* pbrt-v3 has no limit, and takes its default where the number is none. */
static void adapt_depth(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char *end, text[64];
    double depth = strtod(item->value, &end);
    bool number = end != item->value && *end == '\0';
    if (!is_of_file(item) || (number && !(depth > PATH_MAX_DEPTH)))
        return;
    snprintf(text, sizeof text, "is cut to %d, the longest path here", PATH_MAX_DEPTH);
    warn(sink, item, number ? text : "is not used: it is no number");
    snprintf(text, sizeof text, "%d", number ? PATH_MAX_DEPTH : DEFAULT_MAX_DEPTH);
    replace(s, item, text);
}

/* A parameter that nobody reads. One of the integrator that the file names is right there: --integrator may have
 * replaced it. True, with a warning, if it is to be taken out. */
static bool unread(const struct scene *scene, const struct setting *item, const struct integrator *const *readers,
                   const struct message_sink *sink)
{
    const struct integrator *own[] = {scene->integrator != NULL ? integrator_find(scene->integrator) : NULL, NULL};
    const struct integrator *has = owner(integrator_list(), item->name);
    char text[128];
    if (!is_of_file(item) || owner(readers, item->name) != NULL || owner(own, item->name) != NULL)
        return false;
    snprintf(text, sizeof text, "is not used: it is a parameter of %s", has != NULL ? has->name : "");
    warn(sink, item, has != NULL ? text : "is not used: no integrator here has such a parameter");
    return true;
}

void parameters_adapt(struct scene *scene, const struct integrator *const *readers, const struct message_sink *sink)
{
    struct settings *s = &scene->settings;
    for (int i = 0; i < s->n; i++) {
        const struct setting *item = &s->item[i];
        const char *way = other_way(item->name);
        if (strcmp(item->name, "lightsamplestrategy") == 0) {
            adapt_strategy(s, item, sink);
        } else if (strcmp(item->name, "maxdepth") == 0) {
            adapt_depth(s, item, sink);
        } else if (way != NULL) {
            if (strcmp(item->value, "false") != 0)
                warn(sink, item, way);
            settings_remove(s, i--);
        } else if (unread(scene, item, readers, sink)) {
            settings_remove(s, i--);
        }
    }
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
        if (owner(integrator_list(), scene->settings.item[i].name) == NULL)
            return unknown(&scene->settings.item[i], err);
    return true;
}

bool parameters_belong(const struct scene *scene, const struct integrator *const *readers, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++) {
        const struct setting *item = &scene->settings.item[i];
        const struct integrator *has = owner(integrator_list(), item->name);
        if (is_of_file(item) || owner(readers, item->name) != NULL)
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
