/* kd_block.h: the kd-tree in memory, shared by its builder and its traversal and nobody else's business: its nodes, and
 * the blocks that its leaves refer to, which keep triangles lane by lane.
 *
 * Tests: test_kdtree.c.
 */
#ifndef ASBDPT_KD_BLOCK_H
#define ASBDPT_KD_BLOCK_H

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

/* Up to four triangles, or up to four quadrics and curves. */
struct kd_block {
    float v[3][3][KD_LANES]; /* corner, axis, lane; zeros for others, NaN for an unused lane */
    float reach[KD_LANES];   /* 8 times the longest of the triangle's edges, by its largest coordinate, or KD_TINY */
    uint32_t prim[KD_LANES]; /* primitive number, with KD_ALPHA added if its group has an alpha texture */
};

#define KD_TINY 2e-19f /* a number whose square is more than two of the least normal ones */

#define KD_ALPHA 0x80000000u /* primitive numbers are below 2^31 */
#define KD_NONE  0xffffffffu /* an unused lane; they are the last ones */

#endif
