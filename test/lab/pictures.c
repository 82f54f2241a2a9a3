/* pictures.c: see pictures.h. */
#include "lab/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "lab/compare.h"

static const double SOFT = 0.65; /* the grey of what matters less */

/* Column `number` of a sheet: name, an error by the name of its kind (NaN: unknown) and what it took, and below it the
 * picture, each of its pixels a square of k x k. */
static void draw_column(struct sheet *sheet, int number, const char *name, const char *kind, double error,
                        const char *cost, const float *pixels, int width, int height, int k)
{
    int x = COLUMN_GAP + number * (width * k + COLUMN_GAP);
    int size = sheet_text_width(name, 3) < width * k * 2 / 3 ? 3 : 2;
    char text[100] = "";
    if (isfinite(error))
        snprintf(text, sizeof text, "%s %.1f", kind, error);
    sheet_text(sheet, x, COLUMN_GAP, size, SHEET_INK, name);
    sheet_text(sheet, x + width * k - sheet_text_width(text, size), COLUMN_GAP, size, SHEET_INK, text);
    sheet_text(sheet, x, COLUMN_GAP + 30, 2, SOFT, cost);
    sheet_paste(sheet, x, COLUMN_GAP + COLUMN_LABEL, pixels, width, height, k);
}

/* Errors of all compared methods' 8-bit values, 0 to 255. [n_compared][height*width], to be freed. */
static float *display_errors(const struct scene_results *s, long *n)
{
    size_t pixels = (size_t)s->width * (size_t)s->height, methods = (size_t)s->plan->n_compared;
    float *out = mem_alloc(pixels * methods, sizeof *out);
    *n = (long)(pixels * methods);
    for (size_t v = 0; v < methods; v++)
        for (size_t i = 0; i < pixels; i++)
            out[v * pixels + i] =
                (float)compare_pixels(s->image[v] + 3 * i, s->reference.pixels + 3 * i, 3).rmse8;
    return out;
}

double pictures_error_scale(const struct scene_results *s)
{
    long n;
    float *error = display_errors(s, &n);
    double most = picture_percentile(error, n, PICTURES_PERCENTILE);
    free(error);
    return most;
}

/* How many times as wide and high as it is a picture is shown. */
static int enlarged(int width) { return width < COLUMN_WIDTH ? COLUMN_WIDTH / width : 1; }

/* The reference, and each method above its errors. */
static void draw(const struct scene_results *s, const float *heat, struct sheet *sheet)
{
    int k = enlarged(s->width), methods = s->plan->n_compared;
    int below = COLUMN_GAP + COLUMN_LABEL + s->height * k + COLUMN_GAP;
    char text[100];
    sheet_init(sheet, (methods + 1) * (s->width * k + COLUMN_GAP) + COLUMN_GAP, below + s->height * k + COLUMN_GAP,
               SHEET_PAPER);
    draw_column(sheet, 0, "reference", "noise", s->reference.noise8, "", s->reference.pixels, s->width, s->height, k);
    snprintf(text, sizeof text, "errors: dark 0, bright %.3g and more", pictures_error_scale(s));
    sheet_text(sheet, COLUMN_GAP, below, 2, SOFT, text);
    for (int v = 0; v < methods; v++) {
        const struct run_step *last = &s->run[v][0].step[plan_last_step(s->plan)];
        snprintf(text, sizeof text, "%ld samples per pixel, %.1f s of CPU", last->spp, last->value[Q_SECONDS]);
        draw_column(sheet, v + 1, s->plan->methods.item[v].text, "error", last->value[Q_RMSE8], text, s->image[v],
                    s->width, s->height, k);
        sheet_paste(sheet, COLUMN_GAP + (v + 1) * (s->width * k + COLUMN_GAP), below,
                    heat + 3L * v * s->width * s->height, s->width, s->height, k);
    }
}

bool pictures_write(const struct scene_results *s, struct error *err)
{
    char name[300];
    long n;
    struct sheet sheet;
    float *error = display_errors(s, &n), *heat = mem_alloc((size_t)n * 3, sizeof *heat);
    compare_heatmap(error, n, picture_percentile(error, n, PICTURES_PERCENTILE), heat);
    draw(s, heat, &sheet);
    free(heat);
    free(error);
    snprintf(name, sizeof name, "images/%s.png", s->name);
    return sheet_write(&sheet, s->plan->directory, name, err);
}

/* --- a demonstration --------------------------------------------------------------------------------- */

static double shown_blocks(const struct scene_results *s, int method)
{
    int k = plan_scale(s->plan);
    float *small = sheet_shrink(s->image[method], s->width * k, s->height * k, k);
    double rmse8 = compare_shown_blocks(small, s->reference.pixels, s->width, s->height);
    free(small);
    return rmse8;
}

void demo_draw(const struct results *r, struct sheet *sheet)
{
    const struct scene_results *s = &r->scene[0];
    const struct plan *p = r->plan;
    int scale = plan_scale(p), width = s->width * scale, height = s->height * scale, n = p->methods.n;
    int k = enlarged(width);
    char cost[100];
    sheet_init(sheet, (n + 1) * (width * k + COLUMN_GAP) + COLUMN_GAP, COLUMN_LABEL + height * k + 2 * COLUMN_GAP,
               SHEET_PAPER);
    for (int i = 0; i < n; i++) {
        const struct run_step *step = &s->run[i][0].step[0];
        snprintf(cost, sizeof cost, "%ld spp, %.1f s; in 8x8 %.1f", step->spp, step->value[Q_SECONDS],
                 shown_blocks(s, i));
        draw_column(sheet, i, p->methods.item[i].text, "error", step->value[Q_RMSE8], cost, s->image[i], width, height,
                    k);
    }
    if (scale > 1)
        snprintf(cost, sizeof cost, "%.14s; %d x %d in one", s->reference.origin, scale, scale);
    else
        snprintf(cost, sizeof cost, "%.14s", s->reference.origin);
    draw_column(sheet, n, "reference", "noise", s->reference.noise8, cost, s->reference.pixels, s->width, s->height,
                k * scale);
}

void demo_print(FILE *f, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    for (int i = 0; i < r->plan->methods.n; i++) {
        const struct run_step *step = &s->run[i][0].step[0];
        fprintf(f, "%-8s %6ld spp %8.2f s of CPU   rmse8 %.3f   of 8x8 pixels %.3f\n", r->plan->methods.item[i].text,
                step->spp, step->value[Q_SECONDS], step->value[Q_RMSE8], shown_blocks(s, i));
    }
}
