/* quadric.c: see quadric.h. Parametrisations and partial derivatives as in [PBRT3 3.2-3.5]. */
#include "geometry/quadric.h"

#include "base/maths.h"

/* Distance from the z axis, and the unit vector away from it; x on the axis itself. */
static double ring_of(vec3 p) { return sqrt(sqr(p.x) + sqr(p.y)); }
static vec3 outwards(vec3 p)
{
    double r = ring_of(p);
    return r > 0 ? vec(p.x / r, p.y / r, 0) : vec(1, 0, 0);
}

void quadric_normalise(struct quadric *q)
{
    if (q->kind == QUADRIC_HYPERBOLOID) {
        if (q->p2.z == 0) { /* pbrt-v3 turns the segment round then, so v runs the other way */
            vec3 p = q->p1;
            q->p1 = q->p2;
            q->p2 = p;
        }
        q->radius = fmax(ring_of(q->p1), ring_of(q->p2));
        q->zmin = q->p1.z;
        q->zmax = q->p2.z;
    }
    double low = fmin(q->zmin, q->zmax), high = fmax(q->zmin, q->zmax);
    q->zmin = q->kind == QUADRIC_SPHERE ? clamp(low, -q->radius, q->radius) : low;
    q->zmax = q->kind == QUADRIC_SPHERE ? clamp(high, -q->radius, q->radius) : high;
    q->phi_max = clamp(q->phi_max, 0, 2 * PI);
}

void quadric_bounds(const struct quadric *q, vec3 *lo, vec3 *hi)
{
    /* Row i of the matrix maps the circle of radius r at height z to m3 + m2 z +- r |(m0, m1)|; a sphere is
     * also within m3 +- r |(m0, m1, m2)|. */
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        const double *m = q->to_world.m[i];
        double disk = q->radius * sqrt(sqr(m[0]) + sqr(m[1]));
        double ball = q->radius * sqrt(sqr(m[0]) + sqr(m[1]) + sqr(m[2]));
        double z0 = m[2] * q->zmin, z1 = m[2] * q->zmax;
        low[i] = fmin(z0, z1) - disk;
        high[i] = fmax(z0, z1) + disk;
        if (q->kind == QUADRIC_SPHERE) {
            low[i] = fmax(low[i], -ball);
            high[i] = fmin(high[i], ball);
        }
        double slack = 1e-14 * (fabs(m[3]) + fabs(low[i]) + fabs(high[i]));
        low[i] += m[3] - slack;
        high[i] += m[3] + slack;
    }
    *lo = vec(low[0], low[1], low[2]);
    *hi = vec(high[0], high[1], high[2]);
}

/* The point of a hyperboloid's segment at height z. */
static vec3 on_segment(const struct quadric *q, double z)
{
    return lerp3((z - q->p1.z) / (q->p2.z - q->p1.z), q->p1, q->p2);
}

/* The angle by which the curve that sweeps the quadric has turned at p. */
static double azimuth(const struct quadric *q, vec3 p)
{
    vec3 from = q->kind == QUADRIC_HYPERBOLOID ? on_segment(q, p.z) : vec(1, 0, 0);
    double phi = m_atan2(from.x * p.y - from.y * p.x, from.x * p.x + from.y * p.y);
    return phi < 0 ? phi + 2 * PI : phi;
}

/* Is a point of the full surface in the part that z and phi leave over? */
static bool is_kept(const struct quadric *q, vec3 p)
{
    if (q->phi_max < 2 * PI && azimuth(q, p) > q->phi_max)
        return false;
    switch (q->kind) {
    case QUADRIC_SPHERE: return !(q->zmin > -q->radius && p.z < q->zmin) && !(q->zmax < q->radius && p.z > q->zmax);
    case QUADRIC_DISK: {
        double r2 = sqr(p.x) + sqr(p.y);
        return r2 <= sqr(q->radius) && r2 >= sqr(q->inner_radius);
    }
    case QUADRIC_CYLINDER:
    case QUADRIC_CONE:
    case QUADRIC_PARABOLOID:
    case QUADRIC_HYPERBOLOID: return p.z >= q->zmin && p.z <= q->zmax;
    }
    return false;
}

