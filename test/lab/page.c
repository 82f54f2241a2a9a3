/* page.c: see page.h. */
#include "lab/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/version.h"
#include "lab/files.h"
#include "lab/text.h"

/* --- text, numbers and pictures ---------------------------------------------------------------------- */

/* A text of JSON within HTML: nothing in it ends the string or the element. */
static void write_text(FILE *f, const char *name, const char *text)
{
    fprintf(f, "\"%s\":\"", name);
    for (const char *c = text; *c != '\0'; c++)
        fprintf(f, strchr("\"\\<>&", *c) != NULL || (unsigned char)*c < ' ' ? "\\u%04x" : "%c", (unsigned char)*c);
    fputs("\",", f);
}

/* [a, b, ...]; null where a number is not known. */
static void write_numbers(FILE *f, const double *x, int n)
{
    for (int i = 0; i < n; i++)
        fprintf(f, isfinite(x[i]) ? "%c%.5g" : "%cnull", i > 0 ? ',' : '[', x[i]);
    fputc(']', f);
}

static void write_base64(FILE *f, const uint8_t *data, size_t n)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        size_t left = n - i < 3 ? n - i : 3;
        unsigned long v = 0;
        for (size_t k = 0; k < 3; k++)
            v = v << 8 | (k < left ? data[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(k <= left ? digits[v >> (18 - 6 * k) & 63] : '=', f);
    }
}

/* A picture, also as images/SCENE--NAME.png. */
static bool write_picture(FILE *f, const struct scene_results *s, const char *name, const float *pixels,
                          struct error *err)
{
    char path[4096];
    uint8_t *png;
    size_t n;
    snprintf(path, sizeof path, "%s/images/%s--%s.png", s->plan->directory, s->name, name);
    if (!image_write(path, s->width, s->height, pixels, err) || !file_read(path, &png, &n, err))
        return false;
    fputs("\"png\":\"", f);
    write_base64(f, png, n);
    fputs("\",", f);
    free(png);
    return true;
}

/* --- scenes ------------------------------------------------------------------------------------------ */

/* Samples, CPU seconds and the roots of the mean squares: of all steps, the last one last. */
static void write_points(FILE *f, const struct scene_results *s, int method)
{
    int n = 0;
    fputs("\"points\":[", f);
    for (int i = 0; i < PLAN_MAX_STEPS; i++) {
        int step = s->plan->equal ? (i + 1) % PLAN_MAX_STEPS : i;
        const struct run *run = &s->run[method][0][step];
        if (run->spp == 0)
            continue;
        double x[2 + N_SQUARES] = {(double)run->spp, results_seconds(s, method, step)};
        for (int k = 0; k < N_SQUARES; k++)
            x[2 + k] = sqrt(results_square(s, method, step, (enum square)k));
        if (isnan(s->reference.noise8)) /* not subtracted then */
            x[2] = results_mean(s, method, step, Q_RMSE8).mean;
        fputs(n++ > 0 ? "," : "", f);
        write_numbers(f, x, 2 + N_SQUARES);
    }
    fputs("],\"printed\":[", f);
}

static bool write_method(FILE *f, const struct scene_results *s, int method,
                         double (*printed)(const char *, const char *, long), struct error *err)
{
    const struct plan *p = s->plan;
    const struct measured *m = &p->methods.item[method];
    static const char *const halves[] = {"", " (choice)", " (services)", ""};
    bool alone = true, ok = true;
    char name[METHOD_TEXT + 16];
    int n = 0;
    for (int v = 0; v < p->methods.n; v++)
        alone = alone && (v == method || strcmp(p->methods.item[v].label, m->label) != 0);
    fprintf(f, method > 0 ? ",\n{" : "\n{");
    snprintf(name, sizeof name, "%s%s", m->label, alone ? "" : halves[m->halves & 3]);
    write_text(f, "name", name);
    write_text(f, "text", m->text);
    write_text(f, "mark", MARKS[s->mark[method]]);
    if (method < p->n_compared)
        ok = write_picture(f, s, m->file, s->image[method], err);
    write_points(f, s, method);
    for (long spp = 1; printed != NULL && spp < 1L << 20; spp *= 2) {
        double x[2] = {(double)spp, printed(s->name, m->text, spp)};
        fputs(isfinite(x[1]) && n++ > 0 ? "," : "", f);
        if (isfinite(x[1]))
            write_numbers(f, x, 2);
    }
    fputs("]}", f);
    return ok;
}

