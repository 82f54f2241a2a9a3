/* pyramid.h: all strategies of an image on one sheet: a row per number of bounces, a column per s. The upper half has
 * each strategy's whole estimate, the lower half its weighted share. The sum of the lower images is the image [V97
 * 10.2.3].
 *
 * Longer paths carry less light, so every row is multiplied by the power of two that its label names. The first rows
 * are left out if they have no light.
 *
 * Tests: test_pictures.c.
 */
#ifndef ASBDPT_PYRAMID_H
#define ASBDPT_PYRAMID_H

#include "base/error.h"
#include "lab/strategies.h"

enum { PYRAMID_DEPTH = 15 }; /* longer paths are left out */

/* pyramid_write: as DIRECTORY/pyramid.png. False with a message.
 *   scale  as film_develop takes it */
bool pyramid_write(const char *directory, const struct strategy_images *images, double scale, struct error *err);

#endif
