/* envmap.h: an environment map and the sampling of directions in proportion to its brightness.
 *
 * Directions are in light space: with (s,v) in [0,1)^2, v = 0 at the top row of the picture, the direction is
 * (cos 2 pi s sin pi v, sin 2 pi s sin pi v, cos pi v), as in pbrt-v3.
 *
 * The picture is cut into blocks of texels. Choosing a block is the caller's business, by the blocks' light or by what
 * can be seen; within a block a texel is chosen by its light from an alias table.
 *
 * Tests: test_light.c.
 */
#ifndef ASBDPT_ENVMAP_H
#define ASBDPT_ENVMAP_H

#include "base/alias.h"
#include "base/error.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "image/image.h"

struct envmap {
    struct image image;        /* owned */
    int blocks_u, blocks_v;    /* blocks across and down */
    int block_width, block_height; /* texels; the last ones may be cut off */
    struct alias_table *block; /* [blocks_v * blocks_u], choice of a texel; `total` is the block's light; owned */
    rgb mean;                  /* average radiance over the sphere */
};

/* envmap_load: read a picture, whose numbers are taken as they are stored, 8-bit ones too, as in pbrt-v3. Returns NULL
 * with a message. Release with envmap_free.
 *   memory  that may be used for it; nothing is taken */
struct envmap *envmap_load(const char *path, const struct budget *memory, struct error *err);
void envmap_free(struct envmap *e);

/* envmap_of: a map for drawing directions alone, in proportion to the luminance of each texel, [width*height]. */
struct envmap *envmap_of(const double *luminance, int width, int height);

/* envmap_direction: the direction of (s,v). envmap_lookup: radiance from unit direction w of light space, bilinear. */
vec3 envmap_direction(double s, double v);
rgb envmap_lookup(const struct envmap *e, vec3 w);

/* envmap_picture: the value at (s,v), bilinear. */
rgb envmap_picture(const struct envmap *e, double s, double v);

/* envmap_bytes: what its tables take, 44 for a texel. */
enum { ENVMAP_BYTES_PER_TEXEL = 44 };
static inline size_t envmap_bytes(const struct envmap *e)
{
    return (size_t)e->image.width * (size_t)e->image.height * ENVMAP_BYTES_PER_TEXEL;
}

static inline int envmap_blocks(const struct envmap *e) { return e->blocks_u * e->blocks_v; }

/* envmap_sample: draw a direction of light space from a block.
 *   pdf_dir  out: its density within the block, 1/sr; 0 at the exact poles, where the sample is useless */
vec3 envmap_sample(const struct envmap *e, int block, double u1, double u2, double *pdf_dir);

/* envmap_pdf: the block that w belongs to and the density with which envmap_sample returns w from it, 1/sr. */
double envmap_pdf(const struct envmap *e, vec3 w, int *block);

#endif
