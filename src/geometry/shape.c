/* shape.c: see shape.h. Keeps the flat arrays and hands each question to triangle.c, quadric.c or curve.c. */
#include "geometry/shape.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/warp.h"
#include "geometry/triangle.h"

static bool is_quadric(int prim) { return prim >= FIRST_QUADRIC && prim < FIRST_CURVE; }
static bool is_curve(int prim) { return prim >= FIRST_CURVE && prim < FIRST_INSTANCE; }
static const struct quadric *quadric_of(const struct geometry *geo, int prim)
{
    return &geo->quadric[prim - FIRST_QUADRIC];
}

void mesh_free(struct mesh *m)
{
    free(m->P);
    free(m->N);
    free(m->S);
    free(m->UV);
    free(m->index);
    free(m->strand);
    memset(m, 0, sizeof *m);
}

void geometry_free(struct geometry *geo)
{
    free(geo->P);
    free(geo->N);
    free(geo->S);
    free(geo->UV);
    free(geo->index);
    free(geo->group_of_triangle);
    free(geo->quadric);
    curves_free(&geo->curves);
    free(geo->object);
    free(geo->instance);
    free(geo->group);
    memset(geo, 0, sizeof *geo);
}

static int add_group(struct geometry *geo, struct shape_group group)
{
    geo->group = mem_append(geo->group, (size_t)geo->n_groups, sizeof *geo->group);
    geo->group[geo->n_groups] = group;
    return geo->n_groups++;
}

/* Room for more vertices in the three arrays that share one capacity, and for tangents, which are rare. */
static void reserve_vertices(struct geometry *geo, size_t need, bool tangents)
{
    size_t cap_p = geo->vertex_capacity, cap_n = cap_p, cap_uv = cap_p;
    geo->P = mem_grow(geo->P, &cap_p, need, 3 * sizeof *geo->P);
    geo->N = mem_grow(geo->N, &cap_n, need, 3 * sizeof *geo->N);
    geo->UV = mem_grow(geo->UV, &cap_uv, need, 2 * sizeof *geo->UV);
    geo->vertex_capacity = cap_p;
    if (tangents)
        geo->S = mem_grow(geo->S, &geo->tangent_capacity, need, 3 * sizeof *geo->S);
}

static void reserve_triangles(struct geometry *geo, size_t need)
{
    size_t cap_index = geo->triangle_capacity, cap_group = cap_index;
    geo->index = mem_grow(geo->index, &cap_index, need, 3 * sizeof *geo->index);
    geo->group_of_triangle = mem_grow(geo->group_of_triangle, &cap_group, need, sizeof *geo->group_of_triangle);
    geo->triangle_capacity = cap_index;
}

/* The world normal of a vertex, or its tangent, of any length; 0 if there is none. */
static vec3 direction(const float *d, bool normal, const struct transform *to_world, size_t i)
{
    vec3 v = d == NULL ? vec(0, 0, 0) : (normal ? transform_normal : transform_vector)(to_world, load3(d, i));
    return is_finite3(v) ? v : vec(0, 0, 0);
}

/* As in pbrt-v3, longer ones count for more where they are interpolated. A factor common to all n of a mesh changes
 * nothing, so the longest is made 1, which fits a float. */
static double scale_of(const float *d, bool normal, const struct transform *to_world, int n)
{
    double longest = 0;
    for (size_t i = 0; d != NULL && i < (size_t)n; i++)
        longest = fmax(longest, length(direction(d, normal, to_world, i)));
    return longest > 0 ? 1 / longest : 1;
}

