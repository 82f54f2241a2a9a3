/* kdtree.c: rays through the kd-tree. See kdtree.h; the tree is built in kd_build.c.
 *
 * A ray goes front to back: of an inner node's two cells the one on its side is visited first, the other waits on a
 * stack. A ray that asks for the first hit does not visit cells behind it. A shadow ray takes any hit, and goes back to
 * front: walls are far from where most rays begin, and what shades a light is near it.
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
    for (int i = 0; i < kd->n_objects; i++)
        kd_free(&kd->object[i]);
    free(kd->object);
    memset(kd, 0, sizeof *kd);
}

/* --- a ray and a block ------------------------------------------------------------------------------- */

/* One loop tests up to four triangles, and a compiler can do its arithmetic on all lanes at once. The loop computes in
 * float and only sorts out: a triangle stays in unless the ray certainly misses it. triangle_hit then tests those that
 * stay in double, and alone decides. Let s be the largest coordinate of scene and origin and u = 2^-24. A sheared
 * coordinate in float is at most 4 s, and off by at most 14 u s. Let S be the sum of the absolute values of the four
 * coordinates in an edge function: this is off by 14 u s S and 2 (14 u s)^2 because of the coordinates, and by
 * 4 u s (S + 4 * 14 u s) because of its own rounding. That is below 24 u s (S + 28 u s), and what is left of the 24
 * covers what underflows: neither factor of the slack is below KD_TINY. If the ray hits the triangle, the origin of the
 * sheared plane is within it. Then two coordinates on one axis are together at most twice the triangle's extent there,
 * which is at most twice the longest difference of two corners, so that S is at most kd_block.reach. */

/* What fmax and fmin do, except for NaN, without a call. */
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* What the loop needs of a ray. The names are those of struct triangle_ray. */
struct block_ray {
    float ox, oy, oz, sx, sy;
    int kx, ky, kz;
    float slack, least; /* 24 u s; that times 28 u s */
    uint32_t from, to;  /* primitive numbers of the triangles it begins and ends on, KD_NONE: on none */
};

/* The number of a primitive that is a triangle, KD_NONE of another: quadrics see to themselves. */
static uint32_t own_triangle(uint64_t id) { return id <= FIRST_QUADRIC ? (uint32_t)id - 1 : KD_NONE; }

/* For the scene whose largest absolute coordinate, or the ray's origin's, is `size`. */
static struct block_ray block_ray(const struct triangle_ray *r, double size)
{
    double slack = 24 * 0x1p-24 * size;
    return (struct block_ray){
        (float)r->ox, (float)r->oy, (float)r->oz, (float)r->sx, (float)r->sy, r->kx, r->ky, r->kz,
        (float)larger(slack, KD_TINY), (float)(slack * 28 * 0x1p-24 * size),
        own_triangle(r->ray->from), own_triangle(r->ray->to)};
}

/* Lanes by twos, the first of which is the low half. */
struct lanes {
    uint64_t pair[KD_LANES / 2];
};

/* Which lanes may the ray hit? 0 for those that it misses. A quadric's zeros always may, the NaNs of an unused lane
 * never. The names are those of triangle_hit. */
static inline struct lanes block_near(const struct kd_block *b, const struct block_ray *r)
{
    uint32_t near[KD_LANES];
    struct lanes out;
    const uint32_t *prim = b->prim, from = r->from, to = r->to;
    const float *a_x = b->v[0][r->kx], *a_y = b->v[0][r->ky], *a_z = b->v[0][r->kz];
    const float *b_x = b->v[1][r->kx], *b_y = b->v[1][r->ky], *b_z = b->v[1][r->kz];
    const float *c_x = b->v[2][r->kx], *c_y = b->v[2][r->ky], *c_z = b->v[2][r->kz];
    const float ox = r->ox, oy = r->oy, oz = r->oz, sx = r->sx, sy = r->sy, *reach = b->reach;
    const float slack = r->slack, least_slack = r->least;
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
        near[i] = outside <= slack * reach[i] + least_slack ? prim[i] ^ from : 0;
        near[i] = prim[i] != to ? near[i] : 0;
    }
    memcpy(&out, near, sizeof out);
    return out;
}

/* --- what a ray meets -------------------------------------------------------------------------------- */

