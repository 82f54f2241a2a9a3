/* tables.c: see tables.h. */
#include "lab/tables.h"

#include <math.h>
#include <string.h>

#include "lab/numbers.h"
#include "lab/table.h"

#define PLUS_MINUS "\xc2\xb1" /* U+00B1 in UTF-8 */

/* Root mean square errors that the dissertation printed, on the 8-bit scale, against 16384 samples of pbrt-v3's bdpt,
 * in Bitterli's models, after 32, 64 ... 512 samples per pixel.                                             [S24 4] */
enum { PUBLISHED_STEPS = 5 };
static const struct published {
    const char *scene; /* our name of the same situation */
    double asbdpt[PUBLISHED_STEPS], bdpt[PUBLISHED_STEPS];
} PRINTED[] = {
    {"veach-ajar", {28.3020, 19.1206, 13.2645, 9.4453, 6.9799}, {28.7123, 20.1449, 14.2145, 10.1481, 7.2419}},
    {"cornell-box", {2.8022, 2.2055, 1.9630, 1.8629, 1.8169}, {2.7836, 1.9842, 1.4369, 1.0609, 0.8086}},
    {"cornell-box-modified", {3.3398, 2.4268, 1.8763, 1.5464, 1.3567}, {3.3369, 2.3851, 1.7241, 1.2604, 0.9453}},
    {"bathroom", {17.3230, 13.8195, 11.7632, 10.6083, 10.0122}, {17.3743, 13.9254, 11.8313, 10.6455, 10.0004}},
    {"living-room", {8.2173, 5.8870, 4.3207, 3.2946, 2.6155}, {8.2646, 5.9254, 4.2720, 3.0800, 2.2604}},
};

/* Samples per pixel of entry i. */
static long published_spp(int i) { return 32L << i; }

static const struct published *published_find(const char *scene)
{
    for (size_t i = 0; i < sizeof PRINTED / sizeof PRINTED[0]; i++)
        if (strcmp(PRINTED[i].scene, scene) == 0)
            return &PRINTED[i];
    return NULL;
}

/* --- columns and cells ------------------------------------------------------------------------------- */

static void add_columns(struct table *t, const char *const *name, int n)
{
    for (int i = 0; i < n; i++)
        table_column(t, "%s", name[i]);
}

/* One column for each method from `first` on that is compared, with a unit behind its name. */
static void add_method_columns(struct table *t, const struct plan *p, int first, const char *unit)
{
    for (int v = first; v < p->n_compared; v++)
        table_column(t, "%s%s", p->methods.item[v].text, unit);
}

/* "mean +- error" with as many digits after the point as show two of the error's. */
static void add_estimate(struct table *t, double mean, double error)
{
    int digits = error > 0 && isfinite(error) ? 1 - (int)floor(log_ten(error)) : 0;
    digits = digits < 0 ? 0 : digits > 6 ? 6 : digits;
    if (!isfinite(mean))
        table_add_missing(t, 1);
    else if (!isfinite(error) || error == 0)
        table_add(t, "%.4g", mean);
    else
        table_add(t, "%.*f " PLUS_MINUS " %.*f", digits, mean, digits, error);
}

static void add_mean(struct table *t, const struct scene_results *s, int method, int step, enum quantity q)
{
    struct estimate e = results_mean(s, method, step, q);
    double scale = q == Q_MEAN_ERROR ? 100 : 1; /* per cent */
    add_estimate(t, scale * e.mean, scale * e.error);
}

/* One cell for each method that is compared. */
static void add_means(struct table *t, const struct scene_results *s, int step, enum quantity q)
{
    for (int v = 0; v < s->plan->n_compared; v++)
        add_mean(t, s, v, step, q);
}

static void add_costs(struct table *t, const struct scene_results *s, int step)
{
    for (int v = 1; v < s->plan->n_compared; v++)
        table_add_interval(t, results_over_first(s, v, step, true), "");
}

/* --- tables of a scene ------------------------------------------------------------------------------- */

