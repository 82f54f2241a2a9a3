/* boxes.c: a tree of boxes in place of the kd-tree, as an oracle for whole pictures: build/boxes is the renderer with
 * these functions instead of those of geometry/kdtree.h, and must write the same bytes (test/run/boxes.sh).
 *
 * It shares only the intersection of a ray with one primitive. Each leaf is one primitive, of an object once for every
 * instance, in its box in the world; half of them by the order of their centres are in either half of the tree. A ray
 * visits all boxes that it meets, and what it has met is judged by kdtree.h's rules as they are written there. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "geometry/kdtree.h"

void box_build(struct kdtree *kd, const struct geometry *geo, enum kd_of kind);
bool box_closest(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit *hit);
int box_all(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit **hits);
bool box_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, double light);

/* A tree of n leaves has 2 n - 1 boxes: its own, those of its lower n / 2 leaves, those of the others. */
struct box {
    double lo[3], hi[3];
    int prim, instance; /* of a leaf */
};

/* --- the tree ----------------------------------------------------------------------------------------- */

static bool belongs(const struct shape_group *g, enum kd_of kind)
{
    return kind == KD_SURFACES ? g->material >= 0
           : g->material < 0 && (kind == KD_LAMPS ? g->first_light >= 0 : shape_is_interface(g));
}

static void include(struct box *b, const double p[3])
{
    for (int k = 0; k < 3; k++) {
        b->lo[k] = fmin(b->lo[k], p[k]);
        b->hi[k] = fmax(b->hi[k], p[k]);
    }
}

static const struct box NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, -1, 0};

/* The primitive's box in the world: around the corners of that in its object's space. */
static struct box leaf(const struct geometry *geo, int prim, int instance)
{
    struct box b = NOTHING;
    float lo[3], hi[3];
    shape_bounds(geo, prim, lo, hi);
    for (int i = 0; i < 8; i++) {
        vec3 p = vec((double)(i & 1 ? hi : lo)[0], (double)(i & 2 ? hi : lo)[1], (double)(i & 4 ? hi : lo)[2]);
        p = instance > 0 ? transform_point(&geo->instance[instance - 1].to_world, p) : p;
        include(&b, (const double[3]){p.x, p.y, p.z});
    }
    b.prim = prim;
    b.instance = instance;
    return b;
}

/* The leaves of an instance, or of the world, behind those that there are. */
static struct box *add_leaves(struct box *all, int *n, const struct geometry *geo, enum kd_of kind, int instance)
{
    const struct object *o = instance > 0 ? &geo->object[geo->instance[instance - 1].object] : NULL;
    for (int g = o != NULL ? o->first_group : 0; g < (o != NULL ? o->end_group : geo->n_groups); g++)
        for (int i = 0; i < geo->group[g].n_prims; i++)
            if (geo->group[g].shared == (o != NULL) && belongs(&geo->group[g], kind)) {
                all = mem_append(all, (size_t)*n, sizeof *all);
                all[(*n)++] = leaf(geo, geo->group[g].first_prim + i, instance);
            }
    return all;
}

static int compare(const struct box *a, const struct box *b, int axis)
{
    double x = a->lo[axis] + a->hi[axis], y = b->lo[axis] + b->hi[axis];
    return (x > y) - (x < y);
}
static int by_x(const void *a, const void *b) { return compare(a, b, 0); }
static int by_y(const void *a, const void *b) { return compare(a, b, 1); }
static int by_z(const void *a, const void *b) { return compare(a, b, 2); }

/* The tree of n leaves, halved across its longest side. */
static void make(struct box *leaves, int n, struct box *out)
{
    int (*const BY[])(const void *, const void *) = {by_x, by_y, by_z};
    int axis = 0;
    *out = n == 1 ? *leaves : NOTHING;
    if (n == 1)
        return;
    for (int i = 0; i < n; i++) {
        include(out, leaves[i].lo);
        include(out, leaves[i].hi);
    }
    for (int k = 1; k < 3; k++)
        axis = out->hi[k] - out->lo[k] > out->hi[axis] - out->lo[axis] ? k : axis;
    qsort(leaves, (size_t)n, sizeof *leaves, BY[axis]);
    make(leaves, n / 2, out + 1);
    make(leaves + n / 2, n - n / 2, out + 2 * (n / 2));
}