/* Roots t[0] <= t[1] of a t^2 - 2 b t + c = 0 from discriminant b^2 - a c >= 0; numbers of one sign are added. */
static void ordered_roots(double a, double b, double c, double discriminant, double t[2])
{
    double q = b + copysign(sqrt(discriminant), b), t0 = q / a, t1 = q != 0 ? c / q : t0;
    t[0] = t0 < t1 ? t0 : t1;
    t[1] = t0 < t1 ? t1 : t0;
}

/* --- cones, paraboloids, hyperboloids ---------------------------------------------------------------- */

/* Of these the distance from the z axis, squared, is c0 + c1 w + c2 w^2 where w = z - z0. */
struct profile {
    double z0, c0, c1, c2;
};

static struct profile profile_of(const struct quadric *q)
{
    struct profile f = {0, 0, 0, 0};
    if (q->kind == QUADRIC_CONE) {
        f.z0 = q->zmax;
        f.c2 = sqr(q->radius / q->zmax);
    } else if (q->kind == QUADRIC_PARABOLOID) {
        f.c1 = sqr(q->radius) / q->zmax;
    } else {
        double height = q->p2.z - q->p1.z;
        double ex = (q->p2.x - q->p1.x) / height, ey = (q->p2.y - q->p1.y) / height;
        f.z0 = q->p1.z;
        f.c0 = sqr(q->p1.x) + sqr(q->p1.y);
        f.c1 = 2 * (q->p1.x * ex + q->p1.y * ey);
        f.c2 = sqr(ex) + sqr(ey);
    }
    return f;
}

/* Roots of a t^2 - 2 b t + c = 0, counted from the point of the line that is nearest to (0, 0, z0), so that far rays
 * lose nothing. One of them is infinite or NaN where a = 0: it lies in no segment. */
static bool profile_roots(struct profile f, vec3 o, vec3 d, double t[2])
{
    o.z -= f.z0;
    double nearest = -dot(o, d) / length2(d);
    o = add(o, mul(d, nearest));
    double a = sqr(d.x) + sqr(d.y) - f.c2 * sqr(d.z);
    double b = d.z * (0.5 * f.c1 + f.c2 * o.z) - o.x * d.x - o.y * d.y;
    double c = sqr(o.x) + sqr(o.y) - f.c0 - o.z * (f.c1 + f.c2 * o.z);
    double discriminant = b * b - a * c;
    if (!(discriminant >= 0))
        return false;
    ordered_roots(a, b, c, discriminant, t);
    t[0] += nearest;
    t[1] += nearest;
    return true;
}

/* One step of Newton's method along the gradient: enough for a point that is already within rounding. */
static vec3 profile_project(struct profile f, vec3 p)
{
    double w = p.z - f.z0, excess = sqr(p.x) + sqr(p.y) - f.c0 - w * (f.c1 + f.c2 * w);
    vec3 gradient = vec(2 * p.x, 2 * p.y, -f.c1 - 2 * f.c2 * w);
    return length2(gradient) > 0 ? sub(p, mul(gradient, excess / length2(gradient))) : p;
}

/* --- where rays meet a quadric ------------------------------------------------------------------------ */

/* Roots t[0] <= t[1] of |o + t d| = r. The discriminant is taken at the point of closest approach, and only
 * quantities of the same sign are added: no cancellation for far or touching rays. */
static bool sphere_roots(vec3 o, vec3 d, double r, double t[2])
{
    double a = length2(d), b = -dot(o, d);
    if (a == 0)
        return false;
    vec3 closest = add(o, mul(d, b / a));
    double discriminant = a * (sqr(r) - length2(closest));
    if (discriminant < 0)
        return false;
    double l = length(o), c = (l - r) * (l + r);
    ordered_roots(a, b, c, discriminant, t);
    return true;
}

