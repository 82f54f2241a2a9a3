/* kd_node.h: how the kd-tree lies in memory; shared by its builder and its traversal, nobody else's business.
 */
#ifndef ASBDPT_KD_NODE_H
#define ASBDPT_KD_NODE_H

#include <stdbool.h>
#include <stdint.h>

/* Eight bytes. The two children of an inner node are neighbours, the lower side first: pair p is nodes 2p and 2p + 1.
 * The root is node 0, and node 1 is not used. */
struct kd_node {
    uint32_t word; /* low 2 bits: axis, or 3 for a leaf. Above them: blocks of a leaf; or 1 bit, whether shadow rays
                      visit the upper child first, and the number of the pair of children */
    union {
        float split;    /* inner: position of the plane */
        uint32_t first; /* leaf: its first block in kdtree.block */
    } at;
};

enum { KD_LEAF = 3, KD_UPPER_FIRST = 4 };

/* The longest way from the root to a leaf, hence the size of the traversal's stack. */
enum { KD_MAX_DEPTH = 60 };

static inline bool kd_is_leaf(struct kd_node n) { return (n.word & 3) == KD_LEAF; }
static inline uint32_t kd_blocks(struct kd_node leaf) { return leaf.word >> 2; }
static inline uint32_t kd_upper_first(struct kd_node n) { return n.word >> 2 & 1; }
static inline uint32_t kd_children(struct kd_node n) { return n.word >> 3 << 1; }

#endif
