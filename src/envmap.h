/* envmap.h: an environment map and the sampling of directions in proportion to its brightness.
 *
 * Directions are in light space: with (s,v) in [0,1)^2, v = 0 at the top row of the picture, the direction is
 * (cos 2 pi s sin pi v, sin 2 pi s sin pi v, cos pi v), as in pbrt-v3.
 *
 * Used by: light. Tests: test_light.c.
 */
#ifndef ASBDPT_ENVMAP_H
#define ASBDPT_ENVMAP_H

#include "alias.h"
#include "error.h"
#include "image.h"
#include "rgb.h"
#include "vec.h"

struct envmap {
    struct image image;          /* owned */
    struct alias_table rows;     /* choice of a row of texels, by its light */
    struct alias_table *columns; /* [image.height], choice of a texel within its row; owned */
    rgb mean;                    /* average radiance over the sphere */
};

/* envmap_load: read a picture (8-bit ones are taken as sRGB). Returns NULL with a message. Release with
 * envmap_free. */
struct envmap *envmap_load(const char *path, struct error *err);
void envmap_free(struct envmap *e);

/* envmap_lookup: radiance from unit direction w of light space, bilinear. */
rgb envmap_lookup(const struct envmap *e, vec3 w);

/* envmap_sample: draw a direction of light space.
 *   pdf_w  out: its density, 1/sr; 0 at the exact poles or for a black map, where the sample is useless */
vec3 envmap_sample(const struct envmap *e, double u1, double u2, double *pdf_w);

/* envmap_pdf: density with which envmap_sample returns w, 1/sr. */
double envmap_pdf(const struct envmap *e, vec3 w);

#endif
