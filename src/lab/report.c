/* report.c: see report.h. The page's CSS and JavaScript are in report_style.c and report_script.c. */
#include "lab/report.h"

#include <math.h>
#include <stdlib.h>

#include "lab/figures.h"
#include "base/file.h"
#include "lab/findings.h"
#include "lab/markup.h"
#include "lab/pictures.h"
#include "lab/published.h"
#include "lab/tables.h"

/* --- pieces ------------------------------------------------------------------------------------------ */

static void paragraph(FILE *f, const char *tag, const char *text)
{
    fprintf(f, "<%s>", tag);
    xml_text(f, text);
    fprintf(f, "</%s>\n", tag);
}

static void write_findings(FILE *f, const struct findings *list)
{
    fputs("<ul>\n", f);
    for (int i = 0; i < list->n; i++)
        paragraph(f, "li", list->text[i]);
    fputs("</ul>\n", f);
}

/* The command that makes these results again. */
static void write_command(FILE *f, const struct results *r, void (*text)(FILE *, const char *))
{
    const struct plan *p = r->plan;
    fprintf(f, "./asbdpt experiment --%s --res %d", p->quick ? "quick" : "full", p->width);
    if (p->height > 0)
        fprintf(f, "x%d", p->height);
    fprintf(f, " --spp %ld --seeds %d --reference-spp %ld", p->spp[p->n_steps - 1], p->n_seeds, p->reference_spp);
    if (p->max_depth > 0)
        fprintf(f, " --maxdepth %d", p->max_depth);
    if (p->reference != NULL) {
        fputs(" --reference ", f);
        text(f, p->reference);
    }
    fputs(" -o ", f);
    text(f, p->directory);
    for (int i = 0; i < p->n_scenes; i++) {
        fputs(i % 3 == 0 ? " \\\n    " : " ", f);
        text(f, p->scene[i]);
    }
    fputs("\n", f);
}

static const char *subject(int variant)
{
    return variant == PICTURE_REFERENCE ? "reference" : VARIANTS[variant].label;
}

/* The first seed's error after all samples: the one of the picture shown. */
static double shown_rmse(const struct results *r, const struct scene_results *s, int variant)
{
    return s->run[variant][0].step[r->plan->n_steps - 1].rmse8;
}

static void write_alt(FILE *f, const struct results *r, const struct scene_results *s, int variant, bool error,
                      int detail)
{
    if (detail > 0)
        fprintf(f, "Detail %d: ", detail);
    xml_text(f, s->name);
    if (error)
        fprintf(f, ", error of %s against the reference, blue none, green largest", subject(variant));
    else
        fprintf(f, " rendered by %s", variant == PICTURE_REFERENCE ? "the reference" : subject(variant));
    if (variant != PICTURE_REFERENCE)
        fprintf(f, ", %ld samples per pixel, RMSE %.3g", r->plan->spp[r->plan->n_steps - 1],
                shown_rmse(r, s, variant));
}

/* One picture as a figure, its file inside the page. Whole pictures are also offered to the viewer. */
static bool write_picture(FILE *f, const struct results *r, const struct scene_results *s, int variant, bool error,
                          int detail, struct error *err)
{
    char path[4096];
    uint8_t *data;
    size_t size;
    picture_path(r, s, variant, error, detail, path, sizeof path);
    if (!file_read(path, &data, &size, err))
        return false;
    fputs("<figure><img alt=\"", f);
    write_alt(f, r, s, variant, error, detail);
    if (detail == 0) {
        fputs("\" data-scene=\"", f);
        xml_text(f, s->name);
        fprintf(f, "\" data-kind=\"%s\" data-label=\"%s%s", error ? "error" : "picture", subject(variant),
                error ? ": error" : "");
    }
    fputs("\" src=\"data:image/png;base64,", f);
    base64(f, data, size);
    fprintf(f, "\"><figcaption>%s%s", subject(variant), error ? ": error" : "");
    if (variant != PICTURE_REFERENCE && detail == 0 && !error)
        fprintf(f, ", RMSE %.3f", shown_rmse(r, s, variant));
    fputs("</figcaption></figure>\n", f);
    free(data);
    return true;
}

/* A row of pictures: all methods, with or without the reference. */
static bool write_row(FILE *f, const struct results *r, const struct scene_results *s, bool error, int detail,
                      struct error *err)
{
    fputs("<div class=\"grid\">\n", f);
    bool ok = error || write_picture(f, r, s, PICTURE_REFERENCE, false, detail, err);
    for (int v = 0; ok && v < N_METHODS; v++)
        ok = write_picture(f, r, s, v, error, detail, err);
    fputs("</div>\n", f);
    return ok;
}

static void write_scale(FILE *f, const struct scene_results *s)
{
    fprintf(
        f,
        "<p class=\"scale\"><span>0</span><i></i><span>%.4g of 255: the largest error of any method</span></p>\n",
        pictures_largest_error(s));
}

