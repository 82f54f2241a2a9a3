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
     "edges of a path less one", NULL},
    {"heuristic", FIELD_WORD, AT(heuristic), 0, 0, 0, "of the weights: balance or power", HEURISTICS},
    {"rrthreshold", FIELD_NUMBER, AT(rr_threshold), DEFAULT_RR_THRESHOLD, 0, 1e6,
     "relative throughput at which Russian roulette begins, 0: never; asbdpt's bins: 0", NULL},
    {"lightsamplestrategy", FIELD_WORD, AT(strategy), 0, 0, 0,
     "asbdpt: s = 1 picks lights by what is seen, or by power", STRATEGIES},
    {.name = NULL}};

const struct field *parameters_common(void) { return COMMON; }

/* The first of these methods that has such a parameter, or NULL; *out, unless NULL, is the parameter. */
static const struct method *owner(const struct method *const *m, const char *name, const struct field **out)
{
    const struct field *found = field_find(COMMON, name);
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

/* Say so, and let another value count. */
static void replace(struct settings *s, const struct setting *item, const char *value, const struct message_sink *sink,
                    const char *text)
{
    char *name = mem_copy_text(item->name), *origin = mem_copy_text(item->origin);
    warn(sink, item, text);
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
    if (known && which == 2)
        replace(s, item, "power", sink, "is \"power\" instead of \"uniform\", which only has more noise");
    else if (!known && setting_is_of_file(item))
        replace(s, item, "spatial", sink, "is \"spatial\": its value is unknown");
}

/* pbrt-v3 cuts what is no integer, and has no longest path; what no parameter's range reaches stays as it is. */
static void adapt_integer(struct settings *s, const struct setting *item, const struct message_sink *sink)
{
    char text[96], value[32];
    double number = strtod(item->value, NULL), used = trunc(number);
    if (strcmp(item->name, "maxdepth") == 0)
        used = fmin(used, PATH_MAX_DEPTH);
    if (!setting_is_of_file(item) || used == number || !(fabs(used) <= 1e15))
        return;
    snprintf(text, sizeof text, "is %.12g, which counts as %.12g", number, used);
    snprintf(value, sizeof value, "%.0f", used + 0.0);
    replace(s, item, value, sink, text);
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

/* Of a parameter in a file that nobody reads, or, as of all parameters there, with the wrong type or number of values,
 * the default counts. True, with a warning, if it is to be taken out. */
static bool passed_over(const struct scene *scene, const struct setting *item, const struct method *const *readers,
                        const struct message_sink *sink)
{
    const struct field *found;
    const struct method *has = owner(method_rows, item->name, &found);
    char text[128];
    if (!setting_is_of_file(item))
        return false;
    if (has == NULL)
        snprintf(text, sizeof text, "is not used: no integrator here has such a parameter");
    else if (item->type != NULL && strcmp(item->type, field_type(found)) != 0)
        snprintf(text, sizeof text, "cannot be of type \"%s\", so it is not used", item->type);
    else if (item->type != NULL && item->n_values != 1)
        snprintf(text, sizeof text, "wants 1 value, not %d; it is passed over", item->n_values);
    else if (owner(readers, item->name, NULL) == NULL && !belongs_to_file(scene, item))
        snprintf(text, sizeof text, "is not used: it is a parameter of %s", has->name);
    else
        return false;
    warn(sink, item, text);
    return true;
}

void parameters_adapt(struct scene *scene, const struct method *const *readers, const struct message_sink *sink)
{
    struct settings *all = &scene->settings;
    for (int i = 0; i < all->n;) {
        const struct field *found;
        if (passed_over(scene, &all->item[i], readers, sink)) {
            settings_remove(all, i);
            continue;
        }
        owner(method_rows, all->item[i].name, &found);
        if (found != NULL && found->kind == FIELD_INTEGER)
            adapt_integer(all, &all->item[i], sink);
        if (strcmp(all->item[i].name, "lightsamplestrategy") == 0)
            adapt_strategy(all, &all->item[i], sink);
        i++;
    }
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
        const struct method *has = owner(method_rows, item->name, NULL);
        char whose[64], here[64];
        if (setting_is_of_file(item) || owner(readers, item->name, NULL) != NULL)
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
