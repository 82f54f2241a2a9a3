/* report.c: see report.h. */
#include "lab/report.h"

#include <math.h>
#include <string.h>

#include "lab/numbers.h"
#include "lab/text.h"
#include "lab/page.h"

#define PLUS_MINUS "\xc2\xb1" /* U+00B1 in UTF-8 */

/* Root mean square errors that the dissertation printed, on the 8-bit scale, against 16384 samples of pbrt-v3's bdpt,
 * in Bitterli's models, after 32, 64 ... 512 samples per pixel.                                             [S24 4] */
enum { PUBLISHED_STEPS = 5, PUBLISHED_FIRST = 32 };
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

/* What was printed of METHOD_PRINTED_BDPT or METHOD_PRINTED after so many samples; NaN: nothing. */
static double printed(const char *scene, const char *method, long spp)
{
    bool bdpt = strcmp(method, METHOD_PRINTED_BDPT) == 0, bins = strcmp(method, METHOD_PRINTED) == 0;
    for (size_t i = 0; (bdpt || bins) && i < sizeof PRINTED / sizeof PRINTED[0]; i++)
        for (int k = 0; strcmp(PRINTED[i].scene, scene) == 0 && k < PUBLISHED_STEPS; k++)
            if (spp == PUBLISHED_FIRST << k)
                return bdpt ? PRINTED[i].bdpt[k] : PRINTED[i].asbdpt[k];
    return NAN;
}

/* "mean +- error" with as many digits after the point as show two of the error's. */
static void add_estimate(struct md_table *t, double mean, double error)
{
    int digits = error > 0 && isfinite(error) ? 1 - (int)floor(log_ten(error)) : 0;
    digits = digits < 0 ? 0 : digits > 6 ? 6 : digits;
    if (!isfinite(mean))
        md_add_missing(t, 1);
    else if (!isfinite(error) || error == 0)
        md_add(t, "%.4g", mean);
    else
        md_add(t, "%.*f " PLUS_MINUS " %.*f", digits, mean, digits, error);
}

static void add_columns(struct md_table *t, const char *const *name, int n)
{
    for (int i = 0; i < n; i++)
        md_column(t, "%s", name[i]);
}

/* --- what was printed, and the same here --------------------------------------------------------------- */

static void add_number(struct md_table *t, double x, const char *format)
{
    if (isfinite(x))
        md_add(t, format, x);
    else
        md_add_missing(t, 1);
}

/* The ratio of the two printed methods after a step: printed and here. */
static void add_ratios(struct md_table *t, const struct scene_results *s, long spp, int step)
{
    int bins = methods_find(&s->plan->methods, METHOD_PRINTED);
    add_number(t, printed(s->name, METHOD_PRINTED, spp) / printed(s->name, METHOD_PRINTED_BDPT, spp), "%.3f");
    if (step >= 0)
        md_add_interval(t, results_over_first(s, bins, step, false), "");
    else
        md_add_missing(t, 1);
}

/* Can a page show both methods next to what was printed? Others are compared with the first, which must be bdpt. */
static bool has_printed(const struct plan *p)
{
    return methods_find(&p->methods, METHOD_PRINTED_BDPT) == 0 && methods_find(&p->methods, METHOD_PRINTED) > 0;
}

/* The last step of which something was printed, or the last one. */
static int printed_step(const struct scene_results *s)
{
    int step = plan_last_step(s->plan);
    while (step > 0 && isnan(printed(s->name, METHOD_PRINTED_BDPT, s->plan->spp[step])))
        step--;
    return isnan(printed(s->name, METHOD_PRINTED_BDPT, s->plan->spp[step])) ? plan_last_step(s->plan) : step;
}

static void findings_table(FILE *f, const struct results *r)
{
    struct md_table t = md_begin(f, "RMSE of bins over that of bdpt after the same samples, printed in chapter 4 of "
                                 "the dissertation and measured here, with its 95 %% interval; and what the mean of "
                                 "bins is off by");
    static const char *const heads[] = {"scene", "spp", "printed", "here", "mean off by, %"};
    add_columns(&t, heads, 5);
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        int step = printed_step(s), bins = methods_find(&r->plan->methods, METHOD_PRINTED);
        struct estimate off = results_mean(s, bins, plan_last_step(r->plan), Q_MEAN_ERROR);
        md_add(&t, "%.90s", s->name);
        md_add(&t, "%ld", r->plan->spp[step]);
        add_ratios(&t, s, r->plan->spp[step], step);
        add_estimate(&t, 100 * off.mean, 100 * off.error);
    }
    md_end(&t);
}

