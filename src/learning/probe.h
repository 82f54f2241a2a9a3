/* probe.h: samples that no picture is made of: how good are a method's estimates, and what does their noise consist of?
 *
 * A probe takes samples of some pixels and reduces what its observer is told of their paths (observer.h). All probes
 * have the same rules. Numbers: a seed unlike the render's, combined with the number of the pixel or tile and with what
 * its repetitions are not to share. Brightness: squares are relative to the square of 3/4 of the light around the pixel
 * and 1/4 of all, so that what is dark by chance is not taken for important. Clip: no squared relative deviation counts
 * for more than PROBE_CLIP, since a picture's white is not far off.
 *
 * Tests: test_pilot.c.
 */
#ifndef ASBDPT_PROBE_H
#define ASBDPT_PROBE_H

#include "transport/pixel_sample.h"

#define PROBE_CLIP 25.0

/* Who takes the samples. */
struct probe {
    const struct render_job *job; /* of the render */
    struct workspace *work;       /* [job->n_threads], with the method's scratch */
    /* What follows is for noise_measure. */
    const void *method; /* handed to: */
    void (*render)(const void *method, const struct mis_counts *counts, const struct tile_pass *pass);
    const struct mis_counts *counts;
    struct pass_size size; /* of the render's tiles: the probe's are as large, and as far apart are their pixels */
};

/* probe_job: the render's job, but for its seed, which `number` is combined with. */
static inline struct render_job probe_job(const struct render_job *job, uint64_t number)
{
    struct render_job other = *job;
    other.seed = other.eye_seed = hash_combine(hash_combine(job->seed, 0x3c6ef372fe94f82bu), number);
    return other;
}

/* probe_scale: what squares are divided by where the light is `local`, and `all` in the mean. */
static inline double probe_scale(double local, double all) { return sqr(0.75 * local + 0.25 * all) + 1e-30; }

/* --- light that comes straight ----------------------------------------------------------------------- */

/* How well do a pixel's numbers estimate the light that comes straight to its first hit? The weights compare samples by
 * second moments, as if all were independent (mis.h). Those of the eye sub-path's first vertices are not: over the
 * iterations of a pixel they are spread evenly (sampler.h), and the light of a lamp that is always there has hardly any
 * variance at all. So strategies s = 0 and s = 1 deserve a credit there,
 *     E[X^2] / (N V_N),
 * where X is what a sample brings and V_N the variance of the mean of N samples of a pixel [Grittmann 2019]. Some
 * pixels take 16 samples by path tracing, twice; half the squared difference of the two means is V_16. */
struct credit {
    double broad; /* of s = 0 and s = 1, for lights that both can find */
    double delta; /* of s = 1, for those that s = 0 cannot */
};

/* credit_measure: for lights as `tables` choose them. As many samples as the picture has pixels, or a few more, but at
 * most 32768, unless job->watch ends it. */
struct credit credit_measure(const struct probe *p, const struct tables *tables);

/* --- noise ------------------------------------------------------------------------------------------- */

/* The kinds of samples whose number is free: draws and light points for one eye vertex, light sub-paths. */
enum kind { DRAW_FIRST, DRAW_LATER, LIGHT_FIRST, LIGHT_PATH, N_KINDS };

/* Variances of one iteration, added up over the pixels of some tiles. Half the squared difference of two renders of a
 * pixel is the variance of what they do not share. Every tile is rendered three times: with random numbers of its own,
 * with others, and with others but for the eye sub-paths.
 *
 * Light sub-paths are shared by a tile, so what is due to them does not vanish in the mean over many pixels, as other
 * noise does. It is measured on blocks of 8x8 pixels, too: a picture that is even in each block is not yet a good one.
 * Splats (t = 1) are rare and independent, their variance is their square; what the tile's sub-paths bring, wherever it
 * lands, stands for what all sub-paths bring to the tile.
 *
 * What if there were no light sub-paths? The second moment of the path tracer's estimate is larger than that of all
 * strategies' by the sum of
 *     X^2 (1 / P - 1),
 * where X is what a sample of any strategy brings and P the share that s <= 1 have in the weights of its path. So its
 * fireflies are foreseen by the strategies that make those paths often. P is found by a fourth render, with the numbers
 * of the first and the counts of s <= 1 twice as large: the weights of the others are smaller by 1 / (1 + P) then. */
struct noise {
    double total, given_eye; /* of a pixel; of one whose eye sub-path is given */
    double blocks;           /* the latter of means over blocks, times their pixels */
    double tail;             /* what there would be more without light sub-paths */
    double spread[LIGHT_PATH]; /* variance of the sum of the samples of one eye vertex */
};

/* noise_measure: by samples for each pixel of the picture and render, in whole tiles; `tried` samples of each kind are
 * taken, or NULL: then only `total` and `tail` are asked for, and a render is spared. All zeros if job->watch ended
 * it. */
struct noise noise_measure(const struct probe *p, const double *tried, double samples);

#endif
