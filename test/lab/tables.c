/* tables.c: see tables.h. */
#include "lab/tables.h"

#include <math.h>
#include <string.h>

#include "base/maths.h"
#include "lab/numbers.h"

#define PLUS_MINUS "\xc2\xb1" /* U+00B1 in UTF-8 */

/* --- what was printed -------------------------------------------------------------------------------- */

static const struct published PRINTED[] = {
    {"veach-ajar", {28.3020, 19.1206, 13.2645, 9.4453, 6.9799}, {28.7123, 20.1449, 14.2145, 10.1481, 7.2419}},
    {"cornell-box", {2.8022, 2.2055, 1.9630, 1.8629, 1.8169}, {2.7836, 1.9842, 1.4369, 1.0609, 0.8086}},
    {"cornell-box-modified", {3.3398, 2.4268, 1.8763, 1.5464, 1.3567}, {3.3369, 2.3851, 1.7241, 1.2604, 0.9453}},
    {"bathroom", {17.3230, 13.8195, 11.7632, 10.6083, 10.0122}, {17.3743, 13.9254, 11.8313, 10.6455, 10.0004}},
    {"living-room", {8.2173, 5.8870, 4.3207, 3.2946, 2.6155}, {8.2646, 5.9254, 4.2720, 3.0800, 2.2604}},
};

/* Samples per pixel of entry i. */
static long published_spp(int i) { return 32L << i; }

const struct published *published_find(const char *scene)
{
    for (size_t i = 0; i < sizeof PRINTED / sizeof PRINTED[0]; i++)
        if (strcmp(PRINTED[i].scene, scene) == 0)
            return &PRINTED[i];
    return NULL;
}

/* --- columns and cells ------------------------------------------------------------------------------- */

/* One column for each method from `first` on that is compared. */
static void add_method_columns(struct table *t, const struct plan *p, int first, const char *format)
{
    for (int v = first; v < p->n_compared; v++)
        table_column(t, format, p->methods.item[v].text);
}

static void add_spp_columns(struct table *t, const struct plan *p)
{
    for (int i = 0; i < p->n_steps; i++)
        table_column(t, "%ld spp", p->spp[i]);
}

static void add_spp(struct table *t, long spp) { table_add(t, (double)spp, "%ld", spp); }

/* "mean +- error" with as many digits after the point as show two of the error's. */
static void add_estimate(struct table *t, double mean, double error)
{
    int digits = error > 0 && isfinite(error) ? 1 - (int)floor(log_ten(error)) : 0;
    digits = digits < 0 ? 0 : digits > 6 ? 6 : digits;
    if (!isfinite(mean))
        table_add_missing(t, 1);
    else if (!isfinite(error) || error == 0)
        table_add(t, mean, "%.4g", mean);
    else
        table_add(t, mean, "%.*f " PLUS_MINUS " %.*f", digits, mean, digits, error);
}

static void add_mean(struct table *t, const struct scene_results *s, int method, int step,
                     enum quantity q, double scale)
{
    struct estimate e = results_mean(s, method, step, q);
    add_estimate(t, scale * e.mean, scale * e.error);
}

/* One cell for each method that is compared. */
static void add_means(struct table *t, const struct scene_results *s, int step, enum quantity q)
{
    for (int v = 0; v < s->plan->n_compared; v++)
        add_mean(t, s, v, step, q, 1);
}

static void add_costs(struct table *t, const struct scene_results *s, int step)
{
    for (int v = 1; v < s->plan->n_compared; v++)
        table_add_interval(t, results_over_first(s, v, step, true));
}

/* --- tables of a scene ------------------------------------------------------------------------------- */

static void rmse_table(const struct scene_results *s, struct table *t)
{
    table_begin(t, "RMSE on the 8-bit scale, mean over seeds and its standard error");
    table_column(t, "spp");
    add_method_columns(t, s->plan, 0, "%s");
    for (int i = 0; i < s->plan->n_steps; i++) {
        add_spp(t, s->plan->spp[i]);
        add_means(t, s, i, Q_RMSE8);
    }
}

