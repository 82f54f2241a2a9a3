/* kd_node.h: how the kd-tree lies in memory; shared by its builder and its traversal, nobody else's business.
 */
#ifndef ASBDPT_KD_NODE_H
#define ASBDPT_KD_NODE_H

#include <stdbool.h>
#include <stdint.h>

/* Eight bytes. The two children of an inner node are neighbours, the lower side first. */
struct kd_node {
    uint32_t word; /* low 2 bits: axis, or 3 for a leaf; the rest: number of the lower child, or items in the leaf */
    union {
        float split;    /* inner: position of the plane */
        uint32_t first; /* leaf: its first item in kdtree.item */
    } at;
};

/* What a leaf refers to, in leaf order so that a leaf's triangles share cache lines with nothing in between. */
struct kd_item {
    float v[9];    /* corners of a triangle; zeros for a quadric */
    uint32_t prim; /* primitive number, with KD_ALPHA added if its group has an alpha texture */
};

#define KD_ALPHA 0x80000000u /* primitive numbers are below 2^31 */

/* The longest way from the root to a leaf, hence the size of the traversal's stack. */
enum { KD_MAX_DEPTH = 60 };

enum { KD_LEAF = 3 };

static inline bool kd_is_leaf(struct kd_node n) { return (n.word & 3) == KD_LEAF; }

#endif
