/* compare.h: how far an image is from a reference.
 *
 * Tests: test_render.c.
 */
#ifndef ASBDPT_COMPARE_H
#define ASBDPT_COMPARE_H

#include <stdbool.h>

#include "base/error.h"
#include "image/image.h"

/* Errors over all pixels and channels. Pairs with a NaN or infinity are counted and left out; errors are infinite where
 * no pair is left, psnr is -infinity and mean_ratio NaN. */
struct difference {
    double rmse;       /* root of the mean of (x - r)^2, linear */
    double rmse8;      /* the same on 8-bit sRGB values, 0..255: the scale of the dissertation's tables */
    double relmse;     /* mean of (x - r)^2 / (r^2 + 0.01) */
    double mean_ratio; /* mean of x over mean of r; 0/0 is 1 */
    long nonfinite;
    double psnr;       /* 20 log10(255 / rmse8), in decibels; infinite where rmse8 is 0 */
};

/* compare_pixels: x and r are [n] linear values. */
struct difference compare_pixels(const float *x, const float *r, long n);

/* Blocks of 8x8 pixels, or in smaller pictures of the largest that fit: of their means errors that pixels nearby share
 * stay, those that they do not are divided by 64. What is left at the right and lower edge does not count. */
enum { COMPARE_BLOCK = 8 };
int compare_block(int width, int height); /* their side */

/* compare_shown_blocks: rmse8 of their means, of what a screen shows: light beyond white, which an 8-bit reference has
 * not, counts as white. */
double compare_shown_blocks(const float *x, const float *r, int width, int height);

/* compare_squares: squared differences of two pictures: of 8-bit values, the square of rmse8; relative, of linear
 * values; the same of means over blocks. Half of them are the squared errors of two independent renders of one
 * expectation.
 *   r  what they are relative to */
enum square { SQUARE_MSE8, SQUARE_RELMSE, SQUARE_BLOCKS, N_SQUARES };
void compare_squares(const float *x, const float *y, const float *r, int width, int height, double out[N_SQUARES]);

/* compare_errors: of each pixel the root mean square of its channels' errors; infinite where it is not finite.
 *   x, r  [pixels*3];  out  [pixels] */
void compare_errors(const float *x, const float *r, long pixels, float *out);

/* compare_heatmap: errors as colours, from viridis' dark end for none to its bright end for `most` and above; all dark
 * if that is 0.
 *   out  [pixels*3], linear values ready for image_write */
void compare_heatmap(const float *error, long pixels, double most, float *out);

/* picture_percentile: the smallest of n errors that at least `percent` % of them, 0 to 100, do not exceed. Infinite
 * ones count as the largest finite one. 0 if there is none. */
double picture_percentile(const float *error, long n, double percent);

#endif
