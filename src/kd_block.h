/* kd_block.h: what the leaves of the kd-tree refer to, and a ray's test of it: up to four triangles in one loop.
 *
 * The block keeps its triangles lane by lane, so that a compiler can do the loop's arithmetic on all four at once. It
 * is done in float and only sorts out: a triangle stays in unless the ray certainly misses it, and those that stay
 * are tested in double by triangle_hit, which alone decides. With s the largest coordinate of scene and origin and
 * u = 2^-24, a sheared coordinate in float is off by at most 14 u s, and an edge function by at most 64 u s times the
 * sum S of the six coordinates' absolute values (were S itself below 16 u s, the edge function would be smaller
 * than that). This is the slack an edge function is given; FLT_MIN covers what underflows.
 *
 * Used by: kd_build (fills blocks), kdtree. Tests: test_kdtree.c.
 */
#ifndef ASBDPT_KD_BLOCK_H
#define ASBDPT_KD_BLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "shape.h"

enum { KD_LANES = 4 };

/* Up to four triangles, or up to four quadrics. */
struct kd_block {
    float v[3][3][KD_LANES]; /* corner, axis, lane; zeros for a quadric and an unused lane */
    uint32_t prim[KD_LANES]; /* primitive number, with KD_ALPHA added if its group has an alpha texture */
};

#define KD_ALPHA 0x80000000u /* primitive numbers are below 2^31 */
#define KD_NONE  0xffffffffu /* an unused lane; they are the last ones */

/* A ray and what the test needs of it. */
struct kd_block_ray {
    const struct ray *ray;
    struct triangle_ray exact;
    float ox, oy, oz, sx, sy; /* of exact, in float */
    float slack;              /* 64 u s */
};

/* kd_block_ray: prepare for the scene whose largest absolute coordinate, or the ray's origin's, is `size`. */
struct kd_block_ray kd_block_ray(const struct ray *ray, double size);

/* kd_block_fill: a block of n <= KD_LANES primitives, all triangles or all quadrics. */
void kd_block_fill(struct kd_block *b, const struct geometry *geo, const int *prim, int n);

/* kd_block_hit: the first hit within (ray->tmin, tmax), honouring alpha; false, with *hit untouched, if none. */
bool kd_block_hit(const struct kd_block *b, const struct geometry *geo, const struct kd_block_ray *r, double tmax,
                  bool shadow, struct hit *hit);

#endif
