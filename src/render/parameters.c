/* parameters.c: see parameters.h. */
#include "render/parameters.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const HEURISTICS[] = {"balance", "power", NULL};
static const char *const STRATEGIES[] = {"spatial", "power", "uniform", NULL};

enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */

static bool is_of_file(const struct setting *item) { return strcmp(item->origin, "-P") != 0; }

static bool parameter_known(const char *name)
{
    static const char *const COMMON[] = {"maxdepth", "heuristic", "rrthreshold", "lightsamplestrategy", NULL};
    for (int i = 0; COMMON[i] != NULL; i++)
        if (strcmp(COMMON[i], name) == 0)
            return true;
    for (const struct integrator *const *m = integrator_list(); *m != NULL; m++)
        for (const struct setting_help *p = (*m)->parameters; p->name != NULL; p++)
            if (strcmp(p->name, name) == 0)
                return true;
    return false;
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

void parameters_adapt(struct scene *scene, const struct message_sink *sink)
{
    struct settings *s = &scene->settings;
    for (int i = 0; i < s->n; i++) {
        const struct setting *item = &s->item[i];
        const char *way = other_way(item->name);
        if (strcmp(item->name, "lightsamplestrategy") == 0) {
            adapt_strategy(s, item, sink);
        } else if (strcmp(item->name, "maxdepth") == 0) {
            adapt_depth(s, item, sink);
        } else if (way != NULL || (is_of_file(item) && !parameter_known(item->name))) {
            if (way == NULL || strcmp(item->value, "false") != 0)
                warn(sink, item, way != NULL ? way : "is not used: no integrator here has such a parameter");
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

/* Parameters of any integrator are known: --integrator may have replaced the scene's. */
static bool all_known(const struct scene *scene, struct error *err)
{
    for (int i = 0; i < scene->settings.n; i++) {
        const struct setting *item = &scene->settings.item[i];
        if (!parameter_known(item->name))
            return error_set(err, "%s: no integrator has a parameter \"%s\"; asbdpt --help lists them", item->origin,
                             item->name);
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