/* As a table of chapter 4: a row for a number of samples, of all that were printed or measured. */
static void chapter_table(FILE *f, const struct scene_results *s)
{
    static const char *const heads[] = {"spp", "bdpt, printed", "bdpt", "bins, printed", "bins",
                                        "bins over bdpt, printed", "bins over bdpt [95 %]"};
    const struct plan *p = s->plan;
    const char *const names[2] = {METHOD_PRINTED_BDPT, METHOD_PRINTED};
    struct md_table t = md_begin(f, "RMSE on the 8-bit scale, printed in the dissertation and measured here");
    add_columns(&t, heads, 7);
    long spp = 0;
    for (int step = 0; step < p->n_steps || 2 * spp <= PUBLISHED_FIRST << (PUBLISHED_STEPS - 1); step++) {
        bool measured = step < p->n_steps;
        spp = measured ? p->spp[step] : 2 * spp;
        md_add(&t, "%ld", spp);
        for (int i = 0; i < 2; i++) {
            struct estimate e = {NAN, NAN, 0};
            if (measured)
                e = results_mean(s, methods_find(&p->methods, names[i]), step, Q_RMSE8);
            add_number(&t, printed(s->name, names[i], spp), "%.4f");
            add_estimate(&t, e.mean, e.error);
        }
        add_ratios(&t, s, spp, measured ? step : -1);
    }
    md_end(&t);
}

/* --- the table --------------------------------------------------------------------------------------- */

/* A row is a method in a scene after a step. */
static struct md_table begin_rows(FILE *f)
{
    static const char *const heads[] = {"spp", "method", "RMSE", "over the first's [95 %]", "printed", "seconds",
                                        "cost over the first's [95 %]", "mean off by, %", "tested"};
    struct md_table t = md_begin(f, "RMSE on the 8-bit scale, mean over seeds and its standard error; printed: the "
                                 "dissertation's; cost: squared error times seconds of CPU");
    add_columns(&t, heads, 9);
    return t;
}

static void add_row(struct md_table *t, const struct scene_results *s, int method, int step)
{
    const struct plan *p = s->plan;
    double theirs = printed(s->name, p->methods.item[method].text, p->spp[step]);
    bool last = step == plan_last_step(p) && method < p->n_compared;
    struct estimate rmse = results_mean(s, method, step, Q_RMSE8), seconds = results_mean(s, method, step, Q_SECONDS);
    struct estimate off = results_mean(s, method, step, Q_MEAN_ERROR);
    md_add(t, "%s", p->methods.item[method].text);
    add_estimate(t, rmse.mean, rmse.error);
    if (method > 0)
        md_add_interval(t, results_over_first(s, method, step, false), "");
    else
        md_add_missing(t, 1);
    if (isfinite(theirs))
        md_add(t, "%.4f", theirs);
    else
        md_add_missing(t, 1);
    add_estimate(t, seconds.mean, seconds.error);
    if (method > 0)
        md_add_interval(t, results_over_first(s, method, step, true), "");
    else
        md_add_missing(t, 1);
    add_estimate(t, 100 * off.mean, 100 * off.error);
    md_add(t, "%s", last && s->mark[method] != MARK_NONE ? MARKS[s->mark[method]] : "-");
}

static void scene_table(FILE *f, const struct results *r, const struct scene_results *s)
{
    char own[32] = "not known";
    if (isfinite(s->reference.mean_error))
        snprintf(own, sizeof own, "%.2g %%", 100 * s->reference.mean_error);
    fprintf(f, "The standard error of the reference's own mean is %s.", own);
    for (int v = 0, n = 0; v < r->plan->n_compared; v++)
        if (isnan(results_doubt(s, v, plan_last_step(r->plan), SQUARE_MSE8)))
            fprintf(f, "%s%s", n++ > 0 ? ", " : " **Its noise is unknown or larger than what it judges; use more "
                    "--reference-spp:** ", r->plan->methods.item[v].text);
    fputs("\n\n", f);
    struct md_table t = begin_rows(f);
    for (int v = 0; v < r->plan->methods.n; v++)
        for (int i = 0; i < r->plan->n_steps; i++) {
            md_add(&t, "%ld", r->plan->spp[i]);
            add_row(&t, s, v, i);
        }
    md_end(&t);
}