/* All parameters t at which the line meets the uncut quadric, ascending; returns how many. */
static int line_roots(const struct quadric *q, vec3 o, vec3 d, double t[2])
{
    switch (q->kind) {
    case QUADRIC_SPHERE: return sphere_roots(o, d, q->radius, t) ? 2 : 0;
    case QUADRIC_DISK: t[0] = d.z != 0 ? (q->zmin - o.z) / d.z : 0; return d.z != 0;
    case QUADRIC_CYLINDER: return sphere_roots(vec(o.x, o.y, 0), vec(d.x, d.y, 0), q->radius, t) ? 2 : 0;
    case QUADRIC_CONE:
    case QUADRIC_PARABOLOID:
    case QUADRIC_HYPERBOLOID: return profile_roots(profile_of(q), o, d, t) ? 2 : 0;
    }
    return 0;
}

/* The nearest point of the uncut quadric. */
static vec3 project(const struct quadric *q, vec3 p)
{
    double r = ring_of(p), l = length(p);
    switch (q->kind) {
    case QUADRIC_SPHERE: return l > 0 ? mul(p, q->radius / l) : vec(q->radius, 0, 0);
    case QUADRIC_DISK: return vec(p.x, p.y, q->zmin);
    case QUADRIC_CYLINDER:
        return r > 0 ? vec(p.x * q->radius / r, p.y * q->radius / r, p.z) : vec(q->radius, 0, p.z);
    case QUADRIC_CONE:
    case QUADRIC_PARABOLOID:
    case QUADRIC_HYPERBOLOID: return profile_project(profile_of(q), p);
    }
    return p;
}

/* Which of n <= 2 roots is nearest to t? */
static int nearest_root(const double root[2], int n, double t)
{
    return n == 2 && fabs(root[1] - t) < fabs(root[0] - t);
}

bool quadric_intersect(const struct quadric *q, const struct ray *ray, bool begins, bool ends, double *t)
{
    const double(*m)[4] = q->to_world.inv;
    vec3 o = add(transform_vector_back(&q->to_world, ray->o), vec(m[0][3], m[1][3], m[2][3]));
    vec3 d = transform_vector_back(&q->to_world, ray->d);
    double root[2];
    int n = line_roots(q, o, d, root);
    int first = begins ? nearest_root(root, n, 0) : -1, last = ends ? nearest_root(root, n, ray->tmax) : -1;
    for (int i = 0; i < n; i++)
        if (i != first && i != last && root[i] > ray->tmin && root[i] < ray->tmax &&
            is_kept(q, project(q, add(o, mul(d, root[i]))))) {
            *t = root[i];
            return true;
        }
    return false;
}

/* --- the surface -------------------------------------------------------------------------------------- */

/* The normal at a point of the surface in object space, of any length. */
static vec3 normal_at(const struct quadric *q, vec3 p)
{
    struct profile f;
    vec3 out = outwards(p), n;
    switch (q->kind) {
    case QUADRIC_SPHERE: return mul(p, 1 / q->radius);
    case QUADRIC_DISK: return vec(0, 0, 1);
    case QUADRIC_CYLINDER: return vec(p.x / q->radius, p.y / q->radius, 0);
    case QUADRIC_CONE: return vec(out.x * q->zmax, out.y * q->zmax, q->radius);
    case QUADRIC_PARABOLOID: return vec(p.x, p.y, -0.5 * sqr(q->radius) / q->zmax); /* half the gradient */
    case QUADRIC_HYPERBOLOID: /* half the gradient, turned the way of dpdu x dpdv; any direction on the axis */
        f = profile_of(q);
        n = vec(p.x, p.y, -0.5 * f.c1 - f.c2 * (p.z - f.z0));
        return mul(length2(n) > 0 ? n : vec(1, 0, 0), q->p2.z > q->p1.z ? 1 : -1);
    }
    return p;
}

/* What follows fills in u, v and partial derivatives of a point in object space; dndu and dndv are zero at first. */

/* Derivatives by u shrink towards the axis, where they would be no tangents; of the radius, they stop at this. */
static const double LEAST_RING = 1e-5;

