/* kd_plane.h: where is a cell of the kd-tree best cut, and what of a triangle lies on each side of the cut?
 *
 * Tests: test_kdtree.c.
 */
#ifndef ASBDPT_KD_PLANE_H
#define ASBDPT_KD_PLANE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "geometry/shape.h"

struct box {
    float lo[3], hi[3];
};

/* An item, which is a primitive, and the bounds of its part within a cell. */
struct kd_ref {
    struct box box;
    uint32_t item;
};

/* How many triangles cost as much to test: a curve has many, an instance is a tree of its own; found by measurement. */
static inline int kd_weight(const struct kd_ref *r)
{
    return r->item < FIRST_CURVE ? 1 : r->item < FIRST_INSTANCE ? 4 : 32;
}

struct kd_plane {
    int axis; /* -1: none */
    float at;
    bool planar_below; /* items lying in the plane go to the lower cell */
    double cost;       /* of the cell cut by it, times the cell's half area */
};

/* Has an item a part below, above the plane? Every item has one of them. */
static inline bool kd_is_below(const struct kd_ref *r, const struct kd_plane *p)
{
    float lo = r->box.lo[p->axis], hi = r->box.hi[p->axis];
    return (lo < p->at) | ((hi <= p->at) & p->planar_below);
}
static inline bool kd_is_above(const struct kd_ref *r, const struct kd_plane *p)
{
    float lo = r->box.lo[p->axis], hi = r->box.hi[p->axis];
    return (hi > p->at) | ((lo >= p->at) & !p->planar_below);
}

/* Half of the surface of a box. */
double kd_half_area(const struct box *b);

/* The cost of a visit of an inner node in tests of a block of triangles, with its share of cache misses and wrong
 * guesses of the processor; found by measurement. */
#define KD_VISIT_COST 2

/* kd_leaf_cost: the same for a leaf with items of weight n. */
double kd_leaf_cost(size_t n);

/* kd_best_plane: the cheapest cut of a cell with n items, axis -1 if none is cheaper than a leaf, or little dearer than
 * one of many items. */
struct kd_plane kd_best_plane(const struct kd_ref *ref, size_t n, const struct box *cell);

/* kd_split_triangle: bounds of the two parts into which the plane at `split` of `axis` cuts the triangle v (three
 * corners) within the closed box `cell`: part[0] below, part[1] above. The true bounds are rounded outwards to
 * float, but not beyond the half of the box. filled[i] tells whether there is anything of the triangle in it. */
void kd_split_triangle(const float v[9], const struct box *cell, int axis, float split, struct box part[2],
                       bool filled[2]);

#endif
