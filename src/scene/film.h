/* film.h: where estimates of pixels are summed, and the picture is made of the sums.
 *
 * Tile passes fill tiles (tile.h), and the film takes them in. The sums are exact (exact_sum.h): they depend on which
 * values came in, not on their order, and not on how the iterations were cut into blocks or parts.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_FILM_H
#define ASBDPT_FILM_H

#include <stdint.h>

#include "scene/tile.h"

/* The block of iterations under way, for a picture that is wanted before it is complete. */
struct film_block {
    long iterations;
    size_t n_in;  /* pixels whose samples are in the film */
    bool *in;     /* [pixels]: which these are; owned */
    float *splat; /* [pixels*3], what its splats have brought; owned */
};

/* How far the picture is from what it converges to, as halves.h finds it. */
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

/* film_bytes: what a film of these pixels takes, and the pictures that are made of it.
 * film_init: black, for the pixels of `rect` out of a frame of full_width x full_height. Release with film_free. */
double film_bytes(struct pixel_rect rect);
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