/* Bounds are the kd-tree's own; its nodes are boxes here, which kd_free releases. */
void box_build(struct kdtree *kd, const struct geometry *geo, enum kd_of kind)
{
    struct kdtree own;
    struct box *leaves = NULL, *tree = NULL;
    int n = 0;
    for (int i = 0; i <= (kind == KD_SURFACES ? geo->n_instances : 0); i++)
        leaves = add_leaves(leaves, &n, geo, kind, i);
    if (n > 0)
        make(leaves, n, tree = mem_alloc(2 * (size_t)n - 1, sizeof *tree));
    kd_build(&own, geo, kind);
    *kd = (struct kdtree){.node = (struct kd_node *)(void *)tree, .n_nodes = n > 0 ? 2 * n - 1 : 0,
                          .lo = {own.lo[0], own.lo[1], own.lo[2]}, .hi = {own.hi[0], own.hi[1], own.hi[2]},
                          .reach = own.reach};
    kd_free(&own);
    free(leaves);
}

/* --- what a ray meets --------------------------------------------------------------------------------- */

/* All hits of a ray, in no order. */
struct hits {
    struct hit *hit; /* [n], owned */
    int n;
};

/* Does the line come near the box between tmin and tmax? What rounding may do is far below the slack. */
static bool meets(const struct box *b, const struct ray *ray)
{
    const double o[3] = {ray->o.x, ray->o.y, ray->o.z}, d[3] = {ray->d.x, ray->d.y, ray->d.z};
    double from = ray->tmin, to = ray->tmax;
    for (int k = 0; k < 3; k++) {
        double slack = 1e-5 * (fabs(o[k]) + fabs(b->lo[k]) + fabs(b->hi[k]) + b->hi[k] - b->lo[k]) + 1e-30;
        double x = (b->lo[k] - slack - o[k]) / d[k], y = (b->hi[k] + slack - o[k]) / d[k];
        if (d[k] == 0 && (o[k] < b->lo[k] - slack || o[k] > b->hi[k] + slack))
            return false;
        if (d[k] != 0) {
            from = fmax(from, fmin(x, y));
            to = fmin(to, fmax(x, y));
        }
    }
    return from <= to + 1e-5 * fabs(to);
}

/* A primitive's hits, of a quadric two at most; with an alpha texture those where there is no hole, and none of rays
 * that begin or end on it. */
static void meet(const struct geometry *geo, const struct box *b, const struct ray *world, struct hits *all)
{
    struct ray ray = *world;
    struct hit h;
    bool alpha = shape_group_of(geo, b->prim)->alpha >= 0 && geo->opaque != NULL;
    if (b->instance > 0) {
        const struct transform *to_world = &geo->instance[b->instance - 1].to_world;
        ray.o = transform_point_back(to_world, world->o);
        ray.d = transform_vector_back(to_world, world->d);
        ray.from = shape_own_id(world->from, b->instance);
        ray.to = shape_own_id(world->to, b->instance);
    }
    for (; shape_intersect(geo, b->prim, &ray, &h); ray.tmin = h.t) {
        h.instance = b->instance;
        if (alpha && !geo->opaque(geo->opaque_context, geo, &h))
            continue;
        all->hit = mem_append(all->hit, (size_t)all->n, sizeof *all->hit);
        all->hit[all->n++] = h;
    }
}

static void visit(const struct geometry *geo, const struct box *b, int n, const struct ray *ray, struct hits *all)
{
    if (n == 0 || !meets(b, ray))
        return;
    if (n == 1) {
        meet(geo, b, ray, all);
        return;
    }
    visit(geo, b + 1, n / 2, ray, all);
    visit(geo, b + 2 * (n / 2), n - n / 2, ray, all);
}

static struct hits all_hits(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray)
{
    struct hits all = {NULL, 0};
    visit(geo, (const struct box *)(const void *)kd->node, (kd->n_nodes + 1) / 2, ray, &all);
    return all;
}

