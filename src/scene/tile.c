/* tile.c: see tile.h. */
#include "scene/tile.h"

#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/number.h"

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
    size_t n = (size_t)pixels_count(pixels) * 3;
    t->pixels = pixels;
    t->film_rect = film_rect;
    t->filter = filter;
    t->sum = mem_grow(t->sum, &t->capacity, n, sizeof *t->sum);
    memset(t->sum, 0, n * sizeof *t->sum);
    t->n_splats = 0;
    t->first_half = false;
    t->nonfinite = 0;
}

void tile_free(struct tile *t)
{
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
