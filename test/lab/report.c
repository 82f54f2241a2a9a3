/* report.c: see report.h. */
#include "lab/report.h"

#include <math.h>

#include "lab/pictures.h"
#include "lab/plot.h"
#include "lab/tables.h"

/* What the numbers mean; nothing here depends on the results. */
static const char NOTES[] =
    "## Notes\n\n"
    "- RMSE is the root mean square difference to the reference of all 8-bit sRGB values, 0 to 255, the\n"
    "  dissertation's scale; runs.csv also has squared errors: of these values, relative, and of 8x8 pixels.\n"
    "- Seconds are CPU seconds of all threads together, with the method's own preparation, without loading the scene.\n"
    "- A squared error falls as one over the time, so squared error times seconds is what a method spends on its\n"
    "  precision; the squared error of the reference itself is subtracted where known. `equal-time` gives all the\n"
    "  same time instead.\n"
    "- Intervals are Welch's, at 95 %, on the logarithm of the ratio, over seeds. Few seeds give wide intervals.\n"
    "- Signed mean error: mean of the picture over mean of the reference, less 1. Tested: with two seeds or more each\n"
    "  method's mean and blocks of 8x8 pixels after the last step: significantly darker is \"misses light\", else\n"
    "  different is \"biased\". One page in a hundred has a false mark.\n"
    "- No walk is ended by Russian roulette here (rrthreshold 0) unless a method says otherwise, as in the\n"
    "  dissertation; by default methods use it and are faster. Box filter, balance heuristic.\n"
    "- The printed numbers are from the dissertation's own models and its own pbrt-v3, against 16384 samples of BDPT;\n"
    "  absolute values cannot agree with ours, the direction and shape of the ratios can. Its reference of Bathroom\n"
    "  does not match its pictures: BDPT's errors hardly fall.\n";

/* --- plots -------------------------------------------------------------------------------------------- */

/* A scene's figure: panels two by two, each a quantity of some methods after a rising number of samples. */
enum { LEFT = 68, TOP = 44, WIDTH = 290, HEIGHT = 230, ACROSS = 380, DOWN = 300, KEYS = 20 };

struct panel {
    const char *title, *y_label;
    enum quantity quantity;
    bool over_seconds;
    const struct sweep *sweep; /* its methods, and the first; NULL: what is compared */
};

/* Points of a method in a panel. */
struct curve {
    int method, n;
    double x[PLAN_MAX_STEPS], y[PLAN_MAX_STEPS], error[PLAN_MAX_STEPS];
};

static struct curve curve_of(const struct scene_results *s, const struct panel *panel, int number)
{
    int method = panel->sweep == NULL || number == 0 ? number : panel->sweep->method[number - 1];
    struct curve c = {.method = method, .n = s->plan->n_steps};
    for (int i = 0; i < c.n; i++) {
        struct estimate e = results_mean(s, method, i, panel->quantity);
        double scale = panel->quantity == Q_MEAN_ERROR ? 100 : 1; /* per cent */
        c.x[i] = panel->over_seconds ? results_mean(s, method, i, Q_SECONDS).mean : (double)s->plan->spp[i];
        c.y[i] = scale * e.mean;
        c.error[i] = isfinite(e.error) ? scale * e.error : 0;
    }
    return c;
}

static int curves_of(const struct scene_results *s, const struct panel *panel)
{
    return panel->sweep != NULL ? 1 + panel->sweep->n : s->plan->n_compared;
}

/* Both axes hold all points; the axis of a signed error is linear and holds 0. */
static void choose_axes(struct plot *p, const struct scene_results *s, const struct panel *panel)
{
    bool is_signed = panel->quantity == Q_MEAN_ERROR;
    double x0 = HUGE_VAL, x1 = 0, y0 = is_signed ? 0 : HUGE_VAL, y1 = 0;
    for (int k = 0; k < curves_of(s, panel); k++) {
        struct curve c = curve_of(s, panel, k);
        for (int i = 0; i < c.n; i++) {
            x0 = fmin(x0, c.x[i]);
            x1 = fmax(x1, c.x[i]);
            if (is_signed || c.y[i] > 0)
                y0 = fmin(y0, is_signed ? c.y[i] - c.error[i] : fmax(c.y[i] - c.error[i], 0.2 * c.y[i]));
            y1 = fmax(y1, c.y[i] + c.error[i]);
        }
    }
    p->x = axis_make(true, x0, x1);
    p->y = axis_make(!is_signed, y0, y1);
    for (int i = 0; !panel->over_seconds && i < s->plan->n_steps; i++) {
        p->x.tick[i] = (double)s->plan->spp[i];
        p->x.n_ticks = i + 1;
    }
}