/* theta runs from acos(zmin/r), where v = 0, to acos(zmax/r). On the axis phi is taken as 0. */
static void sphere_point(const struct quadric *q, vec3 p, struct surface *at)
{
    double r = q->radius, ring = ring_of(p);
    double theta0 = m_acos(clamp(q->zmin / r, -1, 1)), theta1 = m_acos(clamp(q->zmax / r, -1, 1));
    vec3 out = outwards(p);
    ring = fmax(ring, LEAST_RING * r);
    at->v = (m_acos(clamp(p.z / r, -1, 1)) - theta0) / (theta1 - theta0);
    at->dpdu = mul(vec(-out.y, out.x, 0), q->phi_max * ring);
    at->dpdv = mul(vec(p.z * out.x, p.z * out.y, -ring), theta1 - theta0);
    at->dndu = mul(at->dpdu, 1 / r);
    at->dndv = mul(at->dpdv, 1 / r);
}

static void disk_point(const struct quadric *q, vec3 p, struct surface *at)
{
    double r = fmax(ring_of(p), LEAST_RING * q->radius), width = q->radius - q->inner_radius;
    vec3 out = outwards(p);
    at->v = (q->radius - r) / width;
    at->dpdu = mul(vec(-out.y, out.x, 0), q->phi_max * r);
    at->dpdv = mul(out, -width);
}

static void cylinder_point(const struct quadric *q, vec3 p, struct surface *at)
{
    at->v = (p.z - q->zmin) / (q->zmax - q->zmin);
    at->dpdu = mul(vec(-p.y, p.x, 0), q->phi_max);
    at->dpdv = vec(0, 0, q->zmax - q->zmin);
    at->dndu = mul(at->dpdu, 1 / q->radius);
}

/* The normal does not change along the slope. */
static void cone_point(const struct quadric *q, vec3 p, struct surface *at)
{
    vec3 out = outwards(p), along = vec(-out.y, out.x, 0);
    at->v = p.z / q->zmax;
    at->dpdu = mul(along, q->phi_max * fmax(ring_of(p), LEAST_RING * q->radius));
    at->dpdv = vec(-out.x * q->radius, -out.y * q->radius, q->zmax);
    at->dndu = mul(along, q->phi_max * q->zmax);
}

/* The surface is x^2 + y^2 = k z, k = radius^2 / zmax. */
static void paraboloid_point(const struct quadric *q, vec3 p, struct surface *at)
{
    double k = sqr(q->radius) / q->zmax, r = fmax(ring_of(p), LEAST_RING * q->radius), height = q->zmax - q->zmin;
    vec3 out = outwards(p);
    at->v = (p.z - q->zmin) / height;
    at->dpdu = at->dndu = mul(vec(-out.y, out.x, 0), q->phi_max * r);
    at->dndv = mul(out, height * k / (2 * r)); /* the ring grows by k / 2r with z */
    at->dpdv = vec(at->dndv.x, at->dndv.y, height);
}

static void hyperboloid_point(const struct quadric *q, vec3 p, struct surface *at)
{
    struct profile f = profile_of(q);
    double phi = azimuth(q, p), c = m_cos(phi), s = m_sin(phi), side = q->p2.z > q->p1.z ? 1 : -1;
    vec3 d = sub(q->p2, q->p1);
    at->v = (p.z - q->p1.z) / d.z;
    at->dpdu = mul(vec(-p.y, p.x, 0), q->phi_max);
    at->dpdv = vec(d.x * c - d.y * s, d.x * s + d.y * c, d.z);
    at->dndu = mul(at->dpdu, side);
    at->dndv = mul(vec(at->dpdv.x, at->dpdv.y, -f.c2 * d.z), side);
}

/* Derivative of the unit world normal from that of the object-space normal: the map is linear up to the
 * final normalisation, which leaves only what is orthogonal to n. */
static vec3 normal_derivative(const struct quadric *q, vec3 d, vec3 n, double scale)
{
    vec3 w = mul(transform_normal(&q->to_world, d), scale);
    return sub(w, mul(n, dot(n, w)));
}

