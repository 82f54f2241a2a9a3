/* worth.h: a picture of what `select = subspaces` has learnt (the pairs of tables.h), seen from one surface point.
 *
 * The point is what the camera sees through the middle of a pixel. Three pictures side by side, the point marked:
 *   scene   the colours of what is seen, as lit from the camera
 *   worth   of every surface seen: ratio(e,l), what a light vertex there is worth to the point
 *   draws   where the light vertices are that the point would draw: light sub-paths projected onto the film, each
 *           vertex with its probability in proportion to ratio L, as far as the camera sees it
 * The last two are coloured by their logarithm, over a factor of WORTH_RANGE below their largest value. A bar below
 * them shows the colours.
 *
 * Nothing of it depends on the race before a render, which is left out: a path tracer may have learnt no pairs.
 *
 * Tests: test_pictures.c, test/run/examples.sh.
 */
#ifndef ASBDPT_WORTH_H
#define ASBDPT_WORTH_H

#include "lab/sheet.h"
#include "render/render.h"

enum { WORTH_RANGE = 1000 };

/* worth_values: the two maps of numbers, before they become colours.
 *   scene    prepared
 *   options  of a render with asbdpt; how much is learnt depends on its samples
 *   x, y     the pixel, within the film
 *   worth, draws  out, [height*width] of the whole film, >= 0; the draws sum to at most 1
 * Returns false with a message: a bad parameter, a selection without such a table, or a pixel through which no surface
 * is seen that can be connected to. */
bool worth_values(const struct scene *scene, const struct render_job *options, int x, int y, float *worth,
                  float *draws, struct error *err);

/* worth_picture: all three, labelled, every pixel a square of `scale` pixels; 0: of as many as make each picture 320
 * pixels wide or more. *out is for the caller to free. */
bool worth_picture(const struct scene *scene, const struct render_job *options, int x, int y, int scale,
                   struct sheet *out, struct error *err);

#endif
