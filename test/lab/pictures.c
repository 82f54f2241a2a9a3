/* pictures.c: see pictures.h. */
#include "lab/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "image/image.h"
#include "lab/compare.h"

static const double SOFT = 0.65; /* the grey of what matters less */

void draw_column(struct sheet *sheet, int number, const char *name, const char *kind, double error, const char *cost,
                 const float *pixels, int width, int height, int k)
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

/* The reference, and each method above its errors. */
static void draw(const struct scene_results *s, const float *heat, struct sheet *sheet)
{
    int k = s->width < COLUMN_WIDTH ? COLUMN_WIDTH / s->width : 1, methods = s->plan->n_compared;
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
    char path[4096];
    long n;
    struct sheet sheet;
    float *error = display_errors(s, &n), *heat = mem_alloc((size_t)n * 3, sizeof *heat);
    compare_heatmap(error, n, picture_percentile(error, n, PICTURES_PERCENTILE), heat);
    draw(s, heat, &sheet);
    snprintf(path, sizeof path, "%s/images/%s.png", s->plan->directory, s->name);
    bool ok = image_write(path, sheet.width, sheet.height, sheet.pixels, err);
    sheet_free(&sheet);
    free(heat);
    free(error);
    return ok;
}