/* A ray in a tree, and what it has met. */
struct search {
    const struct kdtree *kd;
    const struct geometry *geo;
    struct triangle_ray ray;
    const struct ray *world; /* the same outside of objects */
    double start;    /* up to there surfaces may be in one place with that where it begins */
    int instance;    /* of the object whose tree it is; 0: of none */
    double limit;    /* what lies behind it does not matter */
    /* of a shadow ray: */
    bool ends;       /* on a primitive */
    double light;    /* from there on only lights count that are in the place of the one where the ray ends */
    /* else: */
    double margin;   /* what is in one place is no farther apart along the ray */
    bool found;
    struct hit *hit; /* the first so far */
    bool *close;     /* were others near the first? A second search compares them with that, */
    const struct hit *nearest; /* which the first search has found; NULL in that */
};

static double cosine_at(const struct search *q, const struct hit *h)
{
    struct surface at;
    shape_surface(q->geo, h, q->world, &at);
    return fabs(dot(at.ng, q->world->d));
}

/* Are two surfaces in one place that the ray meets so far from each other? */
static bool is_beside(const struct search *q, const struct hit *a, const struct hit *b, double margin)
{
    double apart = fabs(a->t - b->t);
    return apart <= margin || (apart < GRAZING * margin && apart * fmax(cosine_at(q, a), cosine_at(q, b)) <= margin);
}

/* Is a surface in one place with the nearest, and there rather than what has been found? */
static bool comes_first(const struct search *q, const struct hit *h)
{
    const vec3 o = q->world->o, d = q->world->d;
    double margin = ray_margin(add(o, mul(d, q->nearest->t))) + 1e-6 * ray_margin(o);
    return is_beside(q, h, q->nearest, margin) &&
           (!q->found || shape_rank(q->geo, h, q->world, neg(d)) < shape_rank(q->geo, q->hit, q->world, neg(d)));
}

/* The end of the ray, at distance t, on this primitive. */
static struct hit end_hit(uint64_t id, double t)
{
    return (struct hit){.t = t, .b1 = 1.0 / 3, .b2 = 1.0 / 3, .prim = shape_prim(id), .instance = (int)(id >> 32)};
}

/* The ray ends where it meets `own`. If that is a light that shines in direction w, is it there in spite of this
 * surface, which is in one place with it? */
static bool is_taken(const struct search *q, const struct hit *h, bool light, const struct hit *own, vec3 w)
{
    return !light || shape_rank(q->geo, h, q->world, w) >= shape_light_rank(q->geo, own->prim);
}

/* Does a surface near the ray's origin not count, or near a shadow ray's end? Both are on primitives. */
static bool is_at_start(const struct search *q, const struct hit *h)
{
    const struct ray *ray = q->world;
    const struct hit own = end_hit(ray->from, 0);
    return is_beside(q, h, &own, start_margin(ray)) ? is_taken(q, h, ray->tmin < 0, &own, ray->d) : h->t < 0;
}

static bool is_at_end(const struct search *q, const struct hit *h)
{
    const struct ray *ray = q->world;
    double end = smaller(ray->tmax, q->light), margin = ray_margin(add(ray->o, mul(ray->d, end)));
    const struct hit own = end_hit(ray->to, end + margin);
    return is_beside(q, h, &own, margin) ? is_taken(q, h, q->light < INFINITY, &own, neg(ray->d)) : h->t > own.t;
}

/* Does what has been found come before this? Take note if both are near each other. */
static bool is_near(struct search *q, const struct hit *h)
{
    bool same = h->prim == q->hit->prim && h->instance == q->hit->instance;
    *q->close |= !same && fabs(h->t - q->hit->t) < q->margin;
    return !(h->t < q->hit->t);
}

/* Take note of a hit. Is the search at its end? */
static inline bool note(struct search *q, bool shadow, const struct hit *h)
{
    if ((h->t < q->start && is_at_start(q, h)) || (shadow && q->ends && is_at_end(q, h)))
        return false;
    if (shadow)
        return true;
    if (q->nearest != NULL ? !comes_first(q, h) : q->found && is_near(q, h))
        return false;
    q->found = true;
    *q->hit = *h;
    q->limit = smaller(q->limit, h->t + q->margin);
    return false;
}

/* Is there no hole? That a ray does not meet where it begins or ends, block_near did not know. */
static bool alpha_met(const struct search *q, const struct hit *h)
{
    uint64_t id = shape_prim_id(h->prim, 0);
    return id != q->ray.ray->from && id != q->ray.ray->to && q->geo->opaque(q->geo->opaque_context, q->geo, h);
}

