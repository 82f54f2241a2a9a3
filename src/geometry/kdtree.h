/* kdtree.h: which primitive does a ray meet first? A kd-tree over triangles, quadrics and curves [Wald & Havran 2006].
 *
 * Nodes hold float planes; traversal and intersection are computed in double from exact float vertices. A point found
 * on a surface is therefore within about 1e-15 of the scene's size of it.
 *
 * Tests: test_kdtree.c (against brute force, degenerate meshes), test/run/boxes.sh (pictures by a tree of boxes).
 */
#ifndef ASBDPT_KDTREE_H
#define ASBDPT_KDTREE_H

#include <stdbool.h>
#include <stdint.h>

#include "geometry/shape.h"

struct kd_node;  /* 8 bytes, see kd_block.h */
struct kd_block; /* up to four triangles, see kd_block.h */

struct kdtree {
    struct kd_node *node;   /* [n_nodes], root first, owned */
    struct kd_block *block; /* [n_blocks] what the leaves refer to, owned */
    struct kdtree *object;  /* [n_objects], owned: a tree for each object of the geometry */
    int n_nodes, n_blocks, n_objects;
    float lo[3], hi[3]; /* bounds of everything; lo > hi for an empty tree */
    double reach;       /* largest absolute coordinate of the bounds */
};

/* Which primitives: those with a material; of those without the lights, and what bounds media, which may be both. */
enum kd_of { KD_SURFACES, KD_LAMPS, KD_INTERFACES };

/* kd_build: build the tree of all primitives of one kind; kd_free releases it. Cannot fail (memory: see mem.h). The
 * result depends on the geometry alone. The geometry must not change afterwards. */
void kd_build(struct kdtree *kd, const struct geometry *geo, enum kd_of kind);
void kd_free(struct kdtree *kd);

/* Where surfaces lie in one place, it is the same one for all rays (shape_rank). Next to a light where a ray ends or
 * begins, nothing counts except a light that is there instead. So it is for walks: a light comes before what they meet
 * up to ray_margin (surface.h) before it. Two surfaces are in one place that are no farther apart than that, at their
 * normals, where rays meet them. Of all that are in one place with the nearest, the first by shape_rank is there.
 *
 * kd_closest: the first hit in (tmin, tmax), honouring alpha. Returns false if there is none. Thread-safe. tmin is
 * below 0 where the ray begins on a light, whose place extends to -tmin.
 * kd_all: how many hits are there? *hits: all, the nearest first, to be given to free(); NULL if there are none. Here
 * tmin may be below 0. */
bool kd_closest(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit *hit);
int kd_all(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit **hits);

/* kd_occluded: is anything hit in (tmin, tmax)? Thread-safe.
 *   light  where on the ray the place of the light begins that it ends on; INFINITY: it ends on none */
bool kd_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, double light);

#endif
