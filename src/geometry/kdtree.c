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

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "geometry/kd_block.h"
#include "geometry/triangle.h"

void kd_free(struct kdtree *kd)
{
    free(kd->node);
    free(kd->block);
    memset(kd, 0, sizeof *kd);
}

/* --- a ray and a block ------------------------------------------------------------------------------- */

/* One loop tests up to four triangles, and a compiler can do its arithmetic on all lanes at once. The loop computes in
 * float and only sorts out: a triangle stays in unless the ray certainly misses it. triangle_hit then tests those that
 * stay in double, and alone decides. Let s be the largest coordinate of scene and origin and u = 2^-24. A sheared
 * coordinate in float is off by at most 14 u s, and an edge function by at most 64 u s times the sum S of the six
 * coordinates' absolute values (were S itself below 16 u s, the edge function would be smaller than that). If the ray
 * hits the triangle, the origin of the sheared plane is within it, so that no coordinate exceeds the longest difference
 * of two corners, and S is at most kd_block.reach. So 64 u s times that is the slack that an edge function is given;
 * FLT_MIN covers what underflows. */

/* A ray and what the test needs of it. */
struct block_ray {
    struct triangle_ray exact;
    float ox, oy, oz, sx, sy; /* of exact, in float */
    float slack;              /* 64 u s */
    uint32_t from, to;        /* primitive numbers of the triangles it begins and ends on, KD_NONE: on none */
};

/* The number of a primitive that is a triangle, KD_NONE of another: quadrics see to themselves. */
static uint32_t own_triangle(uint32_t id) { return id - 1 < FIRST_QUADRIC ? id - 1 : KD_NONE; }

/* For the scene whose largest absolute coordinate, or the ray's origin's, is `size`. */
static void prepare_ray(struct block_ray *r, const struct ray *ray, double size)
{
    r->exact = triangle_ray(ray);
    r->ox = (float)r->exact.ox;
    r->oy = (float)r->exact.oy;
    r->oz = (float)r->exact.oz;
    r->sx = (float)r->exact.sx;
    r->sy = (float)r->exact.sy;
    r->slack = (float)(64 * 0x1p-24 * size);
    r->from = own_triangle(ray->from);
    r->to = own_triangle(ray->to);
}

/* Which lanes may the ray hit? Sets near[i] to 1 or 0 and returns whether any is 1. A quadric's zeros always may, the
 * NaNs of an unused lane never. The names are those of triangle_hit. */
static inline bool block_near(const struct kd_block *b, const struct block_ray *r, uint32_t near[KD_LANES])
{
    const float *a_x = b->v[0][r->exact.kx], *a_y = b->v[0][r->exact.ky], *a_z = b->v[0][r->exact.kz];
    const float *b_x = b->v[1][r->exact.kx], *b_y = b->v[1][r->exact.ky], *b_z = b->v[1][r->exact.kz];
    const float *c_x = b->v[2][r->exact.kx], *c_y = b->v[2][r->exact.ky], *c_z = b->v[2][r->exact.kz];
    const float ox = r->ox, oy = r->oy, oz = r->oz, sx = r->sx, sy = r->sy, factor = r->slack, *reach = b->reach;
    const uint32_t *prim = b->prim, from = r->from, to = r->to;
#pragma GCC unroll 1 /* else gcc writes the lanes one after the other, and does not put them side by side again */
    for (int i = 0; i < KD_LANES; i++) {
        float az = a_z[i] - oz, bz = b_z[i] - oz, cz = c_z[i] - oz;
        float ax = (a_x[i] - ox) - sx * az, ay = (a_y[i] - oy) - sy * az;
        float bx = (b_x[i] - ox) - sx * bz, by = (b_y[i] - oy) - sy * bz;
        float cx = (c_x[i] - ox) - sx * cz, cy = (c_y[i] - oy) - sy * cz;
        float ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
        float least = ea < eb ? ea : eb, most = ea > eb ? ea : eb;
        least = ec < least ? ec : least;
        most = ec > most ? ec : most;
        float outside = -least < most ? -least : most;
        near[i] = (outside <= factor * reach[i] + FLT_MIN) & (prim[i] != from) & (prim[i] != to);
    }
    uint64_t pair[KD_LANES / 2]; /* two lanes at a time */
    memcpy(pair, near, sizeof pair);
    return (pair[0] | pair[1]) != 0;
}