static bool add_vertices(struct geometry *geo, const struct mesh *m, const struct transform *to_world, bool reverse,
                         struct error *err)
{
    size_t base = (size_t)geo->n_vertices;
    double scale = (reverse ? -1 : 1) * scale_of(m->N, true, to_world, m->n_vertices);
    double scale_s = scale_of(m->S, false, to_world, m->n_vertices);
    reserve_vertices(geo, base + (size_t)m->n_vertices, m->S != NULL);
    for (size_t i = 0; i < (size_t)m->n_vertices; i++) {
        vec3 p = transform_point(to_world, m->P[i]);
        if (!is_place(p))
            return error_set(err, "vertex %lu of the mesh is (%g, %g, %g) from the camera: places go up to 1e12",
                             (unsigned long)i, p.x, p.y, p.z);
        store3(geo->P, base + i, p);
        store3(geo->N, base + i, mul(direction(m->N, true, to_world, i), scale));
        if (m->S != NULL)
            store3(geo->S, base + i, mul(direction(m->S, false, to_world, i), scale_s));
        for (size_t k = 0; k < 2; k++)
            geo->UV[2 * (base + i) + k] = m->UV != NULL ? m->UV[2 * i + k] : 0;
    }
    return true;
}

static int add_curves(struct geometry *geo, const struct mesh *m, const struct transform *to_world,
                      struct shape_group group, bool reverse, struct error *err)
{
    struct curves *all = &geo->curves;
    if (m->n_strands > FIRST_INSTANCE - FIRST_CURVE - all->n) {
        error_set(err, "the scene has more than 2^28 curves");
        return -1;
    }
    group.first_prim = FIRST_CURVE + all->n;
    group.n_prims = m->n_strands;
    group.has_n = group.has_uv = true;
    group.has_s = group.flip = false;
    return curves_add(all, m->strand, m->n_strands, to_world, reverse, geo->n_groups, err) ? add_group(geo, group) : -1;
}

int shape_add_mesh(struct geometry *geo, const struct mesh *m, const struct transform *to_world,
                   struct shape_group group, bool reverse_orientation, struct error *err)
{
    if (m->n_strands > 0)
        return add_curves(geo, m, to_world, group, reverse_orientation, err);
    if (m->n_triangles > FIRST_QUADRIC - geo->n_triangles || m->n_vertices > INT32_MAX - geo->n_vertices) {
        error_set(err, "the scene has more than 2^30 triangles");
        return -1;
    }
    if (!add_vertices(geo, m, to_world, reverse_orientation, err))
        return -1;
    reserve_triangles(geo, (size_t)geo->n_triangles + (size_t)m->n_triangles);
    for (size_t i = 0; i < 3 * (size_t)m->n_triangles; i++)
        geo->index[3 * (size_t)geo->n_triangles + i] = m->index[i] + (uint32_t)geo->n_vertices;
    for (int i = 0; i < m->n_triangles; i++)
        geo->group_of_triangle[geo->n_triangles + i] = geo->n_groups;
    group.first_prim = geo->n_triangles;
    group.n_prims = m->n_triangles;
    group.flip = reverse_orientation != transform_swaps_handedness(to_world);
    group.has_n = m->N != NULL;
    group.has_s = m->S != NULL;
    group.has_uv = m->UV != NULL;
    geo->n_vertices += m->n_vertices;
    geo->n_triangles += m->n_triangles;
    return add_group(geo, group);
}

int shape_add_quadric(struct geometry *geo, struct quadric q, struct shape_group group, bool reverse_orientation,
                      struct error *err)
{
    vec3 lo, hi;
    quadric_normalise(&q);
    quadric_bounds(&q, &lo, &hi);
    if (!is_place(lo) || !is_place(hi)) {
        error_set(err, "this shape is (%g, %g, %g) to (%g, %g, %g) from the camera: places go up to 1e12", lo.x, lo.y,
                  lo.z, hi.x, hi.y, hi.z);
        return -1;
    }
    if (geo->n_quadrics >= FIRST_CURVE - FIRST_QUADRIC) {
        error_set(err, "the scene has more than 2^28 quadrics");
        return -1;
    }
    q.group = geo->n_groups;
    group.first_prim = FIRST_QUADRIC + geo->n_quadrics;
    group.n_prims = 1;
    group.flip = reverse_orientation;
    group.has_n = group.has_s = false;
    group.has_uv = true;
    geo->quadric = mem_append(geo->quadric, (size_t)geo->n_quadrics, sizeof *geo->quadric);
    geo->quadric[geo->n_quadrics++] = q;
    return add_group(geo, group);
}