static bool write_scene(FILE *f, const struct scene_results *s, double (*printed)(const char *, const char *, long),
                        struct error *err)
{
    fputs("{", f);
    write_text(f, "name", s->name);
    fprintf(f, "\"width\":%d,\"height\":%d,\"reference\":{", s->width, s->height);
    write_text(f, "origin", s->reference.origin);
    bool ok = write_picture(f, s, "reference", s->reference.pixels, err);
    fprintf(f, isfinite(s->reference.noise8) ? "\"noise\":%.4g},\"methods\":[" : "\"noise\":null},\"methods\":[",
            s->reference.noise8);
    for (int v = 0; ok && v < s->plan->methods.n; v++)
        ok = write_method(f, s, v, printed, err);
    fputs("]}", f);
    return ok;
}

/* --- the page ---------------------------------------------------------------------------------------- */

static void write_lines(FILE *f, const char *const *line)
{
    for (; *line != NULL; line++)
        fprintf(f, "%s\n", *line);
}

static bool write_data(FILE *f, const struct results *r, const char *title, const char *text,
                       double (*printed)(const char *, const char *, long), struct error *err)
{
    const char *commit = getenv("ASBDPT_COMMIT");
    char about[300], command[8192];
    bool ok = true;
    snprintf(about, sizeof about, "%s, estimator %d%s%.100s; %d seed%s", VERSION, ESTIMATOR,
             commit != NULL ? ", commit " : "", commit != NULL ? commit : "", r->plan->n_seeds,
             r->plan->n_seeds == 1 ? "" : "s");
    snprintf(command, sizeof command, "./asbdpt-lab %s -o %s", r->plan->command, r->plan->directory);
    bool whole = true;
    for (int i = 0; i < r->plan->n_scenes; i++)
        whole &= text_add(command, sizeof command, " %s", r->plan->scene[i]);
    error_clean(command);
    if (!whole)
        snprintf(command, sizeof command, "./asbdpt-lab %.4000s ...", r->plan->command);
    fputs("{", f);
    write_text(f, "title", title);
    write_text(f, "about", about);
    write_text(f, "command", command);
    write_text(f, "text", text);
    fputs("\"scenes\":[", f);
    for (int i = 0; ok && i < r->plan->n_scenes; i++) {
        fputs(i > 0 ? ",\n" : "\n", f);
        ok = write_scene(f, &r->scene[i], printed, err);
    }
    fputs("]}\n", f);
    return ok;
}

bool page_write(const struct results *r, const char *title, const char *markdown,
                double (*printed)(const char *, const char *, long), struct error *err)
{
    struct file_output out;
    char path[4096];
    uint8_t *text;
    size_t n;
    snprintf(path, sizeof path, "%s/%s", r->plan->directory, markdown);
    if (!file_read(path, &text, &n, err))
        return false;
    bool ok = plan_create(r->plan, "report.html", &out, err);
    if (ok) {
        FILE *f = out.stream;
        fprintf(f, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
                "content=\"width=device-width, initial-scale=1\">\n<title>%s</title>\n<style>\n", title);
        write_lines(f, PAGE_STYLE);
        fprintf(f, "</style>\n</head>\n<body>\n<main id=\"page\"></main>\n<noscript>A script draws this page; %s has "
                "its tables.</noscript>\n<script type=\"application/json\" id=\"data\">\n", markdown);
        ok = write_data(f, r, title, (const char *)text, printed, err);
        fputs("</script>\n<script>\n", f);
        write_lines(f, PAGE_SCRIPT);
        fputs("</script>\n</body>\n</html>\n", f);
        if (ok)
            ok = file_commit(&out, err);
        else
            file_abandon(&out);
    }
    free(text);
    return ok;
}
