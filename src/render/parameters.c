/* parameters.c: see parameters.h. */
#include "render/parameters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

/* What all integrators have. */
struct common {
    int max_depth, heuristic, strategy;
    double rr_threshold;
};
enum { DEFAULT_MAX_DEPTH = 5 }; /* pbrt-v3's */
static const char *const HEURISTICS[] = {"balance", "power", NULL};
static const char *const STRATEGIES[] = {"spatial", "power", "uniform", NULL};

#define AT(member) offsetof(struct common, member)
static const struct field COMMON[] = {
    {"maxdepth", FIELD_INTEGER, AT(max_depth), DEFAULT_MAX_DEPTH, 0, PATH_MAX_DEPTH,
     "longest path, in edges minus one", NULL},
    {"heuristic", FIELD_WORD, AT(heuristic), 0, 0, 0, "heuristic of the weights: balance or power", HEURISTICS},
    {"rrthreshold", FIELD_NUMBER, AT(rr_threshold), DEFAULT_RR_THRESHOLD, 0, 1e6,
     "relative throughput below which Russian roulette begins, 0: never; for bins 0", NULL},
    {"lightsamplestrategy", FIELD_WORD, AT(strategy), 0, 0, 0,
     "asbdpt chooses the light of s = 1 by what is seen, or by power", STRATEGIES},
    {.name = NULL}};

const struct field *parameters_common(void) { return COMMON; }

/* The first of these methods that has such a parameter, or NULL. */
static const struct method *owner(const struct method *const *m, const char *name)
{
    bool common = field_find(COMMON, name) != NULL;
    while (*m != NULL && !common && method_has(*m, name) == NULL)
        m++;
    return *m;
}

/* --- adapting ---------------------------------------------------------------------------------------- */

static void warn(const struct message_sink *sink, const struct setting *item, const char *text)
{
    struct error line;
    error_set(&line, "%s: \"%s\" %s", item->origin, item->name, text);
    if (sink != NULL)
        sink->hear(sink->context, false, line.text);
}

/* Say that another value counts, and let it. */
static void replace(struct settings *s, const struct setting *item, const char *value, const struct message_sink *sink,
                    const char *text)
{
    char *name = mem_copy_text(item->name), *origin = mem_copy_text(item->origin);
    warn(sink, item, text);
    settings_set(s, name, value, origin);
    free(name);
    free(origin);
}

/* Lights chosen uniformly give the same image with more noise, so "uniform" becomes "power". pbrt-v3 has no longest
 * path. */
static void adapt(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char text[96], most[32];
    if (strcmp(item->name, "lightsamplestrategy") == 0 && strcmp(item->value, "uniform") == 0)
        replace(s, item, "power", sink, "is \"power\" instead of \"uniform\", which only has more noise");
    bool depth = strcmp(item->name, "maxdepth") == 0 && setting_is_of_file(item);
    if (!depth || !(strtod(item->value, NULL) > PATH_MAX_DEPTH))
        return;
    snprintf(most, sizeof most, "%d", PATH_MAX_DEPTH);
    snprintf(text, sizeof text, "is %.20s, which counts as %s", item->value, most);
    replace(s, item, most, sink, text);
}

/* Is it one of the integrator that the file names? There it is right: --integrator may have replaced that, or -P its
 * selection. */
static bool belongs_to_file(const struct scene *scene, const struct setting *item)
{
    for (const struct method *const *m = method_rows; scene->integrator != NULL && *m != NULL; m++)
        if (strcmp((*m)->name, scene->integrator) == 0 && method_has(*m, item->name) != NULL)
            return true;
    return false;
}

/* Is it a parameter in a file that none of the readers has? Then a warning says so. */
static bool passed_over(const struct scene *scene, const struct setting *item, const struct method *const *readers,
                        const struct message_sink *sink)
{
    const struct method *has = owner(method_rows, item->name);
    char text[128] = "is not used: no integrator here has such a parameter";
    if (!setting_is_of_file(item) || owner(readers, item->name) != NULL || belongs_to_file(scene, item))
        return false;
    if (has != NULL)
        snprintf(text, sizeof text, "is not used: it is a parameter of %s", has->name);
    warn(sink, item, text);
    return true;
}

void parameters_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink)
{
    struct settings *all = &scene->settings;
    for (int i = 0; i < all->n;)
        if (passed_over(scene, &all->item[i], readers, sink))
            settings_remove(all, i);
        else
            adapt(all, &all->item[i++], sink);
}

/* --- reading ----------------------------------------------------------------------------------------- */

bool parameters_max_depth(const struct scene *scene, int wanted, int *out, struct error *err)
{
    struct common c = {.max_depth = wanted};
    const struct field table[] = {COMMON[0], {.name = NULL}};
    bool ok = wanted > 0 || settings_fields(&scene->settings, table, &c, err);
    *out = c.max_depth;
    return ok;
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
        const struct method *has = owner(method_rows, item->name);
        char whose[64], here[64];
        if (setting_is_of_file(item) || owner(readers, item->name) != NULL)
            continue;
        if (has == NULL)
            return error_usage(err, "%s: no integrator has a parameter \"%s\"; asbdpt help integrators lists them",
                               item->origin, item->name);
        name_method(has, item->name, whose, sizeof whose);
        name_method(readers[0], item->name, here, sizeof here);
        return error_usage(err, "-P: \"%s\" is a parameter of %s, not of %s; see --integrator", item->name, whose,
                           here);
    }
    return true;
}

bool parameters_read(const struct scene *scene, const struct method *m, int max_depth, struct render_job *job,
                     struct error *err)
{
    const struct settings *s = &scene->settings;
    struct common c;
    if (!settings_fields(s, COMMON, &c, err) || !method_check(m, scene, err))
        return false;
    job->max_depth = max_depth > 0 ? max_depth : c.max_depth;
    job->rr_threshold = settings_text(s, "rrthreshold", NULL) != NULL ? c.rr_threshold : m->rr_threshold;
    job->power_heuristic = c.heuristic == 1;
    job->spatial_lights = c.strategy == 0;
    return true;
}
