/* pictures.c: see pictures.h. */
#include "lab/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "lab/compare.h"

static const double SOFT = 0.65; /* the grey of what matters less */

/* The largest size in which a text fits, up to `most`; 0: none. */
static int fitting(const char *text, int width, int most)
{
    while (most > 0 && sheet_text_width(text, most) > width)
        most--;
    return most;
}

/* Column `number` of a sheet: name, an error by the name of its kind (NaN: unknown) and what it took, and below it the
 * picture, each of its pixels a square of k x k. In a narrow column the error is below the name. */
static void draw_column(struct sheet *sheet, int number, const char *name, const char *kind, double error,
                        const char *cost, const float *pixels, int width, int height, int k)
{
    int x = COLUMN_GAP + number * (width * k + COLUMN_GAP), size;
    char both[200], text[40] = "";
    if (isfinite(error))
        snprintf(text, sizeof text, "%s %.1f", kind, error);
    snprintf(both, sizeof both, "%s  %s", name, text);
    size = fitting(both, width * k, 3);
    sheet_text(sheet, x, COLUMN_GAP, size > 0 ? size : 1, SHEET_INK, name);
    sheet_text(sheet, x + (size > 0 ? width * k - sheet_text_width(text, size) : 0), COLUMN_GAP + (size > 0 ? 0 : 15),
               size > 0 ? size : 1, SHEET_INK, text);
    sheet_text(sheet, x, COLUMN_GAP + 30, fitting(cost, width * k, 2), SOFT, cost);
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

/* The errors of all methods below their pictures, and what their colours mean. */
static void draw_errors(const struct scene_results *s, struct sheet *sheet, int k)
{
    char text[100];
    long n;
    int y = COLUMN_GAP + COLUMN_LABEL + s->height * k + COLUMN_GAP;
    float *error = display_errors(s, &n), *heat = mem_alloc((size_t)n * 3, sizeof *heat);
    double most = picture_percentile(error, n, PICTURES_PERCENTILE);
    compare_heatmap(error, n, most, heat);
    snprintf(text, sizeof text, "%.3g and more", most);
    sheet_bar(sheet, COLUMN_GAP + s->plan->n_compared * (s->width * k + COLUMN_GAP), y, s->width * k, "0",
              "error, of 255", text);
    for (int v = 0; v < s->plan->n_compared; v++)
        sheet_paste(sheet, COLUMN_GAP + v * (s->width * k + COLUMN_GAP), y, heat + 3L * v * s->width * s->height,
                    s->width, s->height, k);
    free(heat);
    free(error);
}

struct sheet pictures_sheet(const struct scene_results *s)
{
    const struct plan *p = s->plan;
    struct sheet sheet;
    int k = s->width < COLUMN_WIDTH ? COLUMN_WIDTH / s->width : 1;
    char text[100];
    sheet_init(&sheet, (p->n_compared + 1) * (s->width * k + COLUMN_GAP) + COLUMN_GAP,
               COLUMN_GAP + COLUMN_LABEL + 2 * (s->height * k + COLUMN_GAP), SHEET_PAPER);
    snprintf(text, sizeof text, "%s; rmse8 includes its noise", s->reference.kind);
    draw_column(&sheet, p->n_compared, "reference", "noise", s->reference.noise8, text, s->reference.pixels, s->width,
                s->height, k);
    for (int v = 0; v < p->n_compared; v++) {
        const struct run *last = &s->run[v][0][plan_last_step(p)];
        snprintf(text, sizeof text, "%ld spp, %.1f s of CPU; 8x8 means %.1f", last->spp, last->value[Q_SECONDS],
                 compare_shown_blocks(s->image[v], s->reference.pixels, s->width, s->height));
        draw_column(&sheet, v, p->methods.item[v].label, "rmse8", last->value[Q_RMSE8], text, s->image[v], s->width,
                    s->height, k);
    }
    draw_errors(s, &sheet, k);
    return sheet;
}

bool pictures_write(const struct scene_results *s, struct error *err)
{
    char name[300];
    struct sheet sheet = pictures_sheet(s);
    snprintf(name, sizeof name, "images/%s.png", s->name);
    return sheet_write(&sheet, s->plan->directory, name, err);
}