/* What the dissertation measured, among what is compared: the first method is its BDPT, the number of its ASBDPT is
 * returned; or -1. */
static int find_printed(const struct plan *p)
{
    int bins = methods_find(&p->methods, METHOD_PRINTED);
    return methods_find(&p->methods, METHOD_REFERENCE) == 0 && bins < p->n_compared ? bins : -1;
}

static void add_ours(struct table *t, const struct scene_results *s, int step)
{
    int bins = find_printed(s->plan);
    add_mean(t, s, 0, step, Q_RMSE8, 1);
    add_mean(t, s, bins, step, Q_RMSE8, 1);
    table_add_interval(t, results_over_first(s, bins, step, false));
}

/* The dissertation's step i beside ours of as many samples, if we have it. */
static void add_published(struct table *t, const struct scene_results *s, const struct published *p, int i)
{
    int step = plan_last_step(s->plan);
    while (step >= 0 && s->plan->spp[step] != published_spp(i))
        step--;
    add_spp(t, published_spp(i));
    if (step >= 0)
        add_ours(t, s, step);
    else
        table_add_missing(t, 3);
    table_add(t, p->bdpt[i], "%.4f", p->bdpt[i]);
    table_add(t, p->asbdpt[i], "%.4f", p->asbdpt[i]);
    table_add(t, p->asbdpt[i] / p->bdpt[i], "%.3f", p->asbdpt[i] / p->bdpt[i]);
}

static bool printed_table(const struct scene_results *s, struct table *t)
{
    static const char *const heads[] = {
        "spp",           "BDPT, here",      "bins, here",          "bins/BDPT, here [95 %]",
        "BDPT, printed", "ASBDPT, printed", "ASBDPT/BDPT, printed"};
    const struct published *p = published_find(s->name);
    if (p == NULL || find_printed(s->plan) < 0)
        return false;
    table_begin(t, "RMSE beside the dissertation's (its model of the scene is another, so compare the ratios)");
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        table_column(t, "%s", heads[i]);
    for (int i = 0; i < s->plan->n_steps && s->plan->spp[i] < published_spp(0); i++) {
        add_spp(t, s->plan->spp[i]);
        add_ours(t, s, i);
        table_add_missing(t, 3);
    }
    for (int i = 0; i < PUBLISHED_STEPS; i++)
        add_published(t, s, p, i);
    return true;
}

static void cost_table(const struct scene_results *s, struct table *t)
{
    table_begin(t, "Seconds of CPU, and squared error times seconds over that of %s, with its 95 %% interval; "
                   "below 1 is a gain", s->plan->methods.item[0].text);
    table_column(t, "spp");
    add_method_columns(t, s->plan, 0, "%s, s");
    add_method_columns(t, s->plan, 1, "%s");
    for (int i = 0; i < s->plan->n_steps; i++) {
        add_spp(t, s->plan->spp[i]);
        add_means(t, s, i, Q_SECONDS);
        add_costs(t, s, i);
    }
}

static void bias_table(const struct scene_results *s, struct table *t)
{
    char own[32] = "not known";
    if (isfinite(s->reference.mean_error))
        snprintf(own, sizeof own, "%.2g %%", 100 * s->reference.mean_error);
    table_begin(t, "Signed error of the picture's mean in percent, mean over seeds and its standard error "
                   "(the reference's own standard error: %s)", own);
    table_column(t, "method");
    add_spp_columns(t, s->plan);
    table_column(t, "tested");
    for (int v = 0; v < s->plan->n_compared; v++) {
        table_add(t, v, "%s", s->plan->methods.item[v].text);
        for (int i = 0; i < s->plan->n_steps; i++)
            add_mean(t, s, v, i, Q_MEAN_ERROR, 100);
        table_add(t, s->mark[v], "%s", s->mark[v] != MARK_NONE ? MARKS[s->mark[v]] : "-");
    }
}

