/* compare.h: how far an image is from a reference.
 *
 * Tests: test_render.c.
 */
#ifndef ASBDPT_COMPARE_H
#define ASBDPT_COMPARE_H

#include "base/error.h"

/* Errors over all pixels and channels. Pairs with a NaN or infinity are counted and left out. */
struct difference {
    double rmse;       /* root of the mean of (x - r)^2, linear */
    double rmse8;      /* the same on 8-bit sRGB values, 0..255: the scale of the dissertation's tables */
    double relmse;     /* mean of (x - r)^2 / (r^2 + 0.01) */
    double mean_ratio; /* mean of x over mean of r; 0/0 is 1 */
    long nonfinite;
};

/* compare_pixels: x and r are [n] linear values. */
struct difference compare_pixels(const float *x, const float *r, long n);

/* compare_heatmap: per-pixel error from blue (lowest) to green (highest), normalised by the largest.
 *   x, r  [pixels*3];  out  [pixels*3], linear values ready for image_write */
void compare_heatmap(const float *x, const float *r, long pixels, float *out);

/* load_linear: read any picture as linear RGB floats [height*width*3], top row first, to be freed. 8-bit files are
 * decoded from sRGB. NULL with a message. */
float *load_linear(const char *path, int *width, int *height, struct error *err);

#endif
