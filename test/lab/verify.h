/* verify.h: do two pictures, each known only up to its noise, have the same expectation?
 *
 * Each side is a set of independent batches (renders with seeds of their own), or one picture with its standard errors.
 * Pixels are averaged over square tiles, and Welch's test is made for every tile and channel. Were the expectations
 * equal, the p-values would be uniform on [0,1] [Jung 2020]. Three numbers are drawn from them:
 *
 *     smallest    the smallest p-value, corrected for their number by Sidak's formula: one wrong spot
 *     mean        Welch's test of the mean of the whole picture: a faint error everywhere
 *     uniform     Kolmogorov-Smirnov distance of the p-values from uniformity: many small errors; it also rejects
 *                 pictures that are too alike to be independent, such as renders that share a seed
 *
 * Tiles that share light sub-paths, and channels of one tile, are not independent, so the distance is not judged by its
 * textbook distribution alone but by what it comes to when the hypothesis is true and all dependences are as they are:
 * the deviations of the batches from their mean, each batch multiplied by a random sign ("wild bootstrap" [Liu 1988]).
 * Kolmogorov's distribution is stretched until its 90 % quantile is the one found that way.
 *
 * Welch's test takes the means of batches for nearly normal. Where rare samples have most of the light they are not:
 * all batches may miss them alike, look sure, and be too dark; or too bright where rare samples are dark, as at the
 * edge of a shadow. Let a side of a tile be off the other's mean by D. Let a rare sample be as large as the largest
 * step from the mean, c, that a batch of this side has made in this tile or one near it. Then D n / c samples are
 * missing of n batches, and all of them are with the probability
 *
 *     exp(-D n / c).
 *
 * If that is more than Welch's p-value it takes its place. Where batches scatter evenly it never is, but in a tile next
 * to a noisier one a difference must be larger to be seen. Such p-values are not uniform where expectations are equal,
 * but larger; the same resamplings say how many then are expected in each tenth of [0,1]. Rare samples that no tile
 * near has met are not known: with less than half of one in a tile equal expectations may DIFFER, in other tiles with
 * another --seed. A bias stays.
 *
 * Tests: test_verify.c.
 */
#ifndef ASBDPT_VERIFY_H
#define ASBDPT_VERIFY_H

#include <stdbool.h>
#include <stdint.h>

/* One side: n values (tiles * 3 channels, or pixels * 3). */
struct batches {
    int n_batches; /* 1: `error` says how far the values may be off */
    long n, across; /* tiles: so many in a row; else 0 */
    double *value; /* [n_batches * n], batch by batch */
    double *error; /* [n] standard errors of a single picture's values, else NULL */
};

struct batches batches_new(int n_batches, long n, bool with_error);
void batches_free(struct batches *b);

/* batches_tiles: average pixels over square tiles of `side` pixels (smaller at the right and lower edge).
 *   b  [height*width*3] values; errors are taken as independent from pixel to pixel */
struct batches batches_tiles(const struct batches *b, int width, int height, int side);

/* Mean, variance and number as Welch's test wants them: the standard error is the root of variance / n. */
struct moments {
    double mean, variance, n;
};

/* batches_moments: of value i. */
struct moments batches_moments(const struct batches *b, long i);

/* batches_mean: mean over all values, with its standard error (may be NULL). */
double batches_mean(const struct batches *b, double *error);

/* batches_smallest_p: p-value of "all expectations are equal": the smallest of Welch's tests of all values, corrected
 * by Sidak's formula for their number; those of two exact, equal values say nothing. NaN if none says anything, or if
 * a value is NaN. */
double batches_smallest_p(const struct batches *a, const struct batches *b);

enum { VERIFY_BARS = 10 };

struct verdict {
    double smallest, mean, uniform; /* the three p-values explained above */
    double p;                       /* all in all: the smallest of the three, corrected for there being three */
    double ratio, ratio_error;      /* mean of a over mean of b */
    long n;                         /* p-values: tiles * 3 */
    long where;                     /* index of the smallest p-value */
    double bar[VERIFY_BARS];        /* how many p-values fall into each tenth of [0,1] */
    double expected[VERIFY_BARS];   /* and how many would in the mean if all expectations were equal */
};

/* verify_batches: a and b have the same n; the seed is that of the random signs. All p-values are 1 where everything is
 * exact and equal, and p is NaN where a value is or where there are none: what agrees has p >= a level. */
struct verdict verify_batches(const struct batches *a, const struct batches *b, uint64_t seed);

#endif