static void draw_panel(struct plot *p, const struct scene_results *s, const struct panel *panel, int left, int top)
{
    choose_axes(p, s, panel);
    plot_panel(p, left, top, WIDTH, HEIGHT, panel->over_seconds ? "seconds of CPU" : "samples per pixel",
               panel->y_label);
    plot_text(p, left, top - 8, "start", 0, panel->title);
    for (int k = 0; k < curves_of(s, panel); k++) {
        struct curve c = curve_of(s, panel, k);
        plot_line(p, c.method, c.n, c.x, c.y);
        for (int i = 0; i < c.n; i++)
            plot_point(p, plot_colour(c.method), c.method, c.x[i], c.y[i], c.y[i] - c.error[i], c.y[i] + c.error[i],
                       false, s->plan->methods.item[c.method].text);
    }
}

static void draw_scene(FILE *f, const struct scene_results *s)
{
    static const char rmse[] = "RMSE, 8-bit scale";
    struct panel panel[3 + PLAN_MAX_SWEEPS] = {{"error against time", rmse, Q_RMSE8, true, NULL},
                                               {"error against samples", rmse, Q_RMSE8, false, NULL},
                                               {"signed error of the mean", "per cent", Q_MEAN_ERROR, false, NULL}};
    int n = 3 + s->plan->n_sweeps, rows = (n + 1) / 2, methods = s->plan->methods.n;
    for (int i = 3; i < n; i++)
        panel[i] = (struct panel){s->plan->sweep[i - 3].text, rmse, Q_RMSE8, false, &s->plan->sweep[i - 3]};
    struct plot p = plot_begin(f, 2 * ACROSS, rows * DOWN + KEYS * (1 + (methods + 1) / 2) + TOP, s->name);
    for (int i = 0; i < n; i++)
        draw_panel(&p, s, &panel[i], LEFT + i % 2 * ACROSS, TOP + i / 2 * DOWN);
    for (int v = 0; v < methods; v++)
        plot_key(&p, v, LEFT + v % 2 * ACROSS, TOP + rows * DOWN + KEYS * (v / 2), s->plan->methods.item[v].text);
    plot_end(&p);
}

static bool write_plot(const struct scene_results *s, struct error *err)
{
    struct file_output f;
    char name[300];
    snprintf(name, sizeof name, "plots/%s.svg", s->name);
    if (!plan_create(s->plan, name, &f, err))
        return false;
    draw_scene(f.stream, s);
    return file_commit(&f, err);
}

/* --- the page ------------------------------------------------------------------------------------------ */

static void write_scene(FILE *f, const struct results *r, const struct scene_results *s)
{
    fprintf(f, "## %s\n\n![Each method's picture and below it where it errs, and the reference](images/%s.png)\n\n",
            s->name, s->name);
    tables_write(f, r, s);
    fprintf(f, "![Errors after a rising number of samples](plots/%s.svg)\n", s->name);
    fprintf(f, "\nBars: one standard error over seeds. The strategies of %s, one by one: `./asbdpt-lab strategies %s "
            "-o DIR`.\n\n", METHOD_REFERENCE, s->path);
}

static void write_page(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    fprintf(f, "# Methods measured\n\n%d scene%s, %ld to %ld samples per pixel, %d seed%s; "
            "[runs.csv](runs.csv) has every run.\n\n",
            p->n_scenes, p->n_scenes == 1 ? "" : "s", p->spp[0], plan_last_spp(p), p->n_seeds,
            p->n_seeds == 1 ? "" : "s");
    plan_write_command(f, p);
    tables_write(f, r, NULL);
    for (int i = 0; i < p->n_scenes; i++)
        write_scene(f, r, &r->scene[i]);
    fputs(NOTES, f);
}

bool report_write(const struct results *r, struct error *err)
{
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!pictures_write(&r->scene[i], err) || !write_plot(&r->scene[i], err))
            return false;
    return results_write(r, "runs.csv", results_csv, err) && results_write(r, "results.md", write_page, err);
}
