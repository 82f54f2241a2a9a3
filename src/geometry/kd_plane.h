/* kd_plane.h: where is a cell of the kd-tree best cut? The surface-area heuristic.
 *
 * Used by: kd_build.
 */
#ifndef ASBDPT_KD_PLANE_H
#define ASBDPT_KD_PLANE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "geometry/kd_clip.h"

/* An item and the bounds of its part within a cell. */
struct kd_ref {
    struct box box;
    uint32_t item;
};

struct kd_plane {
    int axis; /* -1: none */
    float at;
    bool flat_below; /* items lying in the plane go to the lower cell */
    double cost;     /* times the cell's half area */
};

/* Has an item a part below, above the plane? Every item has one of them. */
static inline bool kd_is_below(const struct kd_ref *r, const struct kd_plane *p)
{
    float lo = r->box.lo[p->axis], hi = r->box.hi[p->axis];
    return (lo < p->at) | ((hi <= p->at) & p->flat_below);
}
static inline bool kd_is_above(const struct kd_ref *r, const struct kd_plane *p)
{
    float lo = r->box.lo[p->axis], hi = r->box.hi[p->axis];
    return (hi > p->at) | ((lo >= p->at) & !p->flat_below);
}

/* Half of the surface of a box. */
double kd_half_area(const struct box *b);

/* The cost of a leaf with n items, and of a visit of an inner node, in tests of a block of triangles. */
double kd_leaf_cost(size_t n);
double kd_visit_cost(void);

/* kd_best_plane: the cheapest cut of a cell with n items, axis -1 if none is cheaper than a leaf. */
struct kd_plane kd_best_plane(const struct kd_ref *ref, size_t n, const struct box *cell);

#endif
