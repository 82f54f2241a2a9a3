/* tile.h: what a tile pass (one tile of pixels, a block of iterations) adds up, before the film takes it in.
 *
 * A pixel's estimate has two parts. `eye`: per iteration, what its own eye sub-path brought (all strategies with
 * t >= 2). `splat`: what light sub-paths of any pixel sent straight to the lens (t = 1), spread by the pixel filter.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_TILE_H
#define ASBDPT_TILE_H

#include <math.h>
#include <stdbool.h>

#include "base/exact_sum.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "scene/filter.h"
#include "scene/pixel_rect.h"

/* The pixels of a tile, one in each cell of nx x ny pixels of a rectangle that interleaved tiles share. A hash of the
 * cell says which, so that what a tile's pixels have in common forms no pattern. Cells at the right and at the bottom
 * may be incomplete: w x h pixels are those of the tiles with x < w and y < h. */
struct tile_pixels {
    struct pixel_rect rect;
    int nx, ny, x, y; /* 0 <= x < nx, 0 <= y < ny tell the tiles apart */
};

/* pixels_columns, pixels_rows, pixels_count: cells in which the tile has a pixel.
 * pixels_get: the one in cell number i >= 0, row by row; false if there are not so many. pixels_cell: the number of the
 * cell of (x,y), in which the tile has one. */
static inline int pixels_columns(struct tile_pixels p) { return (rect_width(p.rect) - p.x + p.nx - 1) / p.nx; }
static inline int pixels_rows(struct tile_pixels p) { return (rect_height(p.rect) - p.y + p.ny - 1) / p.ny; }
static inline int pixels_count(struct tile_pixels p) { return pixels_columns(p) * pixels_rows(p); }
static inline int pixels_cell(struct tile_pixels p, int x, int y)
{
    return (y - p.rect.y0) / p.ny * pixels_columns(p) + (x - p.rect.x0) / p.nx;
}
bool pixels_get(struct tile_pixels p, int i, int *x, int *y);

/* What a light sub-path sent to a raster point. */
struct splat {
    double px, py;
    rgb value;
};

/* rgb_fits_float: NaN, infinities and values beyond FLT_MAX have no place in a picture; squares of all others stay far
 * from overflow. */
static inline bool rgb_fits_float(rgb c) { return fits_float(c.r) && fits_float(c.g) && fits_float(c.b); }

/* splat_pixels: those of `within` whose filter covers the splat; none when x1 <= x0 or y1 <= y0.
 * splat_part: what it adds to one of them, as floats; false if no float holds it. */
struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within);
bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3]);

/* So many splats do not wait for the end of a pass: paths may have a thousand bounces, a pass any number of
 * iterations. */
enum { TILE_FULL = 1 << 18 };

/* What a tile pass produces. Reused from pass to pass. */
struct tile {
    struct tile_pixels pixels;
    struct pixel_rect film_rect; /* of the film: splats land anywhere in it */
    const struct filter *filter;
    struct exact_sum *sum; /* [pixels * 3], sum over the iterations of the pass; owned */
    size_t capacity;
    struct splat *splat; /* [n_splats], owned */
    size_t n_splats, splat_capacity;
    bool first_half; /* its iterations belong to the first of two halves; tile_start: no */
    void (*full)(void *context, struct tile *tile); /* empties a full list of splats; NULL: it grows */
    void *context;
    long nonfinite; /* contributions that were NaN, infinite or beyond FLT_MAX, and were left out */
};

/* tile_start: begin a pass: clear the sums. */
void tile_start(struct tile *t, struct tile_pixels pixels, struct pixel_rect film_rect, const struct filter *filter);
void tile_free(struct tile *t);

/* tile_add: the whole value of pixel (x,y) of the tile for one iteration. Call once per pixel and iteration. */
void tile_add(struct tile *t, int x, int y, rgb value);

/* tile_add_splat: a value arriving at raster point (px,py), to be spread over pixels by the filter. False if it was
 * left out. */
bool tile_add_splat(struct tile *t, double px, double py, rgb value);

#endif
