/* film.h: where estimates of pixels are summed, and the picture is made of the sums.
 *
 * A tile pass (one tile of pixels, a block of iterations) adds up in a tile, and the film takes it in. A pixel's
 * estimate has two parts. `eye`: per iteration, what its own eye sub-path brought (all strategies with t >= 2).
 * `splat`: what light sub-paths of any pixel sent straight to the lens (t = 1), spread by the pixel filter.
 *
 * The sums are exact (exact_sum.h): they depend on which values came in, not on their order, and not on how the
 * iterations were cut into blocks or parts.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_FILM_H
#define ASBDPT_FILM_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/exact_sum.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "scene/filter.h"

/* Pixels [x0,x1) x [y0,y1). */
struct pixel_rect {
    int x0, y0, x1, y1;
};

static inline int rect_width(struct pixel_rect r) { return r.x1 - r.x0; }
static inline int rect_height(struct pixel_rect r) { return r.y1 - r.y0; }
static inline size_t rect_pixels(struct pixel_rect r) { return (size_t)rect_width(r) * (size_t)rect_height(r); }

/* --- tiles ------------------------------------------------------------------------------------------- */

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
    int (*pixel)[2]; /* [n_pixels] x and y, in the order of their cells; owned */
    int n_pixels;
    struct pixel_rect film_rect; /* of the film: splats land anywhere in it */
    const struct filter *filter;
    struct exact_sum *sum; /* [n_pixels * 3], sum over the iterations of the pass; owned */
    size_t pixel_capacity, sum_capacity;
    struct splat *splat; /* [n_splats], owned */
    size_t n_splats, splat_capacity;
    bool first_half; /* its iterations belong to the first of two halves; tile_start: no */
    bool taken;      /* some of it is in the film, so its pass goes on to the end; tile_start: no */
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

/* --- the film ---------------------------------------------------------------------------------------- */

/* The block of iterations under way, for a picture that is wanted before it is complete. */
struct film_block {
    long iterations;
    size_t n_in;  /* pixels whose samples are in the film */
    bool *in;     /* [pixels]: which these are; owned */
    float *splat; /* [pixels*3], what its splats have brought; owned */
};

/* How far the picture is from what it converges to, as noise_estimate.h finds it. */
enum noise_scale { NOISE_RELATIVE, NOISE_8_BIT, N_NOISE_SCALES };
struct noise_estimate {
    double value, error; /* its standard error; both infinite where nothing is known */
};

struct film {
    struct pixel_rect rect;      /* the rendered part (crop) of the full frame */
    int full_width, full_height;
    long iterations;             /* samples per pixel taken so far */
    int64_t passes;              /* tile passes of the next block of iterations that are in already */
    struct film_block block;     /* that block */
    long *more;                  /* [pixels] samples of each beyond `iterations`, of blocks that film_settle has left
                                  * incomplete; NULL: there are none; owned */
    struct exact_sum *sum;       /* [pixels*3] of eye values and splats; owned */
    struct exact_sum *half;      /* [pixels*3], the picture's of every other `run` iterations, or NULL; owned */
    int run;                     /* set when the render begins */
    struct noise_estimate noise[N_NOISE_SCALES]; /* when the halves were of one size the last time */
    long nonfinite;
    bool learnt_short;   /* its samples use what was learnt in less than the full time */
};

/* film_bytes: what a film of these pixels takes, with halves or without, and the pictures that are made of it.
 * film_init: black, for the pixels of `rect` out of a frame of full_width x full_height. Release with film_free. */
double film_bytes(struct pixel_rect rect, bool halves);
void film_init(struct film *f, struct pixel_rect rect, int full_width, int full_height);
void film_free(struct film *f);

/* film_keep_halves: from now on keep the sums of every other run of iterations, too. */
void film_keep_halves(struct film *f);

/* film_take_splats: add a tile's splats, and empty its list. */
void film_take_splats(struct film *f, struct tile *t);

/* film_merge_tile: add these and a tile's sums. film_end_block: all tiles of the block are in, and count from now on.
 * film_settle: leave the block under way as it is: each pixel counts the samples that it has. */
void film_merge_tile(struct film *f, struct tile *t);
void film_end_block(struct film *f);
void film_settle(struct film *f);

/* film_value: the sum so far in place i of [pixels*3]. */
static inline double film_value(const struct film *f, size_t i) { return exact_value(&f->sum[i]); }

/* film_samples: per pixel, in the mean. */
double film_samples(const struct film *f);

/* film_develop: the image so far: [height*width*3] linear floats, top row first, each pixel times `scale`, the mean of
 * all samples that it has; black if that is none. Values that no float holds are cut to FLT_MAX; returns how many. */
long film_develop(const struct film *f, double scale, float *out);

/* film_warn: say on stderr how many contributions were left out and how many values film_develop cut, if any. */
void film_warn(const struct film *f, long cut);

#endif
