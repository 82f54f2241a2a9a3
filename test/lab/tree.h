/* tree.h: how good a kd-tree is.
 *
 * Tests: test_kdtree.c.
 */
#ifndef ASBDPT_LAB_TREE_H
#define ASBDPT_LAB_TREE_H

#include "geometry/kdtree.h"

struct tree_figures {
    size_t references; /* to primitives, in all leaves */
    int depth;         /* deepest leaf, the root being at 0 */
    double cost;       /* expected cost of a ray by the surface-area heuristic, in tests of a block of triangles */
};

struct tree_figures tree_figures(const struct kdtree *kd);

#endif