static void rmse_table(FILE *f, const struct scene_results *s)
{
    struct table t = table_begin(f, "RMSE on the 8-bit scale, mean over seeds and its standard error");
    table_column(&t, "spp");
    add_method_columns(&t, s->plan, 0, "");
    for (int i = 0; i < s->plan->n_steps; i++) {
        table_add(&t, "%ld", s->plan->spp[i]);
        add_means(&t, s, i, Q_RMSE8);
    }
    table_end(&t);
}

/* What the dissertation measured, among what is compared: the first method is its BDPT, the number of its ASBDPT is
 * returned; or -1. */
static int find_printed(const struct plan *p)
{
    int bins = methods_find(&p->methods, METHOD_PRINTED);
    return methods_find(&p->methods, METHOD_REFERENCE) == 0 && bins < p->n_compared ? bins : -1;
}

/* Ours after this step, if there is such a step, beside the dissertation's entry i, if there is such an entry. */
static void add_printed(struct table *t, const struct scene_results *s, const struct published *p, int step, int i)
{
    int bins = find_printed(s->plan);
    table_add(t, "%ld", i >= 0 ? published_spp(i) : s->plan->spp[step]);
    if (step >= 0) {
        add_mean(t, s, 0, step, Q_RMSE8);
        add_mean(t, s, bins, step, Q_RMSE8);
        table_add_interval(t, results_over_first(s, bins, step, false), "");
    } else {
        table_add_missing(t, 3);
    }
    if (i >= 0) {
        table_add(t, "%.4f", p->bdpt[i]);
        table_add(t, "%.4f", p->asbdpt[i]);
        table_add(t, "%.3f", p->asbdpt[i] / p->bdpt[i]);
    } else {
        table_add_missing(t, 3);
    }
}

static void printed_table(FILE *f, const struct scene_results *s)
{
    static const char *const heads[] = {
        "spp",           "BDPT, here",      "bins, here",          "bins/BDPT, here [95 %]",
        "BDPT, printed", "ASBDPT, printed", "ASBDPT/BDPT, printed"};
    const struct published *p = published_find(s->name);
    if (p == NULL || find_printed(s->plan) < 0)
        return;
    struct table t =
        table_begin(f, "RMSE beside the dissertation's (its model of the scene is another, so compare the ratios)");
    add_columns(&t, heads, 7);
    for (int i = 0; i < s->plan->n_steps && s->plan->spp[i] < published_spp(0); i++)
        add_printed(&t, s, p, i, -1);
    for (int i = 0; i < PUBLISHED_STEPS; i++) {
        int step = plan_last_step(s->plan);
        while (step >= 0 && s->plan->spp[step] != published_spp(i))
            step--;
        add_printed(&t, s, p, step, i);
    }
    table_end(&t);
}

static void cost_table(FILE *f, const struct scene_results *s)
{
    struct table t = table_begin(f, "Seconds of CPU, and squared error times seconds over that of %s, with its 95 %% "
                                 "interval; below 1 is a gain", s->plan->methods.item[0].text);
    table_column(&t, "spp");
    add_method_columns(&t, s->plan, 0, ", s");
    add_method_columns(&t, s->plan, 1, "");
    for (int i = 0; i < s->plan->n_steps; i++) {
        table_add(&t, "%ld", s->plan->spp[i]);
        add_means(&t, s, i, Q_SECONDS);
        add_costs(&t, s, i);
    }
    table_end(&t);
}

/* A row for each of n methods, a column for each step. */
static void method_rows_table(struct table *t, const struct scene_results *s, const int *method, int n, enum quantity q)
{
    table_column(t, "method");
    for (int i = 0; i < s->plan->n_steps; i++)
        table_column(t, "%ld spp", s->plan->spp[i]);
    if (q == Q_MEAN_ERROR)
        table_column(t, "tested");
    for (int k = 0; k < n; k++) {
        int v = method != NULL ? method[k] : k;
        table_add(t, "%s", s->plan->methods.item[v].text);
        for (int i = 0; i < s->plan->n_steps; i++)
            add_mean(t, s, v, i, q);
        if (q == Q_MEAN_ERROR)
            table_add(t, "%s", s->mark[v] != MARK_NONE ? MARKS[s->mark[v]] : "-");
    }
    table_end(t);
}

