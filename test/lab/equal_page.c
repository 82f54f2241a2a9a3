/* equal_page.c: see equal_page.h. */
#include "lab/equal_page.h"

#include <math.h>
#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/progress.h"
#include "image/image.h"
#include "lab/compare.h"
#include "lab/family.h"
#include "lab/sheet.h"

/* --- the sentence ------------------------------------------------------------------------------------ */

struct interval equal_overall(const struct equal_time *e, int method, enum equal_error which)
{
    double sum = 0, square = 0;
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++) {
        struct interval r = equal_ratio(e, s, method, which);
        sum += m_log(r.value);
        square += sqr((m_log(r.high) - m_log(r.low)) / 2);
    }
    double mean = sum / e->n_scenes, half = sqrt(square) / e->n_scenes;
    struct interval out = {m_exp(mean), m_exp(mean - half), m_exp(mean + half)};
    return out;
}

/* Intervals shrink as one over the root of the seeds. */
double equal_seeds_wanted(struct interval r, int n_seeds)
{
    return ceil(n_seeds * sqr((m_log(r.high) - m_log(r.low)) / (2 * m_log(r.value))));
}

/* What one seed more costs: the CPU time of all methods' renders of a seed, on average. */
static double seconds_per_seed(const struct equal_time *e)
{
    double sum = 0;
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        for (int v = 0; v < e->plan->methods.n; v++)
            for (int i = 0; i < e->plan->n_seeds; i++)
                sum += s->render[v][i].seconds / e->plan->n_seeds;
    return sum;
}

/* "0.8 (95 %: 0.6 to 1.1): undecided, 12 seeds may decide, some 40 s more". */
static void say(FILE *f, const struct equal_time *e, struct interval r)
{
    bool decided = r.high < 1 || r.low > 1;
    int n = e->plan->n_seeds;
    double seeds = equal_seeds_wanted(r, n);
    char more[32];
    if (!isfinite(r.value)) {
        fputs("unknown, the times being too far apart: give it more --spp", f);
        return;
    }
    fprintf(f, "%.3g (95 %%: %.3g to %.3g): %s", r.value, r.low, r.high,
            !decided ? "undecided" : r.high < 1 ? "a gain" : "a loss");
    if (!decided && seeds <= PLAN_MAX_SEEDS) {
        progress_duration(2 * (seeds - n) * seconds_per_seed(e), more, sizeof more); /* 2: most are rendered twice */
        fprintf(f, ", --seeds %.0f may decide, some %s of CPU more", seeds, more);
    } else if (!decided)
        fputs(", and so near 1 that it hardly matters; a larger --res sees smaller differences", f);
}

/* Two lines for each method, and one. */
void equal_verdict(FILE *f, const struct equal_time *e)
{
    const char *first = e->plan->methods.item[0].text;
    for (int v = 1; v < e->plan->methods.n; v++) {
        fprintf(f, "Squared error of %s over that of %s after the same time, per pixel: ",
                e->plan->methods.item[v].text, first);
        say(f, e, equal_overall(e, v, EQUAL_RELMSE));
        fputs(".\nIn means over 8x8 pixels, where errors that neighbours share do not hide: ", f);
        say(f, e, equal_overall(e, v, EQUAL_BLOCKS));
        fputs(".\n", f);
    }
    fprintf(f, "Measured with %d seed%s on", e->plan->n_seeds, e->plan->n_seeds == 1 ? "" : "s");
    for (int i = 0; i < e->n_scenes; i++)
        fprintf(f, "%s %s %dx%d", i > 0 ? "," : "", e->scene[i].name, e->scene[i].width, e->scene[i].height);
    fputs(".\n", f);
}

/* --- where the errors are ---------------------------------------------------------------------------- */

enum { GAP = 12, NAMES = 24, SMALLEST = 320 };

/* Of each pixel, [height*width], to be freed; NULL where the pictures were not kept. */
static float *errors_of(const struct equal_time *e, const struct equal_scene *s, int method)
{
    char path[4096];
    int width, height;
    long pixels = (long)s->width * s->height;
    equal_picture(e, s, method, path, sizeof path);
    float *x = image_read_linear(path, &width, &height, NULL, NULL);
    equal_picture(e, s, -1, path, sizeof path);
    float *r = image_read_linear(path, &width, &height, NULL, NULL), *error = NULL;
    if (x != NULL && r != NULL && width == s->width && height == s->height) {
        error = mem_alloc((size_t)pixels, sizeof *error);
        compare_errors(x, r, pixels, error);
    }
    free(x);
    free(r);
    return error;
}

static int enlarged(const struct equal_scene *s) { return s->width < SMALLEST ? SMALLEST / s->width : 1; }

/* A row for each scene, all its methods on the scale of the first. */
static bool write_errors(const struct equal_time *e, struct error *err)
{
    struct sheet sheet;
    char path[4096];
    int methods = e->plan->methods.n, widest = SMALLEST, height = GAP;
    for (int i = 0; i < e->n_scenes; i++) {
        const struct equal_scene *s = &e->scene[i];
        widest = s->width > widest ? s->width : widest;
        height += s->height * enlarged(s) + NAMES + GAP;
    }
    sheet_init(&sheet, GAP + methods * (widest + GAP), height, SHEET_PAPER);
    for (int i = 0, y = GAP; i < e->n_scenes; i++) {
        const struct equal_scene *s = &e->scene[i];
        long pixels = (long)s->width * s->height;
        double most = 0;
        for (int v = 0; v < methods; v++) {
            float *error = errors_of(e, s, v), *map = mem_alloc((size_t)pixels * 3, sizeof *map);
            if (error != NULL) {
                most = v == 0 ? picture_percentile(error, pixels, 99) : most;
                compare_heatmap(error, pixels, most, map);
                sheet_text(&sheet, GAP + v * (widest + GAP), y, 1, SHEET_INK, e->plan->methods.item[v].text);
                sheet_paste(&sheet, GAP + v * (widest + GAP), y + NAMES / 2, map, s->width, s->height,
                            enlarged(s));
            }
            free(error);
            free(map);
        }
        y += s->height * enlarged(s) + NAMES + GAP;
    }
    snprintf(path, sizeof path, "%s/errors.png", e->plan->directory);
    bool ok = image_write(path, sheet.width, sheet.height, sheet.pixels, err);
    sheet_free(&sheet);
    return ok;
}

/* --- the page ---------------------------------------------------------------------------------------- */

static void write_page(FILE *f, const struct equal_time *e)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Equal time</title>\n"
          "<style>body{max-width:60em;margin:2em auto;font:1rem/1.5 Georgia,serif}img{max-width:100%}</style>\n"
          "<h1>Equal time</h1>\n<p style=\"white-space:pre-line\"><strong>", f);
    equal_verdict(f, e);
    fputs("</strong></p>\n", f);
    family_figure(f, e);
    fputs("<h2>The middle of each picture</h2>\n<img src=\"family.png\" alt=\"Crops of the reference and of each "
          "method's picture\">\n<h2>Where the errors are</h2>\n<p>Dark: none; bright: the 99th percentile of the "
          "first method's errors, and more.</p>\n<img src=\"errors.png\" alt=\"Errors of each method's picture as "
          "colours\">\n<p><a href=\"equal-time.md\">All ratios</a>, <a href=\"equal-time.csv\">all renders</a></p>\n"
          "</html>\n", f);
}

bool equal_page_write(const struct equal_time *e, struct error *err)
{
    return family_strip(e, err) && write_errors(e, err) && equal_write_file(e, "equal-time.html", write_page, err);
}
