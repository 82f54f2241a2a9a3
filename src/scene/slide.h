/* slide.h: the picture that gives a goniometric or projection light its intensity by direction, and how to look it up.
 *
 * As in pbrt-v3 its numbers are taken as they are stored, 8-bit ones too. Its first row is v = 0.
 *
 * Tests: test_light.c.
 */
#ifndef ASBDPT_SLIDE_H
#define ASBDPT_SLIDE_H

#include "base/error.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "image/image.h"

struct slide {
    struct image image; /* owned; numbers that are negative or not finite are 0 */
    rgb mean;           /* of all texels */
};

/* slide_load: read a picture. Returns NULL with a message. Release with slide_free. */
struct slide *slide_load(const char *path, struct error *err);
void slide_free(struct slide *s);

/* slide_goniometric: factor of the intensity in unit direction w of light space, whose y axis is the pole: v counts
 * from it, u is the azimuth from x to z. NULL: 1. */
rgb slide_goniometric(const struct slide *s, vec3 w);

/* slide_projection: the same where the picture is projected along z, its shorter side (without a picture both) as wide
 * as tan_half at z = 1 to either side, u growing with x and v with y. Black outside and behind. */
rgb slide_projection(const struct slide *s, double tan_half, vec3 w);

/* slide_cos_corner: the cosine between the z axis and the farthest corner of such a projection. */
double slide_cos_corner(const struct slide *s, double tan_half);

#endif
