/* develop.h: from the sums of a film to the values of a picture.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_DEVELOP_H
#define ASBDPT_DEVELOP_H

#include "scene/film.h"

/* film_develop: the image so far: [height*width*3] linear floats, top row first, each pixel times `scale`, the mean of
 * all samples that it has; black if that is none. Values that no float holds are cut to FLT_MAX; returns how many.
 * film_develop_plane: the same of another plane than the picture. */
long film_develop(const struct film *f, double scale, float *out);
long film_develop_plane(const struct film *f, int plane, double scale, float *out);

/* film_alpha: the plane of alpha, grey, [height*width*3], to be given to free(); NULL if there is none. */
float *film_alpha(const struct film *f);

/* film_warn: say on stderr how many contributions were left out and how many values film_develop cut, if any. */
void film_warn(const struct film *f, long cut);

/* film_standard_error: of each value of film_develop; infinite with fewer than two iterations. The film must have been
 * asked to keep errors. */
void film_standard_error(const struct film *f, double scale, float *out);

#endif