static void sweep_table(const struct scene_results *s, const struct sweep *sweep, struct table *t)
{
    table_begin(t, "RMSE on the 8-bit scale of %s, one seed where it is not compared above", sweep->text);
    table_column(t, "method");
    add_spp_columns(t, s->plan);
    for (int k = 0; k < sweep->n; k++) {
        table_add(t, k, "%s", s->plan->methods.item[sweep->method[k]].text);
        for (int i = 0; i < s->plan->n_steps; i++)
            add_mean(t, s, sweep->method[k], i, Q_RMSE8, 1);
    }
}

/* --- tables of all scenes ---------------------------------------------------------------------------- */

static void add_scene(struct table *t, const struct scene_results *s) { table_add(t, NAN, "%.90s", s->name); }

static void setup_table(const struct results *r, struct table *t)
{
    static const char *const heads[] = {"scene",     "pixels",           "maxdepth",
                                        "reference", "its noise, 8-bit", "error of its mean, %"};
    table_begin(t, "What was measured, against what");
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        table_column(t, "%s", heads[i]);
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        add_scene(t, s);
        table_add(t, (double)s->width * s->height, "%d x %d", s->width, s->height);
        table_add(t, s->max_depth, "%d", s->max_depth);
        table_add(t, NAN, "%.240s", s->reference.origin);
        add_estimate(t, s->reference.noise8, NAN);
        add_estimate(t, 100 * s->reference.mean_error, NAN);
    }
}

static void all_rmse_table(const struct results *r, struct table *t)
{
    int bins = find_printed(r->plan);
    table_begin(t, bins < 0 ? "RMSE on the 8-bit scale after %ld spp" :
                   "RMSE on the 8-bit scale after %ld spp; the dissertation's is after %ld spp",
                plan_last_spp(r->plan), published_spp(PUBLISHED_STEPS - 1));
    table_column(t, "scene");
    add_method_columns(t, r->plan, 0, "%s");
    if (bins >= 0) {
        table_column(t, "ASBDPT/BDPT, here [95 %%]");
        table_column(t, "printed");
    }
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        const struct published *p = published_find(s->name);
        double printed = p != NULL ? p->asbdpt[PUBLISHED_STEPS - 1] / p->bdpt[PUBLISHED_STEPS - 1] : NAN;
        struct interval alone = {printed, NAN, NAN};
        add_scene(t, s);
        add_means(t, s, plan_last_step(r->plan), Q_RMSE8);
        if (bins >= 0) {
            table_add_interval(t, results_over_first(s, bins, plan_last_step(r->plan), false));
            table_add_interval(t, alone);
        }
    }
}

static void all_cost_table(const struct results *r, struct table *t)
{
    table_begin(t, "Squared error times seconds over that of %s after %ld spp, with its 95 %% interval; below 1 is "
                   "a gain",
                r->plan->methods.item[0].text, plan_last_spp(r->plan));
    table_column(t, "scene");
    add_method_columns(t, r->plan, 1, "%s");
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        add_scene(t, s);
        add_costs(t, s, plan_last_step(r->plan));
    }
}

bool table_make(const struct results *r, const struct scene_results *s, int which, struct table *out)
{
    switch (which) {
    case TABLE_SETUP: setup_table(r, out); return true;
    case TABLE_ALL_RMSE: all_rmse_table(r, out); return true;
    case TABLE_ALL_COST: all_cost_table(r, out); return true;
    case TABLE_RMSE: rmse_table(s, out); return true;
    case TABLE_PRINTED: return printed_table(s, out);
    case TABLE_COST: cost_table(s, out); return true;
    case TABLE_BIAS: bias_table(s, out); return true;
    default:
        if (which - TABLE_SWEEP >= r->plan->n_sweeps)
            return false;
        sweep_table(s, &r->plan->sweep[which - TABLE_SWEEP], out);
        return true;
    }
}

void tables_write(FILE *f, const struct results *r, const struct scene_results *s)
{
    int end = s == NULL ? TABLE_RMSE : TABLE_SWEEP + r->plan->n_sweeps;
    for (int k = s == NULL ? TABLE_SETUP : TABLE_RMSE; k < end; k++) {
        struct table t;
        if (table_make(r, s, k, &t)) {
            table_markdown(f, &t);
            table_free(&t);
        }
    }
}