static bool triangle_met(const struct search *q, const struct kd_block *b, int lane, struct hit *h)
{
    float v[9];
    for (int i = 0; i < 9; i++)
        v[i] = b->v[i / 3][i % 3][lane];
    if (!triangle_hit(&q->ray, v, q->limit, h))
        return false;
    h->prim = (int)(b->prim[lane] & ~KD_ALPHA);
    h->instance = q->instance;
    return !(b->prim[lane] & KD_ALPHA) || alpha_met(q, h);
}

static bool quadric_met(const struct search *q, int prim, struct hit *h)
{
    if (!shape_intersect(q->geo, prim, q->ray.ray, h) || !(h->t < q->limit))
        return false;
    h->instance = q->instance;
    return true;
}

static bool instance_met(const struct search *q, int prim, const double range[2], bool shadow, struct hit *h);

/* Quadrics or instances. */
static bool note_others(struct search *q, const struct kd_block *b, const double range[2], bool shadow)
{
    struct hit h;
    for (int i = 0; i < KD_LANES && b->prim[i] != KD_NONE; i++) {
        int prim = (int)b->prim[i];
        bool instance = prim >= FIRST_INSTANCE;
        bool met = instance ? instance_met(q, prim, range, shadow, &h) : quadric_met(q, prim, &h);
        if (met && ((shadow && instance) || note(q, shadow, &h))) /* else the search there has taken note */
            return true;
    }
    return false;
}

/* Take note of what the ray hits in a block, of whose triangles the near ones may be hit, in a stretch of the ray. Is
 * the search at its end? */
static inline bool note_block(struct search *q, const struct kd_block *b, struct lanes lanes, const double range[2],
                              bool shadow)
{
    struct hit h;
    uint32_t near[KD_LANES];
    memcpy(near, &lanes, sizeof near);
    if ((b->prim[0] & ~KD_ALPHA) >= FIRST_QUADRIC)
        return note_others(q, b, range, shadow);
    for (int i = 0; i < KD_LANES; i++)
        if (near[i] && triangle_met(q, b, i, &h) && note(q, shadow, &h))
            return true;
    return false;
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
    double size;             /* largest coordinate of the scene or the origin */
    double slack[3];         /* the half of a slab's width, in t */
    uint32_t near_child[3];  /* 0: the ray goes up the axis, the lower cell comes first; 1: down */
    struct kd_visit cell;
    int waiting;
    struct kd_visit stack[KD_MAX_DEPTH + 1];
};

/* A component this small moves the ray by nothing within any scene. It replaces 0 to keep 1/d finite. */
static double inverse_of(double d)
{
    const double least = 1e-30;
    return 1 / (d + copysign(least, d));
}

