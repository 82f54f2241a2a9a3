/* splat.h: what a light sub-path sends straight to the lens (t = 1), and what part of it each pixel has: the value of
 * the pixel filter there, as of a sample at that raster point.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_SPLAT_H
#define ASBDPT_SPLAT_H

#include "base/number.h"
#include "base/rgb.h"
#include "scene/filter.h"
#include "scene/pixel_rect.h"

/* What a light sub-path sent to a raster point. */
struct splat {
    double px, py;
    rgb value;
    double length; /* of its path */
    int lights;    /* the group of lights it comes from */
};

/* rgb_fits_float: NaN, infinities and values beyond FLT_MAX have no place in a picture; squares of all others stay far
 * from overflow. */
static inline bool rgb_fits_float(rgb c) { return fits_float(c.r) && fits_float(c.g) && fits_float(c.b); }

/* splat_pixels: those of `within` whose filter covers the splat; none when x1 <= x0 or y1 <= y0.
 * splat_part: what it adds to one of them, as floats; false if no float holds it. */
struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within);
bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3]);

#endif
