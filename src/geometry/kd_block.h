/* kd_block.h: the kd-tree in memory, shared by its builder and its traversal and nobody else's business: its nodes, the
 * blocks that its leaves refer to, and a ray's test of a block: up to four triangles in one loop.
 *
 * A block keeps its triangles lane by lane, so that a compiler can do the loop's arithmetic on all four at once. It
 * is done in float and only sorts out: a triangle stays in unless the ray certainly misses it, and those that stay
 * are tested in double by triangle_hit, which alone decides. With s the largest coordinate of scene and origin and
 * u = 2^-24, a sheared coordinate in float is off by at most 14 u s, and an edge function by at most 64 u s times the
 * sum S of the six coordinates' absolute values (were S itself below 16 u s, the edge function would be smaller
 * than that). This is the slack an edge function is given; FLT_MIN covers what underflows.
 *
 * Tests: test_kdtree.c.
 */
#ifndef ASBDPT_KD_BLOCK_H
#define ASBDPT_KD_BLOCK_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "geometry/shape.h"

/* --- nodes -------------------------------------------------------------------------------------------- */

/* Eight bytes. The two children of an inner node are neighbours, the lower side first: pair p is nodes 2p and 2p + 1.
 * The root is node 0, and node 1 is not used. */
struct kd_node {
    uint32_t word; /* low 2 bits: axis, or 3 for a leaf. Above them: blocks of a leaf; or the number of the pair of
                      children */
    union {
        float split;    /* inner: position of the plane */
        uint32_t first; /* leaf: its first block in kdtree.block */
    } at;
};

enum {
    KD_LEAF = 3,
    KD_MAX_DEPTH = 60 /* the longest way from the root to a leaf, hence the size of the traversal's stack */
};

static inline bool kd_is_leaf(struct kd_node n) { return (n.word & 3) == KD_LEAF; }
static inline uint32_t kd_blocks(struct kd_node leaf) { return leaf.word >> 2; }
static inline uint32_t kd_children(struct kd_node n) { return n.word >> 2 << 1; }

/* --- blocks ------------------------------------------------------------------------------------------- */

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
    struct triangle_ray exact;
    float ox, oy, oz, sx, sy; /* of exact, in float */
    float slack;              /* 64 u s */
    uint32_t from, to;        /* primitive numbers of the triangles it begins and ends on, KD_NONE: on none */
};

/* kd_block_ray: prepare *r for the scene whose largest absolute coordinate, or the ray's origin's, is `size`. */
void kd_block_ray(struct kd_block_ray *r, const struct ray *ray, double size);

/* kd_block_fill: a block of n <= KD_LANES primitives, all triangles or all quadrics. */
void kd_block_fill(struct kd_block *b, const struct geometry *geo, const int *prim, int n);

/* kd_block_near: which lanes may the ray hit? Sets near[i] to 1 or 0 and returns whether any is 1. A quadric's zeros
 * always may. Here rather than in kd_block.c, since most blocks of a leaf need nothing more, and no call. The names are
 * those of triangle_hit. */
static inline bool kd_block_near(const struct kd_block *b, const struct kd_block_ray *r, int near[KD_LANES])
{
    const float *a_x = b->v[0][r->exact.kx], *a_y = b->v[0][r->exact.ky], *a_z = b->v[0][r->exact.kz];
    const float *b_x = b->v[1][r->exact.kx], *b_y = b->v[1][r->exact.ky], *b_z = b->v[1][r->exact.kz];
    const float *c_x = b->v[2][r->exact.kx], *c_y = b->v[2][r->exact.ky], *c_z = b->v[2][r->exact.kz];
    const float ox = r->ox, oy = r->oy, oz = r->oz, sx = r->sx, sy = r->sy, factor = r->slack;
    const uint32_t *prim = b->prim, from = r->from, to = r->to;
    int any = 0;
    for (int i = 0; i < KD_LANES; i++) {
        float az = a_z[i] - oz, bz = b_z[i] - oz, cz = c_z[i] - oz;
        float ax = (a_x[i] - ox) - sx * az, ay = (a_y[i] - oy) - sy * az;
        float bx = (b_x[i] - ox) - sx * bz, by = (b_y[i] - oy) - sy * bz;
        float cx = (c_x[i] - ox) - sx * cz, cy = (c_y[i] - oy) - sy * cz;
        float ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
        float sum = fabsf(ax) + fabsf(ay) + fabsf(bx) + fabsf(by) + fabsf(cx) + fabsf(cy);
        float slack = factor * sum + FLT_MIN;
        float least = ea < eb ? ea : eb, most = ea > eb ? ea : eb;
        least = ec < least ? ec : least;
        most = ec > most ? ec : most;
        near[i] = (prim[i] != KD_NONE) & (prim[i] != from) & (prim[i] != to) & !((least < -slack) & (most > slack));
        any |= near[i];
    }
    return any != 0;
}

/* kd_block_hit: the first hit within (ray->tmin, tmax) among the near lanes, honouring alpha; false, with *hit
 * untouched, if none. */
bool kd_block_hit(const struct kd_block *b, const int near[KD_LANES], const struct geometry *geo,
                  const struct kd_block_ray *r, double tmax, bool shadow, struct hit *hit);

#endif