/* --- a scene ----------------------------------------------------------------------------------------- */

static bool write_pictures(FILE *f, const struct results *r, const struct scene_results *s, struct error *err)
{
    struct detail detail[N_DETAILS];
    pictures_find_details(s, detail);
    fprintf(f, "<h3>Pictures, %ld samples per pixel</h3>\n<div class=\"viewer\" data-scene=\"",
            r->plan->spp[r->plan->n_steps - 1]);
    xml_text(f, s->name);
    fputs("\" hidden></div>\n", f);
    if (!write_row(f, r, s, false, 0, err))
        return false;
    fputs("<h3>Where the errors are</h3>\n", f);
    write_scale(f, s);
    if (!write_row(f, r, s, true, 0, err))
        return false;
    for (int i = 1; i <= N_DETAILS; i++) {
        const struct detail *d = &detail[i - 1];
        fprintf(f, "<p class=\"note\">Detail %d: %d x %d pixels at (%d, %d), where BDPT errs %smost.</p>\n", i,
                d->width, d->height, d->x, d->y, i == 1 ? "" : "next ");
        if (!write_row(f, r, s, false, i, err) || !write_row(f, r, s, true, i, err))
            return false;
    }
    return true;
}

static void write_plots(FILE *f, const struct results *r, const struct scene_results *s)
{
    fputs("<h3>Plots</h3>\n<p class=\"note\">Bars: one standard error over seeds.</p>\n<div class=\"plots\">\n", f);
    for (int k = 0; k < N_FIGURES; k++) {
        struct plot plot;
        struct figure_text text;
        char id[300];
        if (!figure_make(r, s, (enum figure)k, &plot, &text))
            continue;
        snprintf(id, sizeof id, "plot%d-%s", (int)(s - r->scene), figure_name((enum figure)k));
        fputs("<figure>", f);
        plot_write(f, &plot, id, false);
        fputs("</figure>\n", f);
    }
    fputs("</div>\n", f);
}

static void write_scene_tables(FILE *f, const struct results *r, const struct scene_results *s,
                               void (*write)(FILE *, const struct table *))
{
    for (int k = 0; k < N_SCENE_TABLES; k++) {
        struct table t;
        if (!tables_scene(r, s, (enum scene_table)k, &t))
            continue;
        write(f, &t);
        table_free(&t);
    }
}

static bool write_scene(FILE *f, const struct results *r, const struct scene_results *s, struct error *err)
{
    struct findings findings;
    fputs("<section id=\"scene-", f);
    xml_text(f, s->name);
    fputs("\">\n", f);
    paragraph(f, "h2", s->name);
    fprintf(f, "<p class=\"note\">%d x %d pixels, paths up to maxdepth %d. Reference: ", s->width, s->height,
            s->max_depth);
    xml_text(f, s->reference.origin);
    fputs(".</p>\n", f);
    findings_scene(r, s, &findings);
    write_findings(f, &findings);
    if (!write_pictures(f, r, s, err))
        return false;
    write_plots(f, r, s);
    fputs("<h3>Tables</h3>\n", f);
    write_scene_tables(f, r, s, table_html);
    fputs("</section>\n", f);
    return true;
}

/* --- the page ---------------------------------------------------------------------------------------- */

static void write_lead(FILE *f, const struct results *r, void (*text)(FILE *, const char *))
{
    const struct plan *p = r->plan;
    char line[600];
    snprintf(line, sizeof line,
             "BDPT and three ways in which ASBDPT chooses light sub-paths (bins, the dissertation's; pool and "
             "vertices, its "
             "repairs) in %d scene%s, each rendered to %ld, doubled up to %ld, samples per pixel with %d seed%s "
             "per method "
             "(%d for the parameter sweeps) and compared with a reference. Box filter, balance heuristic.",
             p->n_scenes, p->n_scenes == 1 ? "" : "s", p->spp[0], p->spp[p->n_steps - 1], p->n_seeds,
             p->n_seeds == 1 ? "" : "s", p->sweep_seeds < p->n_seeds ? p->sweep_seeds : p->n_seeds);
    text(f, line);
}

static void write_head(FILE *f, const struct results *r)
{
    fputs("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>asbdpt: experiment</title>\n<style>\n",
          f);
    plot_style(f);
    report_style(f);
    fputs("</style>\n</head>\n<body>\n<header>\n<h1>Alias Sampled Bidirectional Path Tracing, measured</h1>\n"
          "<p class=\"lead\">",
          f);
    write_lead(f, r, xml_text);
    fputs("</p>\n<nav aria-label=\"Contents\"><ul>\n<li><a href=\"#all\">All scenes</a></li>\n", f);
    for (int i = 0; i < r->plan->n_scenes; i++) {
        fputs("<li><a href=\"#scene-", f);
        xml_text(f, r->scene[i].name);
        fputs("\">", f);
        xml_text(f, r->scene[i].name);
        fputs("</a></li>\n", f);
    }
    fputs("<li><a href=\"#how\">How to read and repeat this</a></li>\n</ul></nav>\n</header>\n<main>\n", f);
}