/* --- what is in one place ----------------------------------------------------------------------------- */

static double cosine(const struct geometry *geo, const struct ray *ray, const struct hit *h)
{
    struct surface at;
    shape_surface(geo, h, ray, &at);
    return fabs(dot(at.ng, ray->d));
}

/* No farther apart than the margin, at the normal of either. */
static bool beside(const struct geometry *geo, const struct ray *ray, const struct hit *a, const struct hit *b,
                   double margin)
{
    double apart = fabs(a->t - b->t);
    return apart <= margin ||
           (apart < GRAZING * margin && apart * fmax(cosine(geo, ray, a), cosine(geo, ray, b)) <= margin);
}

static struct hit end_at(uint64_t id, double t)
{
    return (struct hit){.t = t, .b1 = 1.0 / 3, .b2 = 1.0 / 3, .prim = shape_prim(id), .instance = (int)(id >> 32)};
}

/* Next to an end of the ray nothing counts, except, next to a light, a light that is there instead; nor does what is
 * beyond the end. */
static bool hidden(const struct geometry *geo, const struct ray *ray, const struct hit *h, uint64_t id, double t,
                   double margin, bool is_light, bool is_start)
{
    const struct hit own = end_at(id, t);
    if (!beside(geo, ray, h, &own, margin))
        return is_start ? h->t < 0 : h->t > t;
    return !is_light || shape_rank(geo, h, ray, is_start ? ray->d : neg(ray->d)) >= shape_light_rank(geo, own.prim);
}

static bool hidden_at_start(const struct geometry *geo, const struct ray *ray, const struct hit *h)
{
    double margin = start_margin(ray);
    return ray->from != 0 && h->t < GRAZING * margin &&
           hidden(geo, ray, h, ray->from, 0, margin, ray->tmin < 0, true);
}

/* --- the functions of kdtree.h ------------------------------------------------------------------------ */

bool box_closest(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit *hit)
{
    struct hits all = all_hits(kd, geo, ray);
    const struct hit *nearest = NULL, *first = NULL;
    vec3 w = neg(ray->d);
    for (const struct hit *h = all.hit; h < all.hit + all.n; h++)
        if ((nearest == NULL || h->t < nearest->t) && !hidden_at_start(geo, ray, h))
            nearest = h;
    first = nearest;
    for (const struct hit *h = all.hit; nearest != NULL && h < all.hit + all.n; h++) {
        double margin = ray_margin(add(ray->o, mul(ray->d, nearest->t))) + 1e-6 * ray_margin(ray->o);
        if (h->t < nearest->t + GRAZING * margin && !hidden_at_start(geo, ray, h) &&
            beside(geo, ray, h, nearest, margin) && shape_rank(geo, h, ray, w) < shape_rank(geo, first, ray, w))
            first = h;
    }
    if (first != NULL)
        *hit = *first;
    free(all.hit);
    return first != NULL;
}

bool box_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, double light)
{
    struct hits all = all_hits(kd, geo, ray);
    bool ends = ray->to != 0 && ray->to != WITHIN_MEDIUM && ray->tmax < INFINITY, met = false;
    double end = fmin(ray->tmax, light), margin = ray_margin(add(ray->o, mul(ray->d, end)));
    for (const struct hit *h = all.hit; h < all.hit + all.n && !met; h++)
        met = !hidden_at_start(geo, ray, h) &&
              !(ends && hidden(geo, ray, h, ray->to, end + margin, margin, light < INFINITY, false));
    free(all.hit);
    return met;
}

static int by_distance(const void *a, const void *b)
{
    const struct hit *x = a, *y = b;
    return x->t != y->t ? (x->t > y->t) - (x->t < y->t) : (x->prim > y->prim) - (x->prim < y->prim);
}

int box_all(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit **hits)
{
    struct hits all = all_hits(kd, geo, ray);
    if (all.n > 1)
        qsort(all.hit, (size_t)all.n, sizeof *all.hit, by_distance);
    *hits = all.hit;
    return all.n;
}