static void bias_table(FILE *f, const struct scene_results *s)
{
    char own[32] = "not known";
    if (isfinite(s->reference.mean_error))
        snprintf(own, sizeof own, "%.2g %%", 100 * s->reference.mean_error);
    struct table t = table_begin(f, "Signed error of the picture's mean in percent, mean over seeds and its standard "
                                 "error (the reference's own standard error: %s)", own);
    method_rows_table(&t, s, NULL, s->plan->n_compared, Q_MEAN_ERROR);
}

static void sweep_table(FILE *f, const struct scene_results *s, const struct sweep *sweep)
{
    struct table t = table_begin(f, "RMSE on the 8-bit scale of %s, one seed where it is not compared above",
                                 sweep->text);
    method_rows_table(&t, s, sweep->method, sweep->n, Q_RMSE8);
}

/* --- tables of all scenes ---------------------------------------------------------------------------- */

static void setup_table(FILE *f, const struct results *r)
{
    static const char *const heads[] = {"scene",     "pixels",           "maxdepth",
                                        "reference", "its noise, 8-bit", "error of its mean, %"};
    struct table t = table_begin(f, "What was measured, against what");
    add_columns(&t, heads, 6);
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        table_add(&t, "%.90s", s->name);
        table_add(&t, "%d x %d", s->width, s->height);
        table_add(&t, "%d", s->max_depth);
        table_add(&t, "%.240s", s->reference.origin);
        add_estimate(&t, s->reference.noise8, NAN);
        add_estimate(&t, 100 * s->reference.mean_error, NAN);
    }
    table_end(&t);
}

static void all_rmse_table(FILE *f, const struct results *r)
{
    int bins = find_printed(r->plan), last = plan_last_step(r->plan);
    struct table t = table_begin(f, bins < 0 ? "RMSE on the 8-bit scale after %ld spp" :
                                 "RMSE on the 8-bit scale after %ld spp; the dissertation's is after %ld spp",
                                 plan_last_spp(r->plan), published_spp(PUBLISHED_STEPS - 1));
    table_column(&t, "scene");
    add_method_columns(&t, r->plan, 0, "");
    if (bins >= 0) {
        table_column(&t, "ASBDPT/BDPT, here [95 %%]");
        table_column(&t, "printed");
    }
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        const struct published *p = published_find(s->name);
        double printed = p != NULL ? p->asbdpt[PUBLISHED_STEPS - 1] / p->bdpt[PUBLISHED_STEPS - 1] : NAN;
        table_add(&t, "%.90s", s->name);
        add_means(&t, s, last, Q_RMSE8);
        if (bins >= 0) {
            table_add_interval(&t, results_over_first(s, bins, last, false), "");
            table_add_interval(&t, (struct interval){printed, NAN, NAN}, "");
        }
    }
    table_end(&t);
}

static void all_cost_table(FILE *f, const struct results *r)
{
    struct table t = table_begin(f, "Squared error times seconds over that of %s after %ld spp, with its 95 %% "
                                 "interval; below 1 is a gain", r->plan->methods.item[0].text, plan_last_spp(r->plan));
    table_column(&t, "scene");
    add_method_columns(&t, r->plan, 1, "");
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        table_add(&t, "%.90s", s->name);
        add_costs(&t, s, plan_last_step(r->plan));
    }
    table_end(&t);
}

void tables_write(FILE *f, const struct results *r, const struct scene_results *s)
{
    if (s == NULL) {
        setup_table(f, r);
        all_rmse_table(f, r);
        all_cost_table(f, r);
        return;
    }
    rmse_table(f, s);
    printed_table(f, s);
    cost_table(f, s);
    bias_table(f, s);
    for (int i = 0; i < r->plan->n_sweeps; i++)
        sweep_table(f, s, &r->plan->sweep[i]);
}