int shape_make_object(struct geometry *geo, int first_group)
{
    struct object o = {first_group, geo->n_groups, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (struct shape_group *g = geo->group + first_group; g < geo->group + geo->n_groups; g++) {
        g->shared = true;
        for (int i = 0; i < g->n_prims; i++) {
            float lo[3], hi[3];
            shape_bounds(geo, g->first_prim + i, lo, hi);
            o.lo = vec(fmin(o.lo.x, (double)lo[0]), fmin(o.lo.y, (double)lo[1]), fmin(o.lo.z, (double)lo[2]));
            o.hi = vec(fmax(o.hi.x, (double)hi[0]), fmax(o.hi.y, (double)hi[1]), fmax(o.hi.z, (double)hi[2]));
        }
    }
    geo->object = mem_append(geo->object, (size_t)geo->n_objects, sizeof *geo->object);
    geo->object[geo->n_objects] = o;
    return geo->n_objects++;
}

static void instance_bounds(const struct geometry *geo, const struct instance *in, vec3 *lo, vec3 *hi)
{
    const struct object *o = &geo->object[in->object];
    *lo = vec(INFINITY, INFINITY, INFINITY);
    *hi = neg(*lo);
    for (int i = 0; i < 8; i++) {
        vec3 p = vec(i & 1 ? o->hi.x : o->lo.x, i & 2 ? o->hi.y : o->lo.y, i & 4 ? o->hi.z : o->lo.z);
        p = transform_point(&in->to_world, p);
        *lo = vec(fmin(lo->x, p.x), fmin(lo->y, p.y), fmin(lo->z, p.z));
        *hi = vec(fmax(hi->x, p.x), fmax(hi->y, p.y), fmax(hi->z, p.z));
    }
}

bool shape_add_instance(struct geometry *geo, int object, const struct transform *to_world, struct error *err)
{
    const struct instance in = {*to_world, object};
    vec3 lo, hi;
    if (geo->n_instances > INT32_MAX - FIRST_INSTANCE)
        return error_set(err, "the scene has more than 2^29 instances");
    instance_bounds(geo, &in, &lo, &hi);
    if (!is_place(lo) || !is_place(hi))
        return error_set(err, "this instance is (%g, %g, %g) to (%g, %g, %g) from the camera: places go up to 1e12",
                         lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
    geo->instance = mem_append(geo->instance, (size_t)geo->n_instances, sizeof *geo->instance);
    geo->instance[geo->n_instances++] = in;
    return true;
}

const struct shape_group *shape_group_of(const struct geometry *geo, int prim)
{
    return &geo->group[prim < FIRST_QUADRIC ? geo->group_of_triangle[prim]
                       : is_quadric(prim)   ? quadric_of(geo, prim)->group
                                            : geo->curves.curve[prim - FIRST_CURVE].group];
}

void shape_vertices(const struct geometry *geo, int triangle, float v[9])
{
    for (int i = 0; i < 3; i++) {
        const float *p = geo->P + 3 * (size_t)geo->index[3 * (size_t)triangle + (size_t)i];
        for (int k = 0; k < 3; k++)
            v[3 * i + k] = p[k];
    }
}

/* Positions, normals or tangents at the corners of a triangle. */
static void load_corners(const float *v, const uint32_t index[3], vec3 corner[3])
{
    for (size_t i = 0; i < 3; i++)
        corner[i] = load3(v, index[i]);
}

/* Where an instance places it. */
static const struct transform *transform_of(const struct geometry *geo, int instance)
{
    return &geo->instance[instance - 1].to_world;
}

static void place_triangle(struct triangle *tri, const struct transform *t)
{
    tri->flip = tri->flip != transform_swaps_handedness(t);
    for (int i = 0; i < 3; i++) {
        tri->p[i] = transform_point(t, tri->p[i]);
        if (tri->has_n)
            tri->n[i] = transform_normal(t, tri->n[i]);
        if (tri->has_s)
            tri->s[i] = transform_vector(t, tri->s[i]);
    }
}

static inline void load_triangle(const struct geometry *geo, const struct shape_group *group, int prim, int instance,
                                 struct triangle *tri)
{
    static const double default_uv[3][2] = {{0, 0}, {1, 0}, {1, 1}};
    const uint32_t *index = &geo->index[3 * (size_t)prim];
    load_corners(geo->P, index, tri->p);
    if (group->has_n)
        load_corners(geo->N, index, tri->n);
    if (group->has_s)
        load_corners(geo->S, index, tri->s);
    for (size_t i = 0; !group->skip_uv && i < 6; i++)
        tri->uv[i / 2][i % 2] =
            group->has_uv ? (double)geo->UV[2 * (size_t)index[i / 2] + i % 2] : default_uv[i / 2][i % 2];
    tri->has_n = group->has_n;
    tri->has_s = group->has_s;
    tri->flip = group->flip;
    tri->skip_partials = group->skip_partials;
    if (instance > 0)
        place_triangle(tri, transform_of(geo, instance));
}

/* The triangle of a curve that was hit, and where in it. */
static void load_curve_triangle(const struct geometry *geo, const struct shape_group *group, const struct hit *hit,
                                struct triangle *tri, double *b1, double *b2)
{
    *tri = (struct triangle){.has_n = true, .skip_partials = group->skip_partials};
    curve_triangle(&geo->curves, hit->prim - FIRST_CURVE, hit, tri, b1, b2);
    if (hit->instance > 0)
        place_triangle(tri, transform_of(geo, hit->instance));
}

void shape_bounds(const struct geometry *geo, int prim, float lo[3], float hi[3])
{
    if (is_curve(prim)) {
        const float low[3] = {-INFINITY, -INFINITY, -INFINITY}, high[3] = {INFINITY, INFINITY, INFINITY};
        curve_bounds(&geo->curves, prim - FIRST_CURVE, low, high, lo, hi);
        return;
    }
    if (prim >= FIRST_QUADRIC) {
        vec3 low, high;
        if (prim >= FIRST_INSTANCE)
            instance_bounds(geo, &geo->instance[prim - FIRST_INSTANCE], &low, &high);
        else
            quadric_bounds(quadric_of(geo, prim), &low, &high);
        double l[3] = {low.x, low.y, low.z}, h[3] = {high.x, high.y, high.z};
        for (int k = 0; k < 3; k++) {
            lo[k] = float_below(l[k]);
            hi[k] = float_above(h[k]);
        }
        return;
    }
    float v[9];
    shape_vertices(geo, prim, v);
    for (int k = 0; k < 3; k++) {
        lo[k] = fminf(v[k], fminf(v[3 + k], v[6 + k]));
        hi[k] = fmaxf(v[k], fmaxf(v[3 + k], v[6 + k]));
    }
}

bool shape_intersect(const struct geometry *geo, int prim, const struct ray *ray, struct hit *hit)
{
    bool begins = ray->from == shape_prim_id(prim, 0), ends = ray->to == shape_prim_id(prim, 0);
    if (is_quadric(prim)) {
        if (!quadric_intersect(quadric_of(geo, prim), ray, begins, ends, &hit->t))
            return false;
        hit->b1 = hit->b2 = 0;
    } else if (is_curve(prim)) {
        if (!curve_intersect(&geo->curves, prim - FIRST_CURVE, ray, begins, ends, hit))
            return false;
    } else if (begins || ends) {
        return false;
    } else {
        float v[9];
        shape_vertices(geo, prim, v);
        struct triangle_ray r = triangle_ray(ray);
        if (!triangle_hit(&r, v, ray->tmax, hit))
            return false;
    }
    hit->prim = prim;
    hit->instance = 0;
    return true;
}

void shape_surface(const struct geometry *geo, const struct hit *hit, const struct ray *ray, struct surface *out)
{
    const struct shape_group *group = shape_group_of(geo, hit->prim);
    if (is_quadric(hit->prim)) {
        struct quadric q = *quadric_of(geo, hit->prim);
        if (hit->instance > 0)
            q.to_world = transform_compose(*transform_of(geo, hit->instance), q.to_world);
        vec3 p = transform_point_back(&q.to_world, add(ray->o, mul(ray->d, hit->t)));
        quadric_surface_at(&q, group->flip, group->skip_uv, p, out);
    } else {
        struct triangle tri;
        double b1 = hit->b1, b2 = hit->b2;
        if (is_curve(hit->prim))
            load_curve_triangle(geo, group, hit, &tri, &b1, &b2);
        else
            load_triangle(geo, group, hit->prim, hit->instance, &tri);
        triangle_place(&tri, b1, b2, out);
        if (!group->skip_uv)
            triangle_partials(&tri, b1, b2, out);
    }
    out->material = group->material;
    out->prim_id = shape_prim_id(hit->prim, hit->instance);
    out->light = group->first_light >= 0 ? group->first_light + hit->prim - group->first_prim : -1;
}

bool shape_is_light(const struct geometry *geo, int prim) { return shape_group_of(geo, prim)->first_light >= 0; }

uint64_t shape_light_rank(const struct geometry *geo, int prim)
{
    return (uint64_t)(shape_group_of(geo, prim)->material >= 0) << 61 | shape_prim_id(prim, 0);
}

uint64_t shape_rank(const struct geometry *geo, const struct hit *hit, const struct ray *ray, vec3 w)
{
    struct surface at;
    if (!shape_is_light(geo, hit->prim))
        return (uint64_t)1 << 62 | shape_prim_id(hit->prim, hit->instance);
    shape_surface(geo, hit, ray, &at);
    bool shines = shape_group_of(geo, hit->prim)->two_sided || dot(at.ng, w) > 0;
    return (uint64_t)!shines << 60 | shape_light_rank(geo, hit->prim);
}

double shape_area(const struct geometry *geo, int prim)
{
    if (is_quadric(prim))
        return quadric_area(quadric_of(geo, prim));
    vec3 p[3];
    load_corners(geo->P, &geo->index[3 * (size_t)prim], p);
    return 0.5 * length(cross(sub(p[1], p[0]), sub(p[2], p[0])));
}

bool shape_sample(const struct geometry *geo, int prim, double u1, double u2, struct surface *out, double *pdf_a)
{
    const struct shape_group *group = shape_group_of(geo, prim);
    if (is_quadric(prim)) {
        const struct quadric *q = quadric_of(geo, prim);
        quadric_surface_at(q, group->flip, group->skip_uv, quadric_sample(q, u1, u2), out);
        *pdf_a = quadric_pdf_a(q, out->ng);
        return true;
    }
    struct triangle tri;
    struct hit hit = {.prim = prim};
    load_triangle(geo, group, prim, 0, &tri);
    warp_triangle(u1, u2, &hit.b1, &hit.b2);
    *pdf_a = 2 / triangle_place(&tri, hit.b1, hit.b2, out);
    return group->alpha < 0 || geo->opaque == NULL || geo->opaque(geo->opaque_context, geo, &hit);
}

double shape_pdf_a(const struct geometry *geo, int prim, const struct surface *at)
{
    if (is_quadric(prim))
        return quadric_pdf_a(quadric_of(geo, prim), at->ng);
    return 1 / shape_area(geo, prim);
}
