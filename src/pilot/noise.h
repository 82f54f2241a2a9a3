/* noise.h: how noisy are the samples whose number is free? Measured on a few tiles before the render, for the pilot.
 *
 * Every tile is rendered three times with random numbers of its own, the third with the eye sub-paths of the first. Its
 * pixels' differences say what varies with the eye sub-path and what does not; the spread of the samples that one eye
 * vertex has, how much of the latter is due to them. All is relative to the brightness around the pixel.
 *
 * Light sub-paths are shared by a tile, so what is due to them does not vanish in the mean over many pixels, as other
 * noise does. It is measured on blocks of 8x8 pixels, too: a picture that is even in each block is not yet a good one.
 *
 * What if there were no light sub-paths? The second moment of the path tracer's estimate is larger than that of all
 * strategies' by the sum of
 *     X^2 (1 / P - 1),
 * where X is what a sample of any strategy brings and P the share that s <= 1 have in the weights of its path. So its
 * fireflies are foreseen by the strategies that make those paths often. P is found by a fourth render, with the numbers
 * of the first and the counts of s <= 1 twice as large: the weights of the others are smaller by 1 / (1 + P) then.
 *
 * Tests: test_pilot.c.
 */
#ifndef ASBDPT_NOISE_H
#define ASBDPT_NOISE_H

#include "pilot/subspaces_state.h"

/* The kinds of samples whose number is free. */
enum kind { DRAW_FIRST, DRAW_LATER, LIGHT_FIRST, LIGHT_PATH, N_KINDS };

/* Variances of one iteration, added up over the pixels of all tiles. */
struct noise {
    double total, given_eye;         /* of a pixel; of one whose eye sub-path is given */
    double blocks;                   /* the latter of means over blocks, times their pixels */
    double tail;                     /* what there would be more without light sub-paths, see above */
    double spread[N_KINDS];          /* variance of the sum of the samples of one eye vertex */
};

/* The method that tiles are rendered by, and the memory of its threads. */
struct pilot_method {
    void (*render)(const void *method, struct subspaces_state *s, const struct tile_pass *pass);
    const void *method;     /* for `render` */
    struct workspace *work; /* [n_threads] */
};

/* noise_measure: render so many tiles with the state, `tried` samples of each kind being taken. Returns false if
 * job->watch ended it. */
bool noise_measure(const struct render_job *job, const struct pilot_method *method, struct subspaces_state *state,
                   const double *tried, int n, struct noise *out);

/* noise_tiles: how many there are to be, by the size of the picture alone. */
int noise_tiles(const struct render_job *job);

#endif
