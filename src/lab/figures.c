/* figures.c: see figures.h. */
#include "lab/figures.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *figure_name(enum figure f)
{
    switch (f) {
    case FIGURE_CONVERGENCE: return "convergence";
    case FIGURE_BIAS: return "bias";
    case FIGURE_PATHS: return "paths-per-set";
    case FIGURE_RESTART: return "restart-limit";
    case N_FIGURES: break;
    }
    return "";
}

/* One line: a variant's quantity against seconds or samples. */
static void add_line(const struct results *r, const struct scene_results *s, int variant, bool over_seconds,
                     enum quantity q, double scale, struct plot *out)
{
    struct plot_line *l = &out->line[out->n++];
    int seeds = plan_seeds(r->plan, variant);
    l->label = VARIANTS[variant].label;
    l->n = r->plan->n_steps;
    for (int i = 0; i < l->n; i++) {
        struct estimate e = results_mean(s, seeds, variant, i, q);
        l->x[i] = over_seconds ? results_mean(s, seeds, variant, i, Q_SECONDS).mean : (double)r->plan->spp[i];
        l->y[i] = scale * e.mean;
        l->error[i] = scale * e.error;
    }
}

static void add_methods(const struct results *r, const struct scene_results *s, bool over_seconds, enum quantity q,
                        double scale, struct plot *out)
{
    for (int v = 0; v < N_METHODS; v++)
        add_line(r, s, v, over_seconds, q, scale, out);
}

static bool add_sweep(const struct results *r, const struct scene_results *s, enum sweep sweep, struct plot *out)
{
    add_line(r, s, VARIANT_BDPT, false, Q_RMSE8, 1, out);
    for (int i = 0; i < SWEEP_LENGTH; i++) {
        int v = sweep_variant(sweep, i);
        if (plan_seeds(r->plan, v) == 0)
            continue;
        add_line(r, s, v, false, Q_RMSE8, 1, out);
        out->line[out->n - 1].label = sweep_label(sweep, i);
    }
    return out->n > 2;
}

static void set_text(struct figure_text *t, const char *title, const char *x, const char *y)
{
    snprintf(t->title, sizeof t->title, "%s", title);
    snprintf(t->x_label, sizeof t->x_label, "%s", x);
    snprintf(t->y_label, sizeof t->y_label, "%s", y);
}

/* What the plot shows at its right end, in words. */
static void describe(const struct plot *p, struct figure_text *t)
{
    int n = snprintf(t->description, sizeof t->description, "%s against %s. Last points:", t->y_label, t->x_label);
    for (int k = 0; k < p->n && n < (int)sizeof t->description; k++) {
        const struct plot_line *l = &p->line[k];
        n += snprintf(t->description + n, sizeof t->description - (size_t)n, "%s %s %.4g at %.4g", k > 0 ? "," : "",
                      l->label, l->y[l->n - 1], l->x[l->n - 1]);
    }
}

bool figure_make(const struct results *r, const struct scene_results *s, enum figure f, struct plot *out,
                 struct figure_text *text)
{
    static const char rmse[] = "RMSE, 8-bit scale";
    bool shown = true;
    memset(out, 0, sizeof *out);
    out->log_x = out->log_y = true;
    out->data_ticks = f != FIGURE_CONVERGENCE; /* numbers of samples */
    switch (f) {
    case FIGURE_CONVERGENCE:
        set_text(text, "error against time", "seconds of CPU", rmse);
        add_methods(r, s, true, Q_RMSE8, 1, out);
        break;
    case FIGURE_BIAS:
        set_text(text, "signed mean error against samples", "samples per pixel", "mean error, percent");
        out->log_y = false;
        out->zero_line = true;
        add_methods(r, s, false, Q_MEAN_ERROR, 100, out);
        break;
    case FIGURE_PATHS:
        set_text(text, "paths per bin set", "samples per pixel", rmse);
        shown = add_sweep(r, s, SWEEP_PATHS, out);
        break;
    case FIGURE_RESTART:
        set_text(text, "restart limit", "samples per pixel", rmse);
        shown = add_sweep(r, s, SWEEP_RESTART, out);
        break;
    case N_FIGURES: return false;
    }
    char title[400];
    snprintf(title, sizeof title, "%.255s: %.99s", s->name, text->title);
    snprintf(text->title, sizeof text->title, "%s", title);
    describe(out, text);
    out->title = text->title;
    out->description = text->description;
    out->x_label = text->x_label;
    out->y_label = text->y_label;
    return shown;
}
