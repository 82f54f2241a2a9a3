/* report.c: see report.h. */
#include "lab/report.h"

#include "lab/figures.h"
#include "lab/pictures.h"
#include "lab/tables.h"

/* What the numbers mean; nothing here depends on the results. */
static const char NOTES[] =
    "## Notes\n\n"
    "- RMSE is the root mean square difference to the reference of all 8-bit sRGB values, 0 to 255, the\n"
    "  dissertation's scale; results.csv also has it on linear values, and the relative squared error.\n"
    "- Seconds are CPU seconds of all threads together, with the method's own preparation, without loading the scene.\n"
    "- A squared error falls as one over the time, so squared error times seconds is what a method pays for its\n"
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

static void write_scene(FILE *f, const struct results *r, const struct scene_results *s)
{
    fprintf(f, "## %s\n\n![The reference, each method's picture and below it where it errs](images/%s.png)\n\n",
            s->name, s->name);
    tables_write(f, r, s);
    for (int k = 0; k < figure_count(r->plan); k++) {
        char path[512];
        figure_path(s, k, path, sizeof path);
        fprintf(f, "![%s](%s)\n", path, path);
    }
    fprintf(f, "\nBars: one standard error over seeds. The strategies of %s, one by one: `./asbdpt-lab strategies %s "
            "-o DIR`.\n\n", METHOD_REFERENCE, s->path);
}

static void write_page(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    fprintf(f, "# Methods measured\n\n%d scene%s, %ld to %ld samples per pixel, %d seed%s; "
            "[results.csv](results.csv) has means, [runs.csv](runs.csv) every run.\n\n",
            p->n_scenes, p->n_scenes == 1 ? "" : "s", p->spp[0], plan_last_spp(p), p->n_seeds,
            p->n_seeds == 1 ? "" : "s");
    plan_write_command(f, p);
    tables_write(f, r, NULL);
    for (int i = 0; i < p->n_scenes; i++)
        write_scene(f, r, &r->scene[i]);
    fputs(NOTES, f);
}

static bool write_plots(const struct scene_results *s, struct error *err)
{
    for (int k = 0; k < figure_count(s->plan); k++) {
        struct file_output f;
        char path[512];
        figure_path(s, k, path, sizeof path);
        if (!plan_create(s->plan, path, &f, err))
            return false;
        figure_write(f.stream, s, k);
        if (!file_commit(&f, err))
            return false;
    }
    return true;
}

bool report_write(const struct results *r, struct error *err)
{
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!pictures_write(&r->scene[i], err) || !write_plots(&r->scene[i], err))
            return false;
    return results_write(r, "results.csv", results_csv, err) && results_write(r, "runs.csv", results_runs_csv, err) &&
           results_write(r, "results.md", write_page, err);
}
