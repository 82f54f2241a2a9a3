/* report.c: see report.h. */
#include "lab/report.h"

#include <math.h>
#include <stdlib.h>

#include "base/file.h"
#include "lab/figures.h"
#include "lab/findings.h"
#include "look/markup.h"
#include "lab/page.h"
#include "lab/pictures.h"
#include "lab/published.h"
#include "lab/tables.h"

/* --- what the page and the Markdown share ------------------------------------------------------------ */

/* Findings about a scene, or about all scenes for NULL. */
static void write_findings(FILE *f, const struct results *r, const struct scene_results *s, bool html)
{
    struct findings list;
    findings_make(r, s, &list);
    fputs(html ? "<ul>\n" : "", f);
    for (int i = 0; i < list.n; i++)
        if (html)
            xml_print(f, "<li>%s</li>\n", list.text[i]);
        else
            fprintf(f, "- %s\n", list.text[i]);
    fputs(html ? "</ul>\n" : "\n", f);
}

/* The command that makes these results again. */
static void write_command(FILE *f, const struct plan *p, const char *margin, bool html)
{
    char how[64];
    snprintf(how, sizeof how, "--%s --spp %ld", p->quick ? "quick" : "full", plan_last_spp(p));
    plan_command(f, p, how, margin, html);
}

static void write_lead(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    fprintf(f,
            "BDPT and four ways in which ASBDPT chooses light sub-paths (bins, the dissertation's; pool and vertices, "
            "its repairs; subspaces, the default) in %d scene%s, each rendered to %ld, doubled up to %ld, samples per "
            "pixel with %d seed%s per method (1 for the parameter sweeps) and compared with a reference. Box filter, "
            "balance heuristic.",
            p->n_scenes, p->n_scenes == 1 ? "" : "s", p->spp[0], plan_last_spp(p), p->n_seeds,
            p->n_seeds == 1 ? "" : "s");
}

/* What the numbers mean; nothing here depends on the results. */
static const char *const NOTES[] = {
    "RMSE is the root mean square difference to the reference of all 8-bit sRGB values, 0 to 255, the dissertation's "
    "scale; results.csv also has it on linear values, and the relative squared error.",
    "Seconds are CPU seconds of all threads together, with the method's own preparation, without loading the scene.",
    "Equal time: BDPT's squared error falls as one over its time, so (MSE - noise^2) x seconds, divided by the same of "
    "BDPT, is the ratio of squared errors when both are given the same time. noise^2 is the squared error of the "
    "reference itself, where known.",
    "Intervals are Welch's, at 95 %, on the logarithm of the ratio, over seeds. Few seeds give wide intervals.",
    "Signed mean error: mean of the picture over mean of the reference, less 1. Without bias it scatters around 0.",
    "No walk is ended by Russian roulette here (rrthreshold 0), as in the dissertation; by default all methods use it "
    "and are faster.",
    "The printed numbers are from the dissertation's own models and its own pbrt-v3, against 16384 samples of BDPT; "
    "absolute values cannot agree with ours, the direction and shape of the ratios can.",
};

/* --- pictures ---------------------------------------------------------------------------------------- */

static const char *subject(int variant) { return variant == PICTURE_REFERENCE ? "reference" : VARIANTS[variant].label; }

/* The first seed's error after all samples: the one of the picture shown. */
static double shown_rmse(const struct scene_results *s, int variant)
{
    return s->run[variant][0].step[plan_last_step(s->plan)].value[Q_RMSE8];
}

static void write_alt(FILE *f, const struct scene_results *s, int variant, bool error, int detail)
{
    if (detail > 0)
        fprintf(f, "Detail %d: ", detail);
    if (error)
        xml_print(f, "%s, error of %s against the reference, dark none, bright largest", s->name, subject(variant));
    else
        xml_print(f, "%s rendered by %s%s", s->name, variant == PICTURE_REFERENCE ? "the " : "", subject(variant));
    if (variant != PICTURE_REFERENCE)
        fprintf(f, ", %ld samples per pixel, RMSE %.3g", plan_last_spp(s->plan), shown_rmse(s, variant));
}

/* The src of an img, with a PNG file inside the page. */
static bool write_source(FILE *f, const char *path, struct error *err)
{
    uint8_t *data;
    size_t size;
    if (!file_read(path, &data, &size, err))
        return false;
    fputs(" src=\"data:image/png;base64,", f);
    base64(f, data, size);
    fputs("\"", f);
    free(data);
    return true;
}

/* What the viewer finds a picture by. */
static void write_data(FILE *f, const struct scene_results *s, int variant, const char *kind)
{
    xml_print(f, " data-scene=\"%s\" data-kind=\"%s\" data-label=\"%s\"", s->name, kind, subject(variant));
}

/* A picture's range, for the viewer alone. */
static bool write_range(FILE *f, const struct scene_results *s, int variant, struct error *err)
{
    char path[4096];
    picture_path(s, variant, PICTURE_RANGE, 0, path, sizeof path);
    fprintf(f, "<img alt=\"the range of %s\" hidden", subject(variant));
    write_data(f, s, variant, "range");
    bool ok = write_source(f, path, err);
    fputs(">\n", f);
    return ok;
}

