/* triangle.h: the ray-triangle test, inline because it is the innermost loop of the whole program, and the
 * differential geometry of a triangle.
 *
 * The test is the watertight one of [Woop 2013], in double. The ray is turned into the axis (0,0) by a shear that
 * depends on the ray alone, so every vertex has one projection (ax, ay), whichever triangle it belongs to.
 * The edge function of a shared edge is then the same number with opposite sign in both triangles; a rounded difference
 * of two products never has the wrong sign (at worst it is 0), and 0 counts as inside: no ray slips between two
 * triangles.
 *
 * Tests: test_shape.c, test_kdtree.c (closed surfaces).
 */
#ifndef ASBDPT_TRIANGLE_H
#define ASBDPT_TRIANGLE_H

#include "geometry/surface.h"

/* What the test needs of a ray, computed once per ray. */
struct triangle_ray {
    const struct ray *ray;
    double ox, oy, oz; /* origin, axes permuted so that z is the ray's longest */
    double sx, sy;     /* shear: d[kx]/d[kz], d[ky]/d[kz] */
    int kx, ky, kz;    /* the permutation */
};

static inline struct triangle_ray triangle_ray(const struct ray *ray)
{
    double o[3] = {ray->o.x, ray->o.y, ray->o.z}, d[3] = {ray->d.x, ray->d.y, ray->d.z};
    int kz = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    kz = fabs(d[2]) > fabs(d[kz]) ? 2 : kz;
    int kx = kz == 2 ? 0 : kz + 1, ky = kx == 2 ? 0 : kx + 1;
    struct triangle_ray r = {ray, o[kx], o[ky], o[kz], d[kx] / d[kz], d[ky] / d[kz], kx, ky, kz};
    return r;
}

/* triangle_distance: t where the ray meets the plane of the triangle v. The edges, differences of floats, are exact in
 * double, so t is good to the last digits even for needles and grazing rays. */
static inline double triangle_distance(const struct triangle_ray *r, const float v[9])
{
    vec3 v0 = load3(v, 0), n = cross(sub(load3(v, 1), v0), sub(load3(v, 2), v0));
    return dot(n, sub(v0, r->ray->o)) / dot(n, r->ray->d);
}

/* triangle_hit: does the ray meet the triangle v[0..8] (three vertices) at tmin < t < tmax?
 * On true hit->t, b1 and b2 are set. A triangle of zero area, or seen exactly edge-on, is never hit. */
static inline bool triangle_hit(const struct triangle_ray *r, const float v[9], double tmax, struct hit *hit)
{
    double t = triangle_distance(r, v);
    if (!(t > r->ray->tmin && t < tmax))
        return false;
    double az = v[r->kz] - r->oz, bz = v[3 + r->kz] - r->oz, cz = v[6 + r->kz] - r->oz;
    double ax = (v[r->kx] - r->ox) - r->sx * az, ay = (v[r->ky] - r->oy) - r->sy * az;
    double bx = (v[3 + r->kx] - r->ox) - r->sx * bz, by = (v[3 + r->ky] - r->oy) - r->sy * bz;
    double cx = (v[6 + r->kx] - r->ox) - r->sx * cz, cy = (v[6 + r->ky] - r->oy) - r->sy * cz;
    double ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
    /* Which edge has the wrong sign is a matter of chance, so one test of the extremes beats one of each. */
    double least = ea < eb ? ea : eb, most = ea > eb ? ea : eb;
    least = ec < least ? ec : least;
    most = ec > most ? ec : most;
    if ((least < 0) & (most > 0))
        return false;
    double sum = ea + eb + ec;
    if (sum == 0)
        return false;
    hit->t = t;
    hit->b1 = eb / sum;
    hit->b2 = ec / sum;
    return true;
}

/* What the shading of a triangle is computed from. */
struct triangle {
    vec3 p[3];       /* world positions */
    vec3 n[3], s[3]; /* vertex normals and tangents; read only if has_n, has_s */
    double uv[3][2]; /* (0,0) (1,0) (1,1) where the mesh has none */
    bool has_n, has_s;
    bool flip;          /* turns the normal of a triangle without vertex normals */
    bool skip_partials; /* see struct shape_group */
};

/* triangle_place: position and normals at barycentric coordinates (1-b1-b2, b1, b2). With vertex normals, ns is their
 * normalised mean and ng lies on its side; without, ns = ng. Returns twice the triangle's area, m^2. */
static inline double triangle_place(const struct triangle *tri, double b1, double b2, struct surface *out)
{
    vec3 normal = cross(sub(tri->p[1], tri->p[0]), sub(tri->p[2], tri->p[0]));
    double size = length(normal);
    out->p = barycentric3(tri->p, b1, b2);
    out->ng = out->ns = mul(normal, (tri->flip ? -1 : 1) / size);
    if (tri->has_n) {
        vec3 ns = normalize(barycentric3(tri->n, b1, b2));
        if (length2(ns) > 0)
            out->ns = ns;
        out->ng = faceforward(out->ng, out->ns);
    }
    return size;
}

/* triangle_partials: texture coordinates and, unless skip_partials is set and they are zero, partial derivatives of a
 * place. With vertex normals dpdu and dpdv are the derivatives by (u,v) projected to be orthogonal to ns; without, the
 * derivatives as they are. Where (u,v) do not span the triangle they are any unit tangents. With vertex tangents they
 * are turned about ns until dpdu is along their mean. */
void triangle_partials(const struct triangle *tri, double b1, double b2, struct surface *out);

#endif