/* Prepare the traversal of a stretch of o + t d; false if it misses the bounds. */
static inline bool traversal_start(struct traversal *w, const struct kdtree *kd, vec3 o, vec3 to, bool bounded,
                                   double tmin, double tmax)
{
    const double d[3] = {to.x, to.y, to.z};
    w->o[0] = o.x;
    w->o[1] = o.y;
    w->o[2] = o.z;
    w->size = larger(larger(kd->reach, fabs(w->o[0])), larger(fabs(w->o[1]), fabs(w->o[2])));
    for (int k = 0; k < 3; k++) {
        double inverse = inverse_of(d[k]), slack = 1e-14 * w->size * fabs(inverse);
        w->inverse[k] = inverse;
        w->slack[k] = slack;
        w->near_child[k] = signbit(inverse) != 0;
        if (bounded)
            continue;
        double lo = (kd->lo[k] - w->o[k]) * inverse, hi = (kd->hi[k] - w->o[k]) * inverse;
        tmin = larger(tmin, smaller(lo, hi) - slack);
        tmax = smaller(tmax, larger(lo, hi) + slack);
    }
    w->cell = (struct kd_visit){0, tmin, tmax};
    w->waiting = 0;
    return kd->n_nodes > 0 && tmin <= tmax;
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
        if (t_hi < tmin) {
            n = nodes[far_cell];
            continue;
        }
        struct kd_visit *far = &w->stack[w->waiting]; /* the next one's place, where this one does not wait */
        far->node = far_cell;
        far->tmin = larger(t_lo, tmin);
        far->tmax = tmax;
        w->waiting += t_lo <= tmax; /* no branch: a processor guesses it wrong too often */
        tmax = smaller(t_hi, tmax);
        n = nodes[near_cell];
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

/* Does the ray meet anything from tmin to tmax? Both kinds of rays; `shadow` is a constant where this is inlined, so
 * that each has only its own code. */
static inline bool traverse(struct search *q, const struct ray *ray, double tmin, double tmax, bool shadow)
{
    struct traversal w;
    double range[2];
    q->found = false;
    bool bounded = ray->tmax < INFINITY && q->instance == 0;
    if (!(shadow ? traversal_start(&w, q->kd, ray->o, neg(ray->d), bounded, -tmax, -tmin)
                 : traversal_start(&w, q->kd, ray->o, ray->d, bounded, tmin, tmax)))
        return false;
    q->ray = triangle_ray(ray);
    const struct block_ray r = block_ray(&q->ray, w.size);
    do {
        struct kd_node leaf = traversal_to_leaf(&w, q->kd->node, range);
        const struct kd_block *block = q->kd->block + leaf.at.first, *end = block + kd_blocks(leaf);
        for (; block < end; block++) {
            struct lanes near = block_near(block, &r);
            if ((near.pair[0] | near.pair[1]) != 0 && note_block(q, block, near, range, shadow))
                return true;
        }
    } while (traversal_next(&w, shadow ? INFINITY : q->limit));
    return q->found;
}

static bool meets_first(struct search *q, const struct ray *ray, double tmin, double tmax)
{
    return traverse(q, ray, tmin, tmax, false);
}

static bool meets_any(struct search *q, const struct ray *ray, double tmin, double tmax)
{
    return traverse(q, ray, tmin, tmax, true);
}

/* In the object's space the ray is another one, but t is the same. What it meets in other cells of the world is found
 * there. */
static bool instance_met(const struct search *q, int prim, const double range[2], bool shadow, struct hit *h)
{
    const struct instance *place = &q->geo->instance[prim - FIRST_INSTANCE];
    const struct ray *ray = q->ray.ray;
    const int number = prim - FIRST_INSTANCE + 1;
    double slack = 1e-9 * (larger(fabs(range[0]), fabs(range[1])) + q->kd->reach);
    double first = shadow ? -range[1] : range[0], last = shadow ? -range[0] : range[1];
    double tmin = larger(ray->tmin, first - slack), tmax = smaller(q->limit, last + slack);
    struct search in = *q;
    struct ray r = *ray;
    in.kd = &q->kd->object[place->object];
    in.instance = number;
    in.hit = h;
    r.o = transform_point_back(&place->to_world, ray->o);
    r.d = transform_vector_back(&place->to_world, ray->d);
    r.from = shape_own_id(ray->from, number);
    r.to = shape_own_id(ray->to, number);
    return shadow ? meets_any(&in, &r, tmin, tmax) : meets_first(&in, &r, tmin, tmax);
}

/* What all searches begin with; the rest is left as it is. */
static void begin(struct search *q, const struct kdtree *kd, const struct geometry *geo, const struct ray *ray)
{
    q->kd = kd;
    q->geo = geo;
    q->world = ray;
    q->start = ray->from != 0 ? GRAZING * start_margin(ray) : 0;
    q->instance = 0;
    q->limit = ray->tmax;
}

bool kd_closest(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, struct hit *hit)
{
    struct search q;
    begin(&q, kd, geo, ray);
    bool close = false;
    q.margin = GRAZING * 3e-7 * kd->reach;
    q.hit = hit;
    q.close = &close;
    q.nearest = NULL;
    if (!meets_first(&q, ray, ray->tmin, ray->tmax) || !close)
        return q.found;
    const struct hit nearest = *hit;
    q.nearest = &nearest;
    q.limit = smaller(ray->tmax, nearest.t + q.margin);
    return meets_first(&q, ray, ray->tmin, ray->tmax);
}

bool kd_occluded(const struct kdtree *kd, const struct geometry *geo, const struct ray *ray, double light)
{
    struct search q;
    begin(&q, kd, geo, ray);
    q.ends = ray->to != 0 && ray->to != WITHIN_MEDIUM && ray->tmax < INFINITY;
    q.light = light;
    return meets_any(&q, ray, ray->tmin, ray->tmax);
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
    bool bounded = ray->tmax < INFINITY;
    for (bool more = traversal_start(&w, kd, ray->o, ray->d, bounded, ray->tmin, ray->tmax); more;
         more = traversal_next(&w, ray->tmax)) {
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