/* One picture as a figure, its file inside the page. Whole pictures are also offered to the viewer. */
static bool write_picture(FILE *f, const struct scene_results *s, int variant, bool error,
                          int detail, struct error *err)
{
    char path[4096];
    fputs("<figure><img alt=\"", f);
    write_alt(f, s, variant, error, detail);
    fputs("\"", f);
    if (detail == 0)
        write_data(f, s, variant, error ? "error" : "picture");
    picture_path(s, variant, error ? PICTURE_ERROR : PICTURE_ITSELF, detail, path, sizeof path);
    if (!write_source(f, path, err))
        return false;
    fprintf(f, "><figcaption>%s%s", subject(variant), error ? ": error" : "");
    if (variant != PICTURE_REFERENCE && detail == 0 && !error)
        fprintf(f, ", RMSE %.3f", shown_rmse(s, variant));
    fputs("</figcaption></figure>\n", f);
    return true;
}

/* A row of pictures: all variants, with or without the reference. */
static bool write_row(FILE *f, const struct scene_results *s, bool error, int detail, struct error *err)
{
    bool ok = true;
    fputs("<div class=\"grid\">\n", f);
    for (int v = error ? 0 : PICTURE_REFERENCE; ok && v < N_COMPARED; v++)
        ok = write_picture(f, s, v, error, detail, err) &&
             (error || detail > 0 || write_range(f, s, v, err));
    fputs("</div>\n", f);
    return ok;
}

static bool write_pictures(FILE *f, const struct scene_results *s, struct error *err)
{
    struct detail detail[N_DETAILS];
    pictures_find_details(s, detail);
    xml_print(f, "<h3>Pictures, %ld samples per pixel</h3>\n<div class=\"viewer\" data-scene=\"%s\" hidden></div>\n",
              plan_last_spp(s->plan), s->name);
    if (!write_row(f, s, false, 0, err))
        return false;
    fprintf(f,
            "<h3>Where the errors are</h3>\n"
            "<p class=\"scale\"><span>0</span><i></i><span>%.4g of 255 and more; 99 %% of all pixels err less</span>"
            "</p>\n",
            pictures_error_scale(s));
    bool ok = write_row(f, s, true, 0, err);
    for (int i = 1; ok && i <= N_DETAILS; i++) {
        const struct detail *d = &detail[i - 1];
        fprintf(f, "<p class=\"note\">Detail %d: %d x %d pixels at (%d, %d), where BDPT errs %smost.</p>\n", i,
                d->width, d->height, d->x, d->y, i == 1 ? "" : "next ");
        ok = write_row(f, s, false, i, err) && write_row(f, s, true, i, err);
    }
    return ok;
}

/* --- the page ---------------------------------------------------------------------------------------- */

static void write_plots(FILE *f, const struct scene_results *s, int number)
{
    fputs("<h3>Plots</h3>\n<p class=\"note\">Bars: one standard error over seeds.</p>\n<div class=\"plots\">\n", f);
    for (int k = 0; k < N_FIGURES; k++) {
        char id[300];
        snprintf(id, sizeof id, "plot%d-%s", number, figure_name((enum figure)k));
        fputs("<figure>", f);
        figure_write(f, s, (enum figure)k, id, false);
        fputs("</figure>\n", f);
    }
    fputs("</div>\n", f);
}

static bool write_strategies(FILE *f, const struct scene_results *s, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/images/%s-strategies.png", s->plan->directory, s->name);
    xml_print(f,
              "<h3>Strategies of BDPT</h3>\n<figure class=\"strategies\"><img alt=\"%s: a row of pictures for each "
              "path length, each strategy by itself\"",
              s->name);
    if (!write_source(f, path, err))
        return false;
    fputs("><figcaption>Strategy s has s vertices of its path from the light, the others from the lens. Above each by "
          "itself, below what the weights leave of it, which adds up to the picture; each row is brightened by the "
          "factor beside it.</figcaption></figure>\n", f);
    return true;
}

static bool write_scene(FILE *f, const struct results *r, int number, struct error *err)
{
    const struct scene_results *s = &r->scene[number];
    xml_print(f,
              "<section id=\"scene-%s\">\n<h2>%s</h2>\n"
              "<p class=\"note\">%d x %d pixels, paths up to maxdepth %d. Reference: %s.</p>\n",
              s->name, s->name, s->width, s->height, s->max_depth, s->reference.origin);
    write_findings(f, r, s, true);
    if (!write_pictures(f, s, err) || !write_strategies(f, s, err))
        return false;
    write_plots(f, s, number);
    fputs("<h3>Tables</h3>\n", f);
    tables_write(f, r, s, true);
    fputs("</section>\n", f);
    return true;
}