static bool lane_hit(const struct kd_block *b, int lane, const struct geometry *geo, const struct block_ray *r,
                     double tmax, struct hit *hit)
{
    float v[9];
    struct hit h;
    for (int i = 0; i < 9; i++)
        v[i] = b->v[i / 3][i % 3][lane];
    if (!triangle_hit(&r->exact, v, tmax, &h))
        return false;
    h.prim = (int)(b->prim[lane] & ~KD_ALPHA);
    if ((b->prim[lane] & KD_ALPHA) && !geo->opaque(geo->opaque_context, geo, &h))
        return false;
    *hit = h;
    return true;
}

static bool quadrics_hit(const struct kd_block *b, const struct geometry *geo, const struct ray *ray, double tmax,
                         struct hit *hit)
{
    struct hit h;
    bool found = false;
    for (int i = 0; i < KD_LANES && b->prim[i] != KD_NONE; i++)
        if (shape_intersect(geo, (int)b->prim[i], ray, &h) && h.t < tmax) {
            *hit = h;
            tmax = h.t;
            found = true;
        }
    return found;
}

/* The first hit within (ray->tmin, tmax) among the near lanes, honouring alpha; false, with *hit untouched, if none. */
static bool block_hit(const struct kd_block *b, const uint32_t near[KD_LANES], const struct geometry *geo,
                      const struct block_ray *r, double tmax, struct hit *hit)
{
    bool found = false;
    if ((b->prim[0] & ~KD_ALPHA) >= FIRST_QUADRIC)
        return quadrics_hit(b, geo, r->exact.ray, tmax, hit);
    for (int i = 0; i < KD_LANES; i++)
        if (near[i] && lane_hit(b, i, geo, r, tmax, hit)) {
            tmax = hit->t;
            found = true;
        }
    return found;
}

/* --- the way through the tree ------------------------------------------------------------------------ */

/* A cell to visit and the stretch of the ray in it. */
struct kd_visit {
    uint32_t node;
    double tmin, tmax;
};

/* A ray on its way through a tree. */
struct traversal {
    double o[3], inverse[3]; /* origin; 1/d, finite */
    double slack[3];         /* the half of a slab's width, in t */
    uint32_t near_child[3];  /* 0: the ray goes up the axis, the lower cell comes first; 1: down */
    struct block_ray ray;
    struct kd_visit cell;
    int waiting;
    struct kd_visit stack[KD_MAX_DEPTH];
};

/* A component this small moves the ray by nothing within any scene. It replaces 0 to keep 1/d finite. */
static double inverse_of(double d)
{
    const double least = 1e-30;
    return 1 / (d + copysign(least, d));
}

/* What fmax and fmin do, except for NaN, without a call. */
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* Prepare the traversal; false if the ray misses the bounds. */
static bool traversal_start(struct traversal *w, const struct kdtree *kd, const struct ray *ray)
{
    const double o[3] = {ray->o.x, ray->o.y, ray->o.z}, d[3] = {ray->d.x, ray->d.y, ray->d.z};
    double size = larger(larger(kd->reach, fabs(o[0])), larger(fabs(o[1]), fabs(o[2])));
    double tmin = ray->tmin, tmax = ray->tmax;
    for (int k = 0; k < 3; k++) {
        double inverse = inverse_of(d[k]), slack = 1e-14 * size * fabs(inverse);
        w->o[k] = o[k];
        w->inverse[k] = inverse;
        w->slack[k] = slack;
        w->near_child[k] = inverse < 0;
        if (ray->tmax < INFINITY) /* most of these lie within the bounds */
            continue;
        double lo = (kd->lo[k] - o[k]) * inverse, hi = (kd->hi[k] - o[k]) * inverse;
        tmin = larger(tmin, smaller(lo, hi) - slack);
        tmax = smaller(tmax, larger(lo, hi) + slack);
    }
    w->cell.node = 0;
    w->cell.tmin = tmin;
    w->cell.tmax = tmax;
    w->waiting = 0;
    if (kd->n_nodes == 0 || !(tmin <= tmax))
        return false;
    prepare_ray(&w->ray, ray, size);
    return true;
}

