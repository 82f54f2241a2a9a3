/* pictures.c: see pictures.h. */
#include "lab/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/formats.h"
#include "image/image.h"
#include "look/compare.h"

void picture_path(const struct scene_results *s, int variant, enum picture_kind kind,
                  int detail, char *out, size_t size)
{
    static const char *const kinds[] = {"", "-error", "-range"};
    char suffix[32] = "";
    if (detail > 0)
        snprintf(suffix, sizeof suffix, "-detail%d", detail);
    snprintf(out, size, "%s/images/%s-%s%s%s.png", s->plan->directory, s->name,
             variant == PICTURE_REFERENCE ? "reference" : VARIANTS[variant].name, kinds[kind], suffix);
}

static size_t values(const struct scene_results *s) { return (size_t)s->width * (size_t)s->height * 3; }

/* --- where to look closer ---------------------------------------------------------------------------- */

/* Sum of squares of BDPT's errors in a window. */
static double window_error(const struct scene_results *s, const struct detail *w)
{
    const float *x = s->image[VARIANT_BDPT], *r = s->reference.pixels;
    double sum = 0;
    for (int j = w->y; j < w->y + w->height; j++)
        for (int i = 3 * w->x; i < 3 * (w->x + w->width); i++) {
            size_t k = (size_t)j * (size_t)s->width * 3 + (size_t)i;
            double e = srgb_byte((double)x[k]) - srgb_byte((double)r[k]);
            sum += e * e;
        }
    return sum;
}

static bool overlap(const struct detail *a, const struct detail *b)
{
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height && b->y < a->y + a->height;
}

void pictures_find_details(const struct scene_results *s, struct detail out[N_DETAILS])
{
    int w = s->width >= 5 ? s->width / 5 : 1, h = w < s->height ? w : s->height;
    int step = w >= 4 ? w / 4 : 1, enlargement = w < 256 ? 256 / w : 1;
    for (int n = 0; n < N_DETAILS; n++) {
        double largest = -1;
        struct detail best = {0, 0, w, h, enlargement};
        for (int y = 0; y + h <= s->height; y += step)
            for (int x = 0; x + w <= s->width; x += step) {
                struct detail d = {x, y, w, h, enlargement};
                double e = n > 0 && overlap(&d, &out[0]) ? -1 : window_error(s, &d);
                if (e > largest) {
                    largest = e;
                    best = d;
                }
            }
        out[n] = best;
    }
}

/* --- writing ----------------------------------------------------------------------------------------- */

/* A window of a picture, each pixel as a square. */
static bool write_detail(const char *path, const struct scene_results *s, const float *pixels, const struct detail *d,
                         struct error *err)
{
    int w = d->width * d->enlargement, h = d->height * d->enlargement;
    float *out = mem_alloc((size_t)w * (size_t)h * 3, sizeof *out);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            size_t from = (size_t)(d->y + y / d->enlargement) * (size_t)s->width + (size_t)(d->x + x / d->enlargement);
            memcpy(out + 3 * ((size_t)y * (size_t)w + (size_t)x), pixels + 3 * from, 3 * sizeof *out);
        }
    bool ok = image_write(path, w, h, out, err);
    free(out);
    return ok;
}

/* A pixel as three mantissas m and an exponent e, each component m 2^(e - 136) [Ward 1991]. The exponent is such that
 * the largest mantissa is at least 128; negative numbers and NaN become 0. */
static void rgbe_encode(const float *pixel, uint8_t *out)
{
    float part[3], largest = 0;
    for (int c = 0; c < 3; c++) {
        part[c] = pixel[c] > 0 ? fminf(pixel[c], 0x1.fep126f) : 0;
        largest = fmaxf(largest, part[c]);
    }
    int e;
    memset(out, 0, 4);
    if (largest < 0x1p-128f) /* the smallest exponent that a byte holds */
        return;
    frexpf(largest, &e);
    if (lrintf(ldexpf(largest, 8 - e)) > 255) /* rounded up to the next power of two */
        e++;
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)lrintf(ldexpf(part[c], 8 - e));
    out[3] = (uint8_t)(e + 128);
}

/* The bytes as a picture: image_write turns linear values to sRGB bytes, so these are turned back first. */
static bool write_range(const char *path, const float *pixels, int width, int height, struct error *err)
{
    size_t n = (size_t)width * (size_t)height;
    float *out = mem_alloc(n * 6, sizeof *out);
    for (size_t i = 0; i < n; i++) {
        uint8_t code[4];
        rgbe_encode(pixels + 3 * i, code);
        for (size_t c = 0; c < 3; c++) {
            out[3 * i + c] = (float)srgb_decode(code[c] / 255.0);
            out[3 * (n + i) + c] = (float)srgb_decode(code[3] / 255.0);
        }
    }
    bool ok = image_write(path, width, 2 * height, out, err);
    free(out);
    return ok;
}

/* A picture and its details. */
static bool write_all(const struct scene_results *s, int variant, enum picture_kind kind,
                      const float *pixels, const struct detail *detail, struct error *err)
{
    char path[4096];
    picture_path(s, variant, kind, 0, path, sizeof path);
    bool ok = image_write(path, s->width, s->height, pixels, err);
    for (int i = 0; ok && i < N_DETAILS; i++) {
        picture_path(s, variant, kind, i + 1, path, sizeof path);
        ok = write_detail(path, s, pixels, &detail[i], err);
    }
    picture_path(s, variant, PICTURE_RANGE, 0, path, sizeof path);
    return ok && (kind == PICTURE_ERROR || write_range(path, pixels, s->width, s->height, err));
}

/* Errors of all variants' 8-bit values, 0 to 255. [N_COMPARED][height*width], to be freed. */
static float *display_errors(const struct scene_results *s)
{
    size_t pixels = values(s) / 3;
    float *out = mem_alloc(pixels * N_COMPARED, sizeof *out);
    for (size_t v = 0; v < N_COMPARED; v++)
        for (size_t i = 0; i < pixels; i++)
            out[v * pixels + i] =
                (float)compare_pixels(s->image[v] + 3 * i, s->reference.pixels + 3 * i, 3).rmse8;
    return out;
}

double pictures_error_scale(const struct scene_results *s)
{
    float *error = display_errors(s);
    double most = compare_percentile(error, (long)(values(s) / 3 * N_COMPARED), PICTURES_PERCENTILE);
    free(error);
    return most;
}

/* Heat maps of all variants to one scale. [N_COMPARED][values], to be freed. */
static float *make_heatmaps(const struct scene_results *s)
{
    long pixels = (long)(values(s) / 3 * N_COMPARED);
    float *error = display_errors(s), *out = mem_alloc((size_t)pixels * 3, sizeof *out);
    compare_heatmap(error, pixels, compare_percentile(error, pixels, PICTURES_PERCENTILE), out);
    free(error);
    return out;
}

bool pictures_write(const struct scene_results *s, struct error *err)
{
    struct detail detail[N_DETAILS];
    pictures_find_details(s, detail);
    float *heat = make_heatmaps(s);
    bool ok = write_all(s, PICTURE_REFERENCE, PICTURE_ITSELF, s->reference.pixels, detail, err);
    for (int v = 0; ok && v < N_COMPARED; v++)
        ok = write_all(s, v, PICTURE_ITSELF, s->image[v], detail, err) &&
             write_all(s, v, PICTURE_ERROR, heat + (size_t)v * values(s), detail, err);
    free(heat);
    return ok;
}