static void write_head(FILE *f, const struct results *r)
{
    fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>asbdpt: experiment</title>\n<style>\n",
          f);
    figure_style(f);
    page_style(f);
    fputs("</style>\n</head>\n<body>\n<header>\n<h1>Alias Sampled Bidirectional Path Tracing, measured</h1>\n"
          "<p class=\"lead\">",
          f);
    write_lead(f, r);
    fputs("</p>\n<p>The numbers: <a href=\"results.csv\">results.csv</a> (means and standard errors over seeds), "
          "<a href=\"runs.csv\">runs.csv</a> (every run).</p>\n"
          "<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#all\">All scenes</a></li>\n",
          f);
    for (int i = 0; i < r->plan->n_scenes; i++)
        xml_print(f, "<li><a href=\"#scene-%s\">%s</a></li>\n", r->scene[i].name, r->scene[i].name);
    fputs("<li><a href=\"#how\">How to read and repeat this</a></li>\n</ul></nav>\n</header>\n<main>\n", f);
}

static void write_how(FILE *f, const struct results *r)
{
    const double *bathroom = published_find("bathroom")->bdpt;
    long first = published_spp(0), last = published_spp(PUBLISHED_STEPS - 1);
    fputs("<section id=\"how\">\n<h2>How to read and repeat this</h2>\n<ul>\n", f);
    for (size_t i = 0; i < sizeof NOTES / sizeof NOTES[0]; i++)
        xml_print(f, "<li>%s</li>\n", NOTES[i]);
    fprintf(f,
            "<li>The printed Bathroom errors fall only from %.2f to %.2f between %ld and %ld samples for BDPT, where "
            "an unbiased method's fall to %.2f: that reference does not match its pictures.</li>\n</ul>\n",
            bathroom[0], bathroom[PUBLISHED_STEPS - 1], first, last, bathroom[0] / sqrt((double)last / (double)first));
    fputs("<p>The same results, up to the times:</p>\n<pre>", f);
    write_command(f, r->plan, "", true);
    fputs("</pre>\n<p>Beside this page: the pictures in <code>images/</code>, the plots in <code>plots/</code>, the "
          "sentences and tables in <a href=\"results.md\">results.md</a>.</p>\n</section>\n", f);
}

static bool write_html(FILE *f, const struct results *r, struct error *err)
{
    write_head(f, r);
    fputs("<section id=\"all\">\n<h2>All scenes</h2>\n", f);
    write_findings(f, r, NULL, true);
    tables_write(f, r, NULL, true);
    fputs("</section>\n", f);
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!write_scene(f, r, i, err))
            return false;
    write_how(f, r);
    fputs("</main>\n<script>\n", f);
    page_script(f);
    fputs("</script>\n</body>\n</html>\n", f);
    return true;
}

/* Sentences and tables only. */
static void write_markdown(FILE *f, const struct results *r)
{
    fputs("# Alias Sampled Bidirectional Path Tracing, measured\n\n", f);
    write_lead(f, r);
    fputs("\n\n", f);
    write_command(f, r->plan, "    ", false);
    fputs("\n", f);
    write_findings(f, r, NULL, false);
    tables_write(f, r, NULL, false);
    for (int i = 0; i < r->plan->n_scenes; i++) {
        fprintf(f, "## %s\n\n", r->scene[i].name);
        write_findings(f, r, &r->scene[i], false);
        tables_write(f, r, &r->scene[i], false);
    }
    fputs("## Notes\n\n", f);
    for (size_t i = 0; i < sizeof NOTES / sizeof NOTES[0]; i++)
        fprintf(f, "- %s\n", NOTES[i]);
}

/* --- files ------------------------------------------------------------------------------------------- */

static bool write_file(const struct results *r, const char *name, void (*write)(FILE *, const struct results *),
                       struct error *err)
{
    struct file_output f;
    if (!plan_create(r->plan, name, &f, err))
        return false;
    write(f.stream, r);
    return file_commit(&f, err);
}

static bool write_plot_files(const struct scene_results *s, struct error *err)
{
    for (int k = 0; k < N_FIGURES; k++) {
        struct file_output f;
        char name[400];
        snprintf(name, sizeof name, "plots/%s-%s.svg", s->name, figure_name((enum figure)k));
        if (!plan_create(s->plan, name, &f, err))
            return false;
        figure_write(f.stream, s, (enum figure)k, "plot", true);
        if (!file_commit(&f, err))
            return false;
    }
    return true;
}

static bool write_page_file(const struct results *r, struct error *err)
{
    struct file_output f;
    if (!plan_create(r->plan, "report.html", &f, err))
        return false;
    if (write_html(f.stream, r, err))
        return file_commit(&f, err);
    file_abandon(&f);
    return false;
}

bool report_write(const struct results *r, struct error *err)
{
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!pictures_write(&r->scene[i], err) || !write_plot_files(&r->scene[i], err))
            return false;
    return write_file(r, "results.csv", results_csv, err) && write_file(r, "runs.csv", results_runs_csv, err) &&
           write_file(r, "results.md", write_markdown, err) && write_page_file(r, err);
}
