/* pyramid.h: all strategies of a picture on one sheet: a row per path length, a column per s, above each strategy's
 * whole estimate, below its weighted share. The sum of the lower pictures is the picture [V97 10.2.3].
 *
 * Longer paths carry less light, so every row is brightened by the power of two that its label names.
 *
 * Tests: test_pictures.c.
 */
#ifndef ASBDPT_PYRAMID_H
#define ASBDPT_PYRAMID_H

#include "base/error.h"
#include "scene/film.h"

enum { PYRAMID_DEPTH = 15 }; /* longer paths are left out */

/* pyramid_write: as a picture whose extension image_write knows.
 *   film   rendered with film_keep_strategies, some iterations of it
 *   scale  as film_develop takes it
 * Returns false with a message. */
bool pyramid_write(const char *path, const struct film *film, double scale, struct error *err);

/* pyramid_strategy: the image of one strategy, [height*width*3] linear, to be freed. */
float *pyramid_strategy(const struct film *film, double scale, int s, int t, bool weighted);

#endif
