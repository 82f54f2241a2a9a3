/* film.c: see film.h. */
#include "scene/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/error.h"

/* --- tiles ------------------------------------------------------------------------------------------- */

/* Of the tiles that share a cell each takes the pixel whose number is the rank of its own hash. Ranks differ, since
 * hash_combine is a bijection of its second argument. */
bool pixels_get(struct tile_pixels p, int i, int *x, int *y)
{
    if (i >= pixels_count(p))
        return false;
    *x = p.rect.x0 + i % pixels_columns(p) * p.nx;
    *y = p.rect.y0 + i / pixels_columns(p) * p.ny;
    int w = p.rect.x1 - *x < p.nx ? p.rect.x1 - *x : p.nx, h = p.rect.y1 - *y < p.ny ? p.rect.y1 - *y : p.ny;
    uint64_t cell = hash_combine((uint64_t)*x, (uint64_t)*y), own = hash_combine(cell, (uint64_t)(p.y * w + p.x));
    int rank = 0;
    for (int k = 0; k < w * h; k++)
        rank += hash_combine(cell, (uint64_t)k) < own;
    *x += rank % w;
    *y += rank / w;
    return true;
}

void tile_start(struct tile *t, struct tile_pixels pixels, struct pixel_rect film_rect, const struct filter *filter)
{
    size_t n_pixels = (size_t)pixels_count(pixels), n = 3 * n_pixels;
    t->pixels = pixels;
    t->n_pixels = (int)n_pixels;
    t->pixel = mem_grow(t->pixel, &t->pixel_capacity, n_pixels, sizeof *t->pixel);
    for (int i = 0; i < t->n_pixels; i++)
        pixels_get(pixels, i, &t->pixel[i][0], &t->pixel[i][1]);
    t->film_rect = film_rect;
    t->filter = filter;
    t->sum = mem_grow(t->sum, &t->sum_capacity, n, sizeof *t->sum);
    memset(t->sum, 0, n * sizeof *t->sum);
    t->n_splats = 0;
    t->first_half = t->taken = false;
    t->nonfinite = 0;
}

void tile_free(struct tile *t)
{
    free(t->pixel);
    free(t->sum);
    free(t->splat);
    memset(t, 0, sizeof *t);
}

static void make_room(struct tile *t)
{
    if (t->full != NULL && t->n_splats >= TILE_FULL)
        t->full(t->context, t);
}

void tile_add(struct tile *t, int x, int y, rgb value)
{
    const double part[3] = {value.r, value.g, value.b};
    bool fits = rgb_fits_float(value);
    make_room(t);
    t->nonfinite += !fits;
    for (size_t c = 0, i = 3 * (size_t)pixels_cell(t->pixels, x, y); fits && c < 3; c++)
        exact_add(&t->sum[i + c], part[c]);
}

bool tile_add_splat(struct tile *t, double px, double py, rgb value)
{
    if (!rgb_fits_float(value)) {
        t->nonfinite++;
        return false;
    }
    struct splat s = {px, py, value};
    t->splat = mem_grow(t->splat, &t->splat_capacity, t->n_splats + 1, sizeof *t->splat);
    t->splat[t->n_splats++] = s;
    return true;
}

/* --- splats ------------------------------------------------------------------------------------------ */

/* First pixel whose filter covers the raster coordinate p on one axis, and the one after the last. */
static void filter_span(double p, double radius, int low, int high, int *first, int *end)
{
    bool one = 2 * radius == 1; /* half-open: a point belongs to exactly one pixel */
    double a = floor(one ? p : p - radius + 0.5), b = one ? a : floor(p + radius - 0.5); /* |p - (i + 0.5)| <= radius */
    *first = int_within(a, low, high); /* a NaN covers nothing */
    *end = int_within(b + 1, low, high);
}

struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within)
{
    struct pixel_rect r = {0, 0, 0, 0};
    filter_span(s->px, filter->radius[0], within.x0, within.x1, &r.x0, &r.x1);
    filter_span(s->py, filter->radius[1], within.y0, within.y1, &r.y0, &r.y1);
    return r;
}

bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3])
{
    rgb part = rgb_scale(s->value, filter_eval(filter, s->px - (x + 0.5), s->py - (y + 0.5)));
    if (!rgb_fits_float(part))
        return false;
    out[0] = (float)part.r;
    out[1] = (float)part.g;
    out[2] = (float)part.b;
    return true;
}

/* --- the film ---------------------------------------------------------------------------------------- */

/* Of each pixel the values of the image. */
static size_t values(const struct film *f) { return 3 * rect_pixels(f->rect); }

double film_bytes(struct pixel_rect rect, bool halves)
{
    size_t value = (1 + halves) * sizeof(struct exact_sum) + 4 * sizeof(float); /* splats, picture, what is written */
    return (double)rect_pixels(rect) * (double)(3 * value + sizeof(bool));
}