static void write_total(FILE *f, const struct results *r)
{
    struct findings findings;
    fputs("<section id=\"all\">\n<h2>All scenes</h2>\n", f);
    findings_total(r, &findings);
    write_findings(f, &findings);
    for (int k = 0; k < N_TOTAL_TABLES; k++) {
        struct table t;
        tables_total(r, (enum total_table)k, &t);
        table_html(f, &t);
        table_free(&t);
    }
    fputs("</section>\n", f);
}

/* What the numbers mean; nothing here depends on the results. */
static const char *const NOTES[] = {
    "RMSE is the root mean square difference to the reference of all 8-bit sRGB values, 0 to 255, the "
    "dissertation's scale; "
    "results.csv also has it on linear values, and the relative squared error.",
    "Seconds are CPU seconds of all threads together, with the method's own preparation, without loading the "
    "scene.",
    "Equal time: BDPT's squared error falls as one over its time, so (MSE - noise^2) x seconds, divided by the "
    "same of BDPT, "
    "is the ratio of squared errors when both are given the same time. noise^2 is the squared error of the "
    "reference "
    "itself, where known.",
    "Intervals are Welch's, at 95 %, on the logarithm of the ratio, over seeds. Few seeds give wide intervals.",
    "Signed mean error: mean of the picture over mean of the reference, less 1. Without bias it scatters around 0.",
    "No walk is ended by Russian roulette here (rrthreshold 0), as in the dissertation; by default all methods use "
    "it and are faster.",
    "The printed numbers are from the dissertation's own models and its own pbrt-v3, against 16384 samples of "
    "BDPT; "
    "absolute values cannot agree with ours, the direction and shape of the ratios can.",
};

static void write_how(FILE *f, const struct results *r)
{
    const struct published *bathroom = published_find("bathroom");
    fputs("<section id=\"how\">\n<h2>How to read and repeat this</h2>\n<ul>\n", f);
    for (size_t i = 0; i < sizeof NOTES / sizeof NOTES[0]; i++)
        paragraph(f, "li", NOTES[i]);
    fprintf(f,
            "<li>The printed Bathroom errors fall only from %.2f to %.2f between %ld and %ld samples for BDPT, "
            "where an "
            "unbiased method's fall to %.2f: that reference does not match its pictures.</li>\n</ul>\n",
            bathroom->bdpt[0], bathroom->bdpt[PUBLISHED_STEPS - 1], published_spp(0),
            published_spp(PUBLISHED_STEPS - 1),
            bathroom->bdpt[0] / sqrt((double)published_spp(PUBLISHED_STEPS - 1) / (double)published_spp(0)));
    fputs("<p>The same results, up to the times:</p>\n<pre>", f);
    write_command(f, r, xml_text);
    fputs(
        "</pre>\n<p>Beside this page: <code>results.csv</code>, <code>runs.csv</code>, <code>results.json</code>, "
        "<code>results.md</code>, the pictures in <code>images/</code>, the plots in <code>plots/</code>.</p>\n"
        "</section>\n",
        f);
}

bool report_html(FILE *f, const struct results *r, struct error *err)
{
    write_head(f, r);
    write_total(f, r);
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!write_scene(f, r, &r->scene[i], err))
            return false;
    write_how(f, r);
    fputs("</main>\n<script>\n", f);
    report_script(f);
    fputs("</script>\n</body>\n</html>\n", f);
    return true;
}

/* --- Markdown ---------------------------------------------------------------------------------------- */

static void plain_text(FILE *f, const char *text) { fputs(text, f); }

static void markdown_findings(FILE *f, const struct findings *list)
{
    for (int i = 0; i < list->n; i++)
        fprintf(f, "- %s\n", list->text[i]);
    fputs("\n", f);
}

void report_markdown(FILE *f, const struct results *r)
{
    struct findings findings;
    fputs("# Alias Sampled Bidirectional Path Tracing, measured\n\n", f);
    write_lead(f, r, plain_text);
    fputs("\n\n    ", f);
    write_command(f, r, plain_text);
    fputs("\n", f);
    findings_total(r, &findings);
    markdown_findings(f, &findings);
    for (int k = 0; k < N_TOTAL_TABLES; k++) {
        struct table t;
        tables_total(r, (enum total_table)k, &t);
        table_markdown(f, &t);
        table_free(&t);
    }
    for (int i = 0; i < r->plan->n_scenes; i++) {
        fprintf(f, "## %s\n\n", r->scene[i].name);
        findings_scene(r, &r->scene[i], &findings);
        markdown_findings(f, &findings);
        write_scene_tables(f, r, &r->scene[i], table_markdown);
    }
    fputs("## Notes\n\n", f);
    for (size_t i = 0; i < sizeof NOTES / sizeof NOTES[0]; i++)
        fprintf(f, "- %s\n", NOTES[i]);
}
