/* pictures.h: the pictures of an experiment as PNG files: what each variant made of a scene, its errors as a heat
 * map, and enlarged details of both.
 *
 * Heat maps of one scene share one scale, so that they can be compared: dark is no error, bright is the 99th
 * percentile of all its variants' errors, and more. Errors are those of the displayed 8-bit values, as in the tables.
 * The details are the two windows, a fifth of the width wide, in which BDPT errs most.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_PICTURES_H
#define ASBDPT_PICTURES_H

#include "lab/results.h"

enum { PICTURE_REFERENCE = -1, N_DETAILS = 2, PICTURES_PERCENTILE = 99 };

/* The range, for the exposure of the page's viewer, is a PNG of twice the height whose upper half holds the mantissas
 * of rgbe_encode and whose lower half, in all channels, their common exponent. */
enum picture_kind {
    PICTURE_ITSELF, /* 8-bit sRGB */
    PICTURE_ERROR,  /* its heat map; not of the reference */
    PICTURE_RANGE   /* its whole range of values */
};

struct detail {
    int x, y, width, height, enlargement; /* pixels; enlargement: pixels of the file per pixel */
};

/* picture_path: DIRECTORY/images/... of a variant or PICTURE_REFERENCE.
 *   detail  0: the whole; 1 .. N_DETAILS: that detail */
void picture_path(const struct scene_results *s, int variant, enum picture_kind kind,
                  int detail, char *out, size_t size);

/* pictures_find_details: choose the windows. */
void pictures_find_details(const struct scene_results *s, struct detail out[N_DETAILS]);

/* pictures_error_scale: what the brightest colour stands for: that percentile of the root mean squares over the
 * channels of a pixel's 8-bit errors, over all pixels and variants. */
double pictures_error_scale(const struct scene_results *s);

/* pictures_write: all of a scene. Returns false with a message. */
bool pictures_write(const struct scene_results *s, struct error *err);

#endif
