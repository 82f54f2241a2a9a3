/* pictures.h: the pictures of an experiment on one sheet: the reference and what each method made of a scene, and below
 * each its errors as a heat map.
 *
 * The heat maps share one scale, so that they can be compared: dark is no error, bright is the 99th percentile of all
 * their errors, and more. Errors are those of the displayed 8-bit values, as in the tables.
 *
 * Tests: test_report.c, test_pictures.c, test/cli.sh.
 */
#ifndef ASBDPT_PICTURES_H
#define ASBDPT_PICTURES_H

#include "lab/results.h"
#include "lab/sheet.h"

enum { COLUMN_GAP = 24, COLUMN_LABEL = 60, COLUMN_WIDTH = 480, PICTURES_PERCENTILE = 99 };

/* pictures_error_scale: what the brightest colour stands for: that percentile of the root mean squares over the
 * channels of a pixel's 8-bit errors, over all pixels and compared methods. */
double pictures_error_scale(const struct scene_results *s);

/* pictures_write: images/SCENE.png. Returns false with a message. */
bool pictures_write(const struct scene_results *s, struct error *err);

/* demo_draw: the pictures of the one scene of a plan at equal time side by side with the reference, labelled with the
 * root mean square of the errors of all 8-bit values, and with that of means over 8x8 pixels; to be released with
 * sheet_free. Where pictures are k times as wide and high as the reference (plan.h, scale), the mean of k x k of their
 * pixels is compared with one of it: with a box filter both have the same expectation. demo_print: a line for each
 * method. */
void demo_draw(const struct results *r, struct sheet *picture);
void demo_print(FILE *f, const struct results *r);

#endif
