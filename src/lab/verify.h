/* verify.h: do two pictures, each known only up to its noise, have the same expectation?
 *
 * Each side is a set of independent batches (renders with seeds of their own), or one picture with its standard errors.
 * Pixels are averaged over square tiles, and Welch's test is made for every tile and channel. Were the expectations
 * equal, the p-values would be uniform on [0,1] [Jung, Hanika, Dachsbacher 2020]. Three numbers are drawn from them:
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
 * Tests: test_verify.c.
 */
#ifndef ASBDPT_VERIFY_H
#define ASBDPT_VERIFY_H

#include <stdbool.h>
#include <stdint.h>

/* One side: n values (tiles * 3 channels, or pixels * 3). */
struct sample {
    int n_batches; /* 1: `error` says how far the values may be off */
    long n;
    double *value; /* [n_batches * n], batch by batch */
    double *error; /* [n] standard errors of a single picture's values, else NULL */
};

struct sample sample_new(int n_batches, long n, bool with_error);
void sample_free(struct sample *s);

/* sample_tiles: average pixels over square tiles of `side` pixels (smaller at the right and lower edge).
 *   s  [height*width*3] values; errors are taken as independent from pixel to pixel */
struct sample sample_tiles(const struct sample *s, int width, int height, int side);

/* sample_mean: mean over all values, with its standard error (may be NULL). */
double sample_mean(const struct sample *s, double *error);

enum { VERIFY_BARS = 10 };

struct verdict {
    double smallest, mean, uniform; /* the three p-values explained above */
    double p;                       /* all in all: the smallest of the three, corrected for there being three */
    double ratio, ratio_error;      /* mean of a over mean of b */
    long n;                         /* p-values: tiles * 3 */
    long where;                     /* index of the smallest p-value */
    long bar[VERIFY_BARS];          /* how many p-values fall into each tenth of [0,1] */
};

/* verify_samples: a and b have the same n.
 *   p     out, [n], may be NULL: the p-values
 *   seed  of the random signs */
struct verdict verify_samples(const struct sample *a, const struct sample *b, uint64_t seed, double *p);

#endif
