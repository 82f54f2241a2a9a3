/* demo.h: methods at the same CPU time in one picture: what each made of a scene, side by side with the
 * reference, which is rendered where none is stored, labelled with the root mean square of the errors of all 8-bit
 * values, and with that of means over 8x8 pixels.
 *
 * Where the reference is small, pictures may be rendered k times as wide and high (plan.h, scale): then the mean of
 * k x k of their pixels is compared with one of the reference. With a box filter both have the same expectation.
 *
 * Tests: test_pictures.c, test/cli.sh.
 */
#ifndef ASBDPT_DEMO_H
#define ASBDPT_DEMO_H

#include "lab/results.h"
#include "lab/sheet.h"

/* demo_draw: the picture of the one scene of a plan at equal time; to be released with sheet_free. demo_print: a line
 * for each method. */
void demo_draw(const struct results *r, struct sheet *picture);
void demo_print(FILE *f, const struct results *r);

#endif
