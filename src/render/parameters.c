/* parameters.c: see parameters.h. */
#include "render/parameters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "parser/symbols.h"

static bool is_of_file(const struct setting *item) { return strcmp(item->origin, "-P") != 0; }

/* What all integrators have. */
struct common {
    int max_depth, heuristic, strategy;
    double rr_threshold;
};
enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */
static const char *const HEURISTICS[] = {"balance", "power", NULL};
static const char *const STRATEGIES[] = {"spatial", "power", "uniform", NULL};

#define AT(member) offsetof(struct common, member)
static const struct method_parameter COMMON[] = {
    {"maxdepth", PARAMETER_INTEGER, AT(max_depth), DEFAULT_MAX_DEPTH, 0, PATH_MAX_DEPTH,
     "edges of a path less one", NULL},
    {"heuristic", PARAMETER_WORD, AT(heuristic), 0, 0, 0, "of the weights: balance or power", HEURISTICS},
    {"rrthreshold", PARAMETER_NUMBER, AT(rr_threshold), DEFAULT_RR_THRESHOLD, 0, 1e6,
     "relative throughput at which Russian roulette begins, 0: never; asbdpt's bins: 0", NULL},
    {"lightsamplestrategy", PARAMETER_WORD, AT(strategy), 0, 0, 0,
     "asbdpt: s = 1 picks lights by what is seen, or by power", STRATEGIES},
    {.name = NULL}};

const struct method_parameter *parameters_common(void) { return COMMON; }

/* The first of these methods that has such a parameter, or NULL; *out, unless NULL, is the parameter. */
static const struct method *owner(const struct method *const *m, const char *name, const struct method_parameter **out)
{
    const struct method_parameter *found = parameter_find(COMMON, name);
    for (; found == NULL && *m != NULL; m += found == NULL)
        found = method_has(*m, name);
    if (out != NULL)
        *out = found;
    return found != NULL ? *m : NULL;
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
        {"chains", "is not used: a tile has a chain of its own for every few samples"},
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
    const struct method_parameter *found;
    char text[96];
    if (item->type == NULL || owner(method_list(), item->name, &found) == NULL)
        return false;
    if (strcmp(item->type, parameter_type(found)) != 0)
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
 * replaced it, or -P its selection. True, with a warning, if it is to be taken out. */
static bool unread(const struct scene *scene, const struct setting *item, const struct method *const *readers,
                   const struct message_sink *sink)
{
    const struct method *has = owner(method_list(), item->name, NULL);
    char text[128];
    if (!is_of_file(item) || owner(readers, item->name, NULL) != NULL)
        return false;
    for (const struct method *const *m = method_list(); scene->integrator != NULL && *m != NULL; m++)
        if (strcmp((*m)->name, scene->integrator) == 0 && method_has(*m, item->name) != NULL)
            return false;
    snprintf(text, sizeof text, "is not used: it is a parameter of %s", has != NULL ? has->name : "");
    warn(sink, item, has != NULL ? text : "is not used: no integrator here has such a parameter");
    return true;
}

/* pbrt-v3's number of samples for its mlt. */
static void adapt_mutations(struct scene *scene, const struct setting *item, const struct method *reader)
{
    if (reader->chain)
        scene->spp = int_within(strtod(item->value, NULL), 1, 1 << 30);
}

/* True if the parameter is to be taken out. */
static bool adapt(struct scene *scene, const struct setting *item, const struct method *const *readers,
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
    if (is_of_file(item) && strcmp(item->name, "mutationsperpixel") == 0) {
        adapt_mutations(scene, item, readers[0]);
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

void parameters_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink)
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
    struct common c = {.max_depth = wanted};
    const struct method_parameter table[] = {COMMON[0], {.name = NULL}};
    bool ok = wanted > 0 || parameters_set(table, &scene->settings, &c, err);
    *out = c.max_depth;
    return ok;
}

static void offer(struct suggestion *s, const struct method_parameter *p)
{
    for (; p != NULL && p->name != NULL; p++)
        suggest_offer(s, p->name);
}

static bool unknown(const struct setting *item, struct error *err)
{
    struct suggestion s = suggest_start(item->name);
    suggest_offer(&s, "select");
    offer(&s, COMMON);
    for (const struct method *const *m = method_list(); *m != NULL; m++)
        offer(&s, (*m)->parameters);
    bool near = s.name != NULL;
    return error_set(err, "%s: no integrator has a parameter \"%s\"%s%s%s; asbdpt help integrators lists them",
                     item->origin, item->name, near ? " (did you mean " : "", near ? s.name : "", near ? "?)" : "");
}

/* Parameters of any integrator are known: --integrator may have replaced the scene's. */
static bool all_known(const struct scene *scene, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++) {
        const struct method_parameter *found;
        owner(method_list(), scene->settings.item[i].name, &found);
        if (found == NULL)
            return unknown(&scene->settings.item[i], err);
    }
    return true;
}

/* "asbdpt", or "asbdpt with select=bins" where a name has several rows, which `select` itself belongs to alike. */
static void name_method(const struct method *m, const char *parameter, char *out, size_t size)
{
    bool row = m->select != NULL && strcmp(parameter, "select") != 0;
    snprintf(out, size, row ? "%s with select=%s" : "%s", m->name, m->select);
}

bool parameters_belong(const struct scene *scene, const struct method *const *readers, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++) {
        const struct setting *item = &scene->settings.item[i];
        const struct method *has = owner(method_list(), item->name, NULL);
        char whose[64], first[64], second[64] = "";
        if (is_of_file(item) || owner(readers, item->name, NULL) != NULL)
            continue;
        if (has == NULL)
            return unknown(item, err);
        name_method(has, item->name, whose, sizeof whose);
        name_method(readers[0], item->name, first, sizeof first);
        if (readers[1] != NULL)
            name_method(readers[1], item->name, second, sizeof second);
        if (readers[1] != NULL)
            return error_set(err, "-P: \"%s\" is a parameter of %s, the integrators here are %s and %s", item->name,
                             whose, first, second);
        return error_set(err, "-P: \"%s\" is a parameter of %s, the integrator here is %s; try --integrator %s",
                         item->name, whose, first, has->name);
    }
    return true;
}

bool parameters_read(const struct scene *scene, const struct method *m, int max_depth, struct render_job *job,
                     struct error *err)
{
    const struct settings *s = &scene->settings;
    struct common c;
    if (!all_known(scene, err) || !parameters_set(COMMON, s, &c, err) ||
        (m->parameters != NULL && !method_check(m, s, err)))
        return false;
    job->max_depth = max_depth > 0 ? max_depth : c.max_depth;
    job->rr_threshold = settings_text(s, "rrthreshold", NULL) != NULL ? c.rr_threshold : m->rr_threshold;
    job->power_heuristic = c.heuristic == 1;
    job->spatial_lights = c.strategy == 0;
    return true;
}
