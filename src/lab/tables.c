/* tables.c: see tables.h. */
#include "lab/tables.h"

#include <math.h>
#include <stdio.h>

#include "lab/published.h"

static int last_step(const struct results *r) { return r->plan->n_steps - 1; }

/* --- cells ------------------------------------------------------------------------------------------- */

static void add_mean(struct table *t, const struct results *r, const struct scene_results *s, int variant, int step,
                     enum quantity q, double scale)
{
    struct estimate e = results_mean(s, plan_seeds(r->plan, variant), variant, step, q);
    table_add_estimate(t, scale * e.mean, scale * e.error);
}

static void add_ratio(struct table *t, struct interval i) { table_add_interval(t, i.value, i.low, i.high); }

static void add_missing(struct table *t, int n)
{
    for (int i = 0; i < n; i++)
        table_add(t, NAN, "-");
}

static void add_spp(struct table *t, long spp) { table_add(t, (double)spp, "%ld", spp); }

static void spp_columns(struct table *t, const struct results *r)
{
    for (int i = 0; i < r->plan->n_steps; i++) {
        char head[32];
        snprintf(head, sizeof head, "%ld spp", r->plan->spp[i]);
        table_column(t, head);
    }
}

/* --- tables of a scene ------------------------------------------------------------------------------- */

static void rmse_table(const struct results *r, const struct scene_results *s, struct table *t)
{
    table_begin(t, "RMSE on the 8-bit scale, mean over seeds and its standard error");
    table_column(t, "spp");
    for (int v = 0; v < N_METHODS; v++)
        table_column(t, VARIANTS[v].label);
    for (int i = 0; i < r->plan->n_steps; i++) {
        add_spp(t, r->plan->spp[i]);
        for (int v = 0; v < N_METHODS; v++)
            add_mean(t, r, s, v, i, Q_RMSE8, 1);
    }
}

/* Our step of that many samples, or -1. */
static int step_of(const struct results *r, long spp)
{
    for (int i = 0; i < r->plan->n_steps; i++)
        if (r->plan->spp[i] == spp)
            return i;
    return -1;
}

static void add_ours(struct table *t, const struct results *r, const struct scene_results *s, int step)
{
    if (step < 0) {
        add_missing(t, 3);
        return;
    }
    add_mean(t, r, s, VARIANT_BDPT, step, Q_RMSE8, 1);
    add_mean(t, r, s, VARIANT_BINS, step, Q_RMSE8, 1);
    add_ratio(t, results_rmse_ratio(r, s, VARIANT_BINS, step));
}

static void add_theirs(struct table *t, const struct published *p, int i)
{
    table_add(t, p->bdpt[i], "%.4f", p->bdpt[i]);
    table_add(t, p->asbdpt[i], "%.4f", p->asbdpt[i]);
    table_add(t, p->asbdpt[i] / p->bdpt[i], "%.3f", p->asbdpt[i] / p->bdpt[i]);
}

static bool published_table(const struct results *r, const struct scene_results *s, struct table *t)
{
    static const char *const heads[] = {
        "spp",           "BDPT, here",      "bins, here",          "bins/BDPT, here [95 %]",
        "BDPT, printed", "ASBDPT, printed", "ASBDPT/BDPT, printed"};
    const struct published *p = published_find(s->name);
    if (p == NULL)
        return false;
    table_begin(t, "RMSE beside the dissertation's (its model of the scene is another, so compare the ratios)");
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        table_column(t, heads[i]);
    for (int i = 0; i < r->plan->n_steps; i++) {
        if (r->plan->spp[i] >= published_spp(0))
            break;
        add_spp(t, r->plan->spp[i]);
        add_ours(t, r, s, i);
        add_missing(t, 3);
    }
    for (int i = 0; i < PUBLISHED_STEPS; i++) {
        add_spp(t, published_spp(i));
        add_ours(t, r, s, step_of(r, published_spp(i)));
        add_theirs(t, p, i);
    }
    return true;
}

static void equal_time_table(const struct results *r, const struct scene_results *s, struct table *t)
{
    table_begin(
        t, "Seconds of CPU, and squared error over BDPT's at equal time with its 95 % interval; below 1 is a gain");
    table_column(t, "spp");
    for (int v = 0; v < N_METHODS; v++) {
        char head[TABLE_CELL];
        snprintf(head, sizeof head, "%s, s", VARIANTS[v].label);
        table_column(t, head);
    }
    for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++)
        table_column(t, VARIANTS[v].label);
    for (int i = 0; i < r->plan->n_steps; i++) {
        add_spp(t, r->plan->spp[i]);
        for (int v = 0; v < N_METHODS; v++)
            add_mean(t, r, s, v, i, Q_SECONDS, 1);
        for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++)
            add_ratio(t, results_equal_time(r, s, v, i));
    }
}

static void bias_table(const struct results *r, const struct scene_results *s, struct table *t)
{
    char caption[512];
    snprintf(caption, sizeof caption,
             "Signed error of the picture's mean in percent, mean over seeds and its standard error "
             "(the reference's own standard error: %.2g %%)",
             100 * s->reference.mean_error);
    table_begin(t, caption);
    table_column(t, "method");
    spp_columns(t, r);
    for (int v = 0; v < N_METHODS; v++) {
        table_add(t, v, "%s", VARIANTS[v].label);
        for (int i = 0; i < r->plan->n_steps; i++)
            add_mean(t, r, s, v, i, Q_MEAN_ERROR, 100);
    }
}

