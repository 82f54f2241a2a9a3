/* pictures.h: the pictures of an experiment on one sheet: the reference and what each method made of a scene, and below
 * each its errors as a heat map.
 *
 * The heat maps share one scale, so that they can be compared: dark is no error, bright is the 99th percentile of all
 * their errors, and more. Errors are those of the displayed 8-bit values, as in the tables.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_PICTURES_H
#define ASBDPT_PICTURES_H

#include "lab/sheet.h"
#include "lab/results.h"

enum { COLUMN_GAP = 24, COLUMN_LABEL = 60, COLUMN_WIDTH = 480, PICTURES_PERCENTILE = 99 };

/* draw_column: column `number` of a sheet: name, an error and what it took, and below it the picture, each of its
 * pixels a square of k x k.
 *   error  after its name, `kind`; NaN: unknown */
void draw_column(struct sheet *sheet, int number, const char *name, const char *kind, double error, const char *cost,
                 const float *pixels, int width, int height, int k);

/* pictures_error_scale: what the brightest colour stands for: that percentile of the root mean squares over the
 * channels of a pixel's 8-bit errors, over all pixels and compared methods. */
double pictures_error_scale(const struct scene_results *s);

/* pictures_write: images/SCENE.png. Returns false with a message. */
bool pictures_write(const struct scene_results *s, struct error *err);

#endif
