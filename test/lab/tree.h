/* tree.h: how good a kd-tree is: the cost that it expects, and rays by which its traversal is timed.
 *
 * Tests: test_kdtree.c.
 */
#ifndef ASBDPT_LAB_TREE_H
#define ASBDPT_LAB_TREE_H

#include "scene/scene.h"

struct tree_figures {
    size_t references; /* to primitives, in all leaves */
    int depth;         /* deepest leaf, the root being at 0 */
    double cost;       /* expected cost of a ray by the surface-area heuristic, in tests of a block of triangles */
};

struct tree_figures tree_figures(const struct kdtree *kd);

enum { N_RAYS = 1 << 17 };

/* bench_rays: fill out[N_RAYS] with incoherent rays: cosine-distributed directions from points all over the scene, found
 * by following a camera ray two bounces; the same for every film of the same framing. Returns how many there are: fewer
 * if the camera sees hardly anything. */
int bench_rays(const struct scene *s, struct ray *out);

#endif