static void setup_table(FILE *f, const struct results *r)
{
    static const char *const heads[] = {"scene",     "pixels",           "maxdepth",
                                        "reference", "its noise, 8-bit", "error of its mean, %"};
    struct md_table t = md_begin(f, "What was measured, against what");
    add_columns(&t, heads, 6);
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        md_add(&t, "%.90s", s->name);
        md_add(&t, "%d x %d", s->width, s->height);
        md_add(&t, "%d", s->max_depth);
        md_add(&t, "%.240s", s->reference.origin);
        add_estimate(&t, s->reference.noise8, NAN);
        add_estimate(&t, 100 * s->reference.mean_error, NAN);
    }
    md_end(&t);
}

/* --- the page ------------------------------------------------------------------------------------------ */

/* What the numbers mean; nothing here depends on the results. */
static const char NOTES[] =
    "## Notes\n\n"
    "- RMSE is the root mean square difference to the reference of all 8-bit sRGB values, 0 to 255, the\n"
    "  dissertation's scale; runs.csv also has squared errors: of these values, relative, and of 8x8 pixels.\n"
    "- Seconds are CPU seconds of all threads together, with the method's own preparation, without loading the scene.\n"
    "- A squared error falls as one over the time, so squared error times seconds is what a method spends on its\n"
    "  precision. It is of pairs of renders where there are three seeds, no --reference and no mark; else the\n"
    "  reference's own is subtracted, and there is none where that is unknown, or more than what is left.\n"
    "  `equal-time` gives all the same time instead.\n"
    "- Intervals are Welch's, at 95 %, on the logarithm of the ratio, over seeds. Few seeds give wide intervals.\n"
    "- Signed mean error: mean of the picture over mean of the reference, less 1. Tested: with two seeds or more each\n"
    "  method's mean and blocks of 8x8 pixels after the last step: significantly darker is \"misses light\", else\n"
    "  different is \"biased\". One page in a hundred has a false mark.\n"
    "- No walk is ended by Russian roulette here (rrthreshold 0) unless a method says otherwise, as in the\n"
    "  dissertation; by default methods use it and are faster. Box filter, balance heuristic.\n"
    "- The printed numbers are from the dissertation's own models and its own pbrt-v3, against 16384 samples of BDPT;\n"
    "  absolute values cannot agree with ours, the direction and shape of the ratios can. Its reference of Bathroom\n"
    "  does not match its pictures: BDPT's errors hardly fall.\n";

static void write_scene(FILE *f, const struct results *r, const struct scene_results *s)
{
    fprintf(f, "## %s\n\n", s->name);
    if (has_printed(r->plan) && isfinite(printed(s->name, METHOD_PRINTED_BDPT, PUBLISHED_FIRST)))
        chapter_table(f, s);
    scene_table(f, r, s);
}

static void write_page(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    fprintf(f, "# Methods measured\n\n%d scene%s, %ld to %ld samples per pixel, %d seed%s; "
            "[runs.csv](runs.csv) has every run, [report.html](report.html) curves and pictures.\n\n",
            p->n_scenes, p->n_scenes == 1 ? "" : "s", p->spp[0], plan_last_spp(p), p->n_seeds,
            p->n_seeds == 1 ? "" : "s");
    if (has_printed(p))
        findings_table(f, r);
    plan_write_command(f, p);
    setup_table(f, r);
    for (int i = 0; i < p->n_scenes; i++)
        write_scene(f, r, &r->scene[i]);
    fputs(NOTES, f);
}

bool report_write(const struct results *r, struct error *err)
{
    return results_write(r, "runs.csv", results_csv, err) && results_write(r, "results.md", write_page, err) &&
           page_write(r, "Chapter 4 and appendix A of the dissertation, measured again", "results.md", printed, err);
}