static bool sweep_table(const struct results *r, const struct scene_results *s, enum sweep sweep, struct table *t)
{
    table_begin(t, sweep == SWEEP_PATHS ? "bins: RMSE on the 8-bit scale by paths per bin set (restart every 32)"
                                        : "bins: RMSE on the 8-bit scale by restart limit (8 paths per set)");
    table_column(t, sweep == SWEEP_PATHS ? "paths" : "restart");
    spp_columns(t, r);
    for (int k = 0; k < SWEEP_LENGTH; k++) {
        int v = sweep_variant(sweep, k);
        if (plan_seeds(r->plan, v) == 0)
            continue;
        table_add(t, k, "%s", sweep_label(sweep, k));
        for (int i = 0; i < r->plan->n_steps; i++)
            add_mean(t, r, s, v, i, Q_RMSE8, 1);
    }
    bool any = table_rows(t) > 1;
    if (!any)
        table_free(t);
    return any;
}

bool tables_scene(const struct results *r, const struct scene_results *s, enum scene_table which, struct table *out)
{
    switch (which) {
    case TABLE_RMSE: rmse_table(r, s, out); return true;
    case TABLE_PUBLISHED: return published_table(r, s, out);
    case TABLE_EQUAL_TIME: equal_time_table(r, s, out); return true;
    case TABLE_BIAS: bias_table(r, s, out); return true;
    case TABLE_PATHS: return sweep_table(r, s, SWEEP_PATHS, out);
    case TABLE_RESTART: return sweep_table(r, s, SWEEP_RESTART, out);
    case N_SCENE_TABLES: break;
    }
    return false;
}

/* --- tables of all scenes ---------------------------------------------------------------------------- */

static void setup_table(const struct results *r, struct table *t)
{
    static const char *const heads[] = {"scene",     "pixels",           "maxdepth",
                                        "reference", "its noise, 8-bit", "error of its mean, %"};
    table_begin(t, "What was measured, against what");
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        table_column(t, heads[i]);
    for (int i = 0; i < r->plan->n_scenes; i++) {
        const struct scene_results *s = &r->scene[i];
        table_add(t, NAN, "%.90s", s->name);
        table_add(t, (double)s->width * s->height, "%d x %d", s->width, s->height);
        table_add(t, s->max_depth, "%d", s->max_depth);
        table_add(t, NAN, "%.240s", s->reference.origin);
        table_add_estimate(t, s->reference.noise8, NAN);
        table_add_estimate(t, 100 * s->reference.mean_error, NAN);
    }
}

static void total_rmse_table(const struct results *r, struct table *t)
{
    char caption[256];
    int last = last_step(r);
    snprintf(caption, sizeof caption, "RMSE on the 8-bit scale after %ld spp; the dissertation's is after %ld spp",
             r->plan->spp[last], published_spp(PUBLISHED_STEPS - 1));
    table_begin(t, caption);
    table_column(t, "scene");
    for (int v = 0; v < N_METHODS; v++)
        table_column(t, VARIANTS[v].label);
    table_column(t, "bins/BDPT, here [95 %]");
    table_column(t, "ASBDPT/BDPT, printed");
    for (int i = 0; i < r->plan->n_scenes; i++) {
        const struct scene_results *s = &r->scene[i];
        const struct published *p = published_find(s->name);
        table_add(t, NAN, "%.90s", s->name);
        for (int v = 0; v < N_METHODS; v++)
            add_mean(t, r, s, v, last, Q_RMSE8, 1);
        add_ratio(t, results_rmse_ratio(r, s, VARIANT_BINS, last));
        if (p != NULL)
            table_add_interval(t, p->asbdpt[PUBLISHED_STEPS - 1] / p->bdpt[PUBLISHED_STEPS - 1], NAN, NAN);
        else
            add_missing(t, 1);
    }
}

static void total_equal_time_table(const struct results *r, struct table *t)
{
    char caption[256];
    int last = last_step(r);
    snprintf(caption, sizeof caption,
             "Squared error over BDPT's at equal time after %ld spp, with its 95 %% interval; below 1 is a gain",
             r->plan->spp[last]);
    table_begin(t, caption);
    table_column(t, "scene");
    for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++)
        table_column(t, VARIANTS[v].label);
    for (int i = 0; i < r->plan->n_scenes; i++) {
        table_add(t, NAN, "%.90s", r->scene[i].name);
        for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++)
            add_ratio(t, results_equal_time(r, &r->scene[i], v, last));
    }
}

void tables_total(const struct results *r, enum total_table which, struct table *out)
{
    switch (which) {
    case TOTAL_SETUP: setup_table(r, out); break;
    case TOTAL_RMSE: total_rmse_table(r, out); break;
    case TOTAL_EQUAL_TIME: total_equal_time_table(r, out); break;
    case N_TOTAL_TABLES: table_begin(out, ""); break;
    }
}