void quadric_surface_at(const struct quadric *q, bool reverse_orientation, bool skip_uv, vec3 p, struct surface *out)
{
    p = project(q, p);
    vec3 normal = transform_normal(&q->to_world, normal_at(q, p));
    double scale = (reverse_orientation ? -1 : 1) / length(normal);
    out->p = transform_point(&q->to_world, p);
    out->ng = out->ns = mul(normal, scale);
    if (skip_uv)
        return;
    out->dndu = out->dndv = vec(0, 0, 0);
    out->u = azimuth(q, p) / q->phi_max;
    switch (q->kind) {
    case QUADRIC_SPHERE: sphere_point(q, p, out); break;
    case QUADRIC_DISK: disk_point(q, p, out); break;
    case QUADRIC_CYLINDER: cylinder_point(q, p, out); break;
    case QUADRIC_CONE: cone_point(q, p, out); break;
    case QUADRIC_PARABOLOID: paraboloid_point(q, p, out); break;
    case QUADRIC_HYPERBOLOID: hyperboloid_point(q, p, out); break;
    }
    out->dpdu = transform_vector(&q->to_world, out->dpdu);
    out->dpdv = transform_vector(&q->to_world, out->dpdv);
    out->dndu = normal_derivative(q, out->dndu, out->ng, scale);
    out->dndv = normal_derivative(q, out->dndv, out->ng, scale);
}

/* --- sampling ------------------------------------------------------------------------------------------ */

vec3 quadric_sample(const struct quadric *q, double u1, double u2)
{
    /* Archimedes: on a sphere, as on a cylinder, equal slices of z have equal area. */
    double phi = u2 * q->phi_max, z = q->zmin + u1 * (q->zmax - q->zmin), r = q->radius;
    if (q->kind == QUADRIC_SPHERE)
        r = safe_sqrt(sqr(q->radius) - sqr(z));
    else if (q->kind == QUADRIC_DISK)
        r = sqrt(sqr(q->inner_radius) + u1 * (sqr(q->radius) - sqr(q->inner_radius)));
    return cylindrical(r, phi, z);
}

static double object_area(const struct quadric *q)
{
    switch (q->kind) {
    case QUADRIC_SPHERE:
    case QUADRIC_CYLINDER: return q->phi_max * q->radius * (q->zmax - q->zmin);
    case QUADRIC_DISK: return q->phi_max * 0.5 * (sqr(q->radius) - sqr(q->inner_radius));
    case QUADRIC_CONE:
    case QUADRIC_PARABOLOID:
    case QUADRIC_HYPERBOLOID: break; /* never sampled */
    }
    return 0;
}

/* World area per object area where the unit world normal is ng: |det M| / |M^T ng|. */
static double area_ratio(const struct quadric *q, vec3 ng)
{
    return fabs(transform_determinant(&q->to_world)) / length(transform_normal_back(&q->to_world, ng));
}

double quadric_pdf_a(const struct quadric *q, vec3 ng) { return 1 / (object_area(q) * area_ratio(q, ng)); }

/* Columns orthogonal and of one length, to rounding. */
static bool is_similarity(const struct transform *t)
{
    vec3 c[3];
    for (int i = 0; i < 3; i++)
        c[i] = vec(t->m[0][i], t->m[1][i], t->m[2][i]);
    double size = length2(c[0]), slack = 1e-9 * size;
    return fabs(length2(c[1]) - size) < slack && fabs(length2(c[2]) - size) < slack &&
           fabs(dot(c[0], c[1])) < slack && fabs(dot(c[1], c[2])) < slack && fabs(dot(c[2], c[0])) < slack;
}

double quadric_area(const struct quadric *q)
{
    int n = q->kind == QUADRIC_DISK || is_similarity(&q->to_world) ? 1 : 64;
    double sum = 0;
    for (int i = 0; i < n * n; i++) {
        struct surface at;
        vec3 p = quadric_sample(q, (i / n + 0.5) / n, (i % n + 0.5) / n);
        quadric_surface_at(q, false, true, p, &at);
        sum += area_ratio(q, at.ng);
    }
    return object_area(q) * sum / (n * n);
}