/* Go down to the first leaf of the current cell that the ray comes to, leaving the cells behind it on the stack.
 *   range  out: the stretch of the ray in the leaf */
static inline struct kd_node traversal_to_leaf(struct traversal *w, const struct kd_node *nodes, double range[2])
{
    struct kd_node n = nodes[w->cell.node];
    double tmin = w->cell.tmin, tmax = w->cell.tmax;
    while (!kd_is_leaf(n)) {
        uint32_t axis = n.word & 3, children = kd_children(n);
        uint32_t near_cell = children + w->near_child[axis], far_cell = children + 1 - w->near_child[axis];
        double t = (n.at.split - w->o[axis]) * w->inverse[axis];
        double t_lo = t - w->slack[axis], t_hi = t + w->slack[axis];
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
    range[0] = tmin;
    range[1] = tmax;
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

/* Both kinds of rays; `shadow` is a constant where this is inlined, so that each has only its own code. */
static inline bool traverse(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, bool shadow,
                            struct hit *hit)
{
    struct traversal w;
    if (!traversal_start(&w, kd, ray))
        return false;
    double nearest = ray->tmax, range[2];
    uint32_t near[KD_LANES];
    bool found = false;
    do {
        struct kd_node leaf = traversal_to_leaf(&w, kd->node, range);
        const struct kd_block *block = kd->block + leaf.at.first, *end = block + kd_blocks(leaf);
        for (; block < end; block++)
            if (block_near(block, &w.ray, near) &&
                block_hit(block, near, geo, &w.ray, nearest, hit)) {
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

/* The hits of a ray so far. */
struct hits {
    struct hit *hit; /* [n] */
    size_t n;
    double first, last; /* only those from here to there are wanted */
};

/* A ray meets a triangle once, a quadric twice at most. (block_near is for the loop of `traverse`, into which compilers
 * put it if nobody else calls it.) */
static void add_hits(const struct kd_block *b, const struct geometry *geo, const struct ray *ray, struct hits *all)
{
    struct hit hit;
    for (int i = 0; i < KD_LANES && b->prim[i] != KD_NONE; i++) {
        int prim = (int)(b->prim[i] & ~KD_ALPHA);
        for (struct ray rest = *ray; shape_intersect(geo, prim, &rest, &hit); rest.tmin = hit.t) {
            bool there = !(b->prim[i] & KD_ALPHA) || geo->opaque(geo->opaque_context, geo, &hit);
            if (there && hit.t >= all->first && hit.t <= all->last) {
                all->hit = mem_append(all->hit, all->n, sizeof *all->hit);
                all->hit[all->n++] = hit;
            }
        }
    }
}

static int by_distance(const void *a, const void *b)
{
    const struct hit *x = a, *y = b;
    return x->t != y->t ? (x->t > y->t) - (x->t < y->t) : (x->prim > y->prim) - (x->prim < y->prim);
}

int kd_all(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit **hits)
{
    struct traversal w;
    struct hits all = {.hit = NULL};
    double range[2];
    int n = 0;
    for (bool more = traversal_start(&w, kd, ray); more; more = traversal_next(&w, ray->tmax)) {
        struct kd_node leaf = traversal_to_leaf(&w, kd->node, range);
        const struct kd_block *block = kd->block + leaf.at.first, *end = block + kd_blocks(leaf);
        double slack = 1e-9 * (range[1] + kd->reach); /* what is found in two leaves is dropped below */
        all.first = range[0] - slack;
        all.last = range[1] + slack;
        for (; block < end; block++)
            add_hits(block, geo, ray, &all);
    }
    if (all.n > 1)
        qsort(all.hit, all.n, sizeof *all.hit, by_distance);
    for (size_t i = 0; i < all.n; i++)
        if (n == 0 || by_distance(&all.hit[i], &all.hit[n - 1]) != 0)
            all.hit[n++] = all.hit[i];
    *hits = all.hit;
    return n;
}

bool kd_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray)
{
    struct hit hit;
    return traverse(kd, geo, ray, true, &hit);
}