void film_init(struct film *f, struct pixel_rect rect, int full_width, int full_height)
{
    memset(f, 0, sizeof *f);
    f->rect = rect;
    f->full_width = full_width;
    f->full_height = full_height;
    f->block.in = mem_alloc(rect_pixels(rect), sizeof *f->block.in);
    f->block.splat = mem_alloc(values(f), sizeof *f->block.splat);
    f->sum = mem_alloc(values(f), sizeof *f->sum);
}

void film_free(struct film *f)
{
    free(f->sum);
    free(f->block.in);
    free(f->block.splat);
    free(f->more);
    free(f->half);
    memset(f, 0, sizeof *f);
}

void film_keep_halves(struct film *f)
{
    f->half = mem_alloc(values(f), sizeof *f->half);
    for (int i = 0; i < N_NOISE_SCALES; i++)
        f->noise[i].value = f->noise[i].error = INFINITY;
}

static size_t pixel_of(const struct film *f, int x, int y)
{
    return (size_t)(y - f->rect.y0) * (size_t)rect_width(f->rect) + (size_t)(x - f->rect.x0);
}

static void add_splat(struct film *f, const struct splat *s, const struct filter *filter, bool first_half)
{
    struct pixel_rect range = splat_pixels(s, filter, f->rect);
    for (int y = range.y0; y < range.y1; y++)
        for (int x = range.x0; x < range.x1; x++) {
            float part[3];
            size_t at = 3 * pixel_of(f, x, y);
            bool ok = splat_part(s, filter, x, y, part);
            f->nonfinite += !ok;
            for (size_t c = 0; ok && c < 3; c++) {
                exact_add(&f->sum[at + c], (double)part[c]);
                f->block.splat[at + c] += part[c];
                if (first_half)
                    exact_add(&f->half[at + c], (double)part[c]);
            }
        }
}

void film_take_splats(struct film *f, struct tile *t)
{
    for (size_t i = 0; i < t->n_splats; i++)
        add_splat(f, &t->splat[i], t->filter, f->half != NULL && t->first_half);
    t->n_splats = 0;
}

void film_merge_tile(struct film *f, struct tile *t)
{
    size_t from = 0;
    for (int i = 0; i < t->n_pixels; i++) {
        size_t at = pixel_of(f, t->pixel[i][0], t->pixel[i][1]);
        f->block.in[at] = true;
        for (size_t to = 3 * at, c = 0; c < 3; c++, to++, from++) {
            f->nonfinite += !exact_join(&f->sum[to], &t->sum[from]);
            if (f->half != NULL && t->first_half) /* part of the sum: it cannot overflow before it */
                exact_join(&f->half[to], &t->sum[from]);
        }
    }
    film_take_splats(f, t);
    f->block.n_in += (size_t)t->n_pixels;
    f->nonfinite += t->nonfinite;
}

static void clear_block(struct film *f)
{
    f->passes = 0;
    f->block.n_in = 0;
    memset(f->block.in, 0, rect_pixels(f->rect) * sizeof *f->block.in);
    memset(f->block.splat, 0, values(f) * sizeof *f->block.splat);
}

void film_end_block(struct film *f)
{
    f->iterations += f->block.iterations;
    clear_block(f);
}

/* What must be added to the value in place i. Of a block under way pixels that are in have their own samples, but every
 * pixel has the splats of all that are in: where its samples count these are made to stand for the splats of all, else
 * taken out. */
static double block_correction(const struct film *f, size_t i)
{
    if (f->block.n_in == 0)
        return 0;
    double all = f->block.in[i / 3] ? (double)rect_pixels(f->rect) / (double)f->block.n_in : 0;
    return (all - 1) * (double)f->block.splat[i];
}

static long samples_of(const struct film *f, size_t pixel)
{
    return f->iterations + (f->block.in[pixel] ? f->block.iterations : 0) + (f->more != NULL ? f->more[pixel] : 0);
}

void film_settle(struct film *f)
{
    size_t n = rect_pixels(f->rect);
    if (f->more == NULL)
        f->more = mem_alloc(n, sizeof *f->more);
    for (size_t i = 0; i < values(f); i++)
        exact_add(&f->sum[i], block_correction(f, i));
    for (size_t i = 0; i < n; i++)
        f->more[i] = samples_of(f, i) - f->iterations;
    clear_block(f);
}

double film_samples(const struct film *f)
{
    double share = (double)f->block.n_in / (double)rect_pixels(f->rect);
    return (double)f->iterations + share * (double)f->block.iterations;
}

long film_develop(const struct film *f, double scale, float *out)
{
    long cut = 0;
    for (size_t i = 0; i < values(f); i++) {
        long samples = samples_of(f, i / 3);
        double value = samples > 0 ? (film_value(f, i) + block_correction(f, i)) * (scale / (double)samples) : 0;
        cut += !fits_float(value);
        out[i] = float_within(value);
    }
    return cut;
}

void film_warn(const struct film *f, long cut)
{
    if (f->nonfinite > 0)
        say_line("asbdpt: warning: %ld contributions were not finite, or too large, and were left out", f->nonfinite);
    if (cut > 0)
        say_line("asbdpt: warning: %ld pixel values were beyond 3.4e38 and were cut to it", cut);
}
