/* kdtree.c: rays through the kd-tree. See kdtree.h; the tree is built in kd_build.c.
 *
 * A ray goes front to back: of an inner node's two cells the one on its side is visited first, the other waits on a
 * stack. A ray that asks for the first hit does not visit cells behind it; a shadow ray takes any hit.
 *
 * No hit may be lost to rounding, so a plane is a slab: the ray enters it at t_lo and leaves it at t_hi, and both
 * cells extend over it. Its half width, 1e-14 of the scene's size, is a hundred times what the triangle test and
 * the clipping of triangles can be off, and far too small to cost anything.
 */
#include "geometry/kdtree.h"

#include <stdlib.h>

#include "geometry/kd_block.h"

void kd_free(struct kdtree *kd)
{
    free(kd->node);
    free(kd->block);
    struct kdtree empty = {0};
    *kd = empty;
}

/* A cell to visit and the stretch of the ray in it. */
struct kd_visit {
    uint32_t node;
    double tmin, tmax;
};

/* A ray on its way through a tree. */
struct traversal {
    double before[3], after[3]; /* origin moved by the slab's half width, so that t_lo = (split - before) inverse */
    double inverse[3];          /* 1/d, finite */
    uint32_t near_child[3];     /* 0: the ray goes up the axis, the lower cell comes first; 1: down */
    struct kd_block_ray ray;
    struct kd_visit cell;
    int waiting;
    struct kd_visit stack[KD_MAX_DEPTH];
};

/* A component this small moves the ray by nothing within any scene: it stands in for 0 to keep 1/d finite. */
static double inverse_of(double d)
{
    const double least = 1e-30;
    return 1 / (fabs(d) < least ? copysign(least, d) : d);
}

/* What fmax and fmin do, but for NaN, without a call. */
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* Prepare the traversal; false if the ray misses the bounds. */
static bool traversal_start(struct traversal *w, const struct kdtree *kd, const struct ray *ray)
{
    double o[3] = {ray->o.x, ray->o.y, ray->o.z}, d[3] = {ray->d.x, ray->d.y, ray->d.z};
    double size = larger(larger(kd->reach, fabs(o[0])), larger(fabs(o[1]), fabs(o[2])));
    double tmin = ray->tmin, tmax = ray->tmax;
    for (int k = 0; k < 3; k++) {
        double half = copysign(1e-14 * size, d[k]);
        bool up = half > 0;
        w->inverse[k] = inverse_of(d[k]);
        w->before[k] = o[k] + half;
        w->after[k] = o[k] - half;
        w->near_child[k] = !up;
        tmin = larger(tmin, ((up ? kd->lo[k] : kd->hi[k]) - w->before[k]) * w->inverse[k]);
        tmax = smaller(tmax, ((up ? kd->hi[k] : kd->lo[k]) - w->after[k]) * w->inverse[k]);
    }
    w->cell.node = 0;
    w->cell.tmin = tmin;
    w->cell.tmax = tmax;
    w->waiting = 0;
    if (kd->n_nodes == 0 || !(tmin <= tmax))
        return false;
    kd_block_ray(&w->ray, ray, size);
    return true;
}

/* Go down to the first leaf of the current cell that the ray comes to, leaving the cells behind it on the stack. */
static inline struct kd_node traversal_to_leaf(struct traversal *w, const struct kd_node *nodes)
{
    struct kd_node n = nodes[w->cell.node];
    double tmin = w->cell.tmin, tmax = w->cell.tmax;
    while (!kd_is_leaf(n)) {
        uint32_t axis = n.word & 3, children = kd_children(n);
        uint32_t near_cell = children + w->near_child[axis], far_cell = children + 1 - w->near_child[axis];
        double t_lo = (n.at.split - w->before[axis]) * w->inverse[axis];
        double t_hi = (n.at.split - w->after[axis]) * w->inverse[axis];
        if (t_lo > tmax) {
            n = nodes[near_cell];
        } else if (t_hi < tmin) {
            n = nodes[far_cell];
        } else {
            struct kd_visit *far = &w->stack[w->waiting++];
            far->node = far_cell;
            far->tmin = larger(t_lo, tmin);
            far->tmax = tmax;
            tmax = smaller(t_hi, tmax);
            n = nodes[near_cell];
        }
    }
    return n;
}

/* Take the next waiting cell that begins before t; false if there is none. */
static inline bool traversal_next(struct traversal *w, double t)
{
    while (w->waiting > 0) {
        w->cell = w->stack[--w->waiting];
        if (w->cell.tmin <= t) {
            w->cell.tmax = smaller(w->cell.tmax, t);
            return true;
        }
    }
    return false;
}

/* Both kinds of rays; `shadow` is a constant where this is inlined, so that neither pays for the other. */
static inline bool traverse(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, bool shadow,
                            struct hit *hit)
{
    struct traversal w;
    if (!traversal_start(&w, kd, ray))
        return false;
    double nearest = ray->tmax;
    int near[KD_LANES];
    bool found = false;
    do {
        struct kd_node leaf = traversal_to_leaf(&w, kd->node);
        const struct kd_block *block = kd->block + leaf.at.first, *end = block + kd_blocks(leaf);
        for (; block < end; block++)
            if (kd_block_near(block, &w.ray, near) &&
                kd_block_hit(block, near, geo, &w.ray, nearest, shadow, hit)) {
                if (shadow)
                    return true;
                nearest = hit->t;
                found = true;
            }
    } while (traversal_next(&w, nearest));
    return found;
}

bool kd_closest(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit *hit)
{
    return traverse(kd, geo, ray, false, hit);
}

bool kd_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray)
{
    struct hit hit;
    return traverse(kd, geo, ray, true, &hit);
}
