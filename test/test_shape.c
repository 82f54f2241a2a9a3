/* test_shape.c: triangles and quadrics: where rays meet them, what the surface there is like, how points are
 * sampled.
 *
 * Derivatives are compared with differences of neighbouring points, areas with known values and with the mean of
 * 1/pdf, samples with their density by chi-square. A density that forgets the transform must be rejected.
 */
#include "geometry/shape.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "base/stats.h"
#include "base/warp.h"
#include "helpers.h"
#include "tests.h"

static struct shape_group group_of(int material, int first_light)
{
    struct shape_group g = {0};
    g.material = material;
    g.alpha = g.shadow_alpha = -1;
    g.first_light = first_light;
    return g;
}

static bool near3(vec3 a, vec3 b, double tolerance) { return length(sub(a, b)) <= tolerance; }

static vec3 on_sphere(struct rng *r)
{
    double u1 = rng_uniform(r), u2 = rng_uniform(r);
    return warp_sphere(u1, u2);
}

/* --- triangles ---------------------------------------------------------------------------------------- */

static float corner[] = {0, 0, 0, 2, 0, 0, 0, 1, 0};
static float corner_normal[] = {0, 0, 1, 0.6f, 0, 0.8f, 0, -0.6f, 0.8f};
static float corner_uv[] = {0.5f, 0, 1, 0.25f, 0.25f, 1};
static uint32_t corner_index[] = {0, 1, 2};

/* One right triangle in the plane z = 0, sides 2 and 1. */
static int add_triangle(struct test *t, struct geometry *geo, bool with_n, bool with_uv, struct transform to_world,
                        bool reverse)
{
    struct mesh m = {corner, with_n ? corner_normal : NULL, with_uv ? corner_uv : NULL, corner_index, 3, 1, 0, 0, 0, 0};
    struct error err = {""};
    int group = shape_add_mesh(geo, &m, &to_world, group_of(7, 40), reverse, &err);
    CHECK(t, group == geo->n_groups - 1, "%s", err.text);
    return geo->group[group].first_prim;
}

static void check_triangle_hits(struct test *t)
{
    struct geometry geo = {0};
    add_triangle(t, &geo, false, false, transform_identity(), false);
    struct ray ray = {vec(0.5, 0.25, 3), vec(0, 0, -1), 0, HUGE_VAL, 0, 0};
    struct hit hit;
    CHECK(t, shape_intersect(&geo, 0, &ray, &hit) && hit.t == 3 && hit.prim == 0, "straight down");
    CHECK(t, fabs(hit.b1 - 0.25) < 1e-15 && fabs(hit.b2 - 0.25) < 1e-15, "barycentric %g %g", hit.b1, hit.b2);
    ray.tmax = 3;
    CHECK(t, !shape_intersect(&geo, 0, &ray, &hit), "the interval is open at tmax");
    ray.tmax = 4;
    ray.tmin = 3;
    CHECK(t, !shape_intersect(&geo, 0, &ray, &hit), "the interval is open at tmin");
    ray.tmin = 0;
    ray.o = vec(1.01, 0.5, 3);
    CHECK(t, !shape_intersect(&geo, 0, &ray, &hit), "past the long side");
    ray.o = vec(1, 0.5, 3);
    CHECK(t, shape_intersect(&geo, 0, &ray, &hit), "a point of an edge belongs to the triangle");
    ray.o = vec(-1, 0.2, 0);
    ray.d = vec(1, 0, 0);
    CHECK(t, !shape_intersect(&geo, 0, &ray, &hit), "edge-on it cannot be seen");
    geometry_free(&geo);
}

/* Hits from everywhere lie where the barycentric coordinates say, in the plane, at distance t. */
static void check_triangle_random(struct test *t, struct rng *r)
{
    int hits = 0;
    for (int i = 0; i < 500; i++) {
        struct geometry geo = {0};
        double size = pow(10, 6 * rng_uniform(r) - 3);
        struct transform place = transform_compose(
            transform_translate(mul(on_sphere(r), 10 * size)),
            transform_compose(transform_rotate(77, on_sphere(r)), transform_scale(size, size * rng_uniform(r), 1)));
        add_triangle(t, &geo, false, false, place, false);
        struct surface target, at;
        double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
        shape_sample(&geo, 0, u1, u2, &target, &pdf);
        vec3 o = add(target.p, mul(on_sphere(r), 20 * size));
        struct ray ray = {o, normalize(sub(target.p, o)), 0, HUGE_VAL, 0, 0};
        struct hit hit;
        if (!CHECK(t, shape_intersect(&geo, 0, &ray, &hit), "triangle %d is missed", i))
            continue;
        shape_surface(&geo, &hit, &ray, &at);
        CHECK(t, near3(at.p, target.p, 1e-9 * size), "triangle %d: %g from the target", i,
              length(sub(at.p, target.p)));
        CHECK(t, fabs(pdf * shape_area(&geo, 0) - 1) < 1e-12 && shape_pdf_a(&geo, 0, &at) == pdf, "pdf_a");
        /* a ray that leaves this point must not find the triangle again beyond 1e-8 of the scene's size */
        struct ray leave = {at.p, on_sphere(r), 1e-8 * 20 * size, HUGE_VAL, 0, 0};
        CHECK(t, fabs(dot(leave.d, at.ng)) < 1e-4 || !shape_intersect(&geo, 0, &leave, &hit), "it meets itself");
        hits++;
        geometry_free(&geo);
    }
    CHECK(t, hits == 500, "%d hits", hits);
}

static struct surface surface_at(const struct geometry *geo, int prim, double b1, double b2)
{
    struct hit hit = {0, b1, b2, prim};
    struct ray ray = {vec(0, 0, 0), vec(0, 0, 1), 0, 1, 0, 0};
    struct surface at;
    shape_surface(geo, &hit, &ray, &at);
    return at;
}

/* p and n are linear in (u,v): their values at two points must differ by the partials times the difference. */
static void check_triangle_partials(struct test *t)
{
    struct geometry geo = {0};
    int flat = add_triangle(t, &geo, false, true, transform_identity(), false);
    int plain = add_triangle(t, &geo, false, false, transform_identity(), false);
    int smooth = add_triangle(t, &geo, true, true, transform_identity(), false);
    struct surface a = surface_at(&geo, flat, 0.1, 0.2), b = surface_at(&geo, flat, 0.6, 0.3);
    vec3 moved = add(mul(a.dpdu, b.u - a.u), mul(a.dpdv, b.v - a.v));
    CHECK(t, near3(sub(b.p, a.p), moved, 1e-14), "dp/du, dp/dv of a flat triangle");
    CHECK(t, fabs(a.u - (0.7 * 0.5 + 0.1 + 0.2 * 0.25)) < 1e-12 && near3(a.ns, a.ng, 0), "u, ns");
    CHECK(t, a.material == 7 && a.light == 40 && length(a.dndu) == 0, "material, light, no curvature");
    a = surface_at(&geo, plain, 0.5, 0.25);
    CHECK(t, fabs(a.u - 0.75) < 1e-15 && fabs(a.v - 0.25) < 1e-15, "default (u,v) are (0,0), (1,0), (1,1)");
    CHECK(t, near3(a.dpdu, vec(2, 0, 0), 1e-15) && near3(a.dpdv, vec(-2, 1, 0), 1e-15), "default partials");
    a = surface_at(&geo, smooth, 0.2, 0.3);
    vec3 n = vec(0.2 * 0.6, -0.3 * 0.6, 0.5 + 0.5 * 0.8);
    CHECK(t, near3(a.ns, normalize(n), 1e-7) && near3(a.ng, vec(0, 0, 1), 1e-15), "interpolated normal");
    CHECK(t, fabs(dot(a.dpdu, a.ns)) < 1e-14 && fabs(dot(a.dpdv, a.ns)) < 1e-14, "tangents orthogonal to ns");
    b = surface_at(&geo, flat, 0.2, 0.3);
    CHECK(t, length(cross(sub(a.dpdu, b.dpdu), a.ns)) < 1e-14, "dp/du moves along ns only");
    CHECK(t, length(cross(sub(a.dpdv, b.dpdv), a.ns)) < 1e-14, "dp/dv moves along ns only");
    geometry_free(&geo);
}

/* Vertex normals of any length under any transform: they are interpolated as they come out of it, as in pbrt-v3, and
 * the partials of ns are its differences. */
static void check_vertex_normals(struct test *t, struct rng *r)
{
    const double h = 1e-5;
    for (int i = 0; i < 50; i++) {
        struct geometry geo = {0};
        struct error err = {""};
        struct transform m = random_affine(r);
        double b1 = 0.1 + 0.4 * rng_uniform(r), b2 = 0.1 + 0.3 * rng_uniform(r);
        float normal[9];
        vec3 n[3];
        for (int k = 0; k < 9; k++)
            normal[k] = corner_normal[k] * (float)(k / 3 + 1);
        struct mesh mesh = {corner, normal, corner_uv, corner_index, 3, 1, 0, 0, 0, 0};
        CHECK(t, shape_add_mesh(&geo, &mesh, &m, group_of(7, 40), false, &err) == 0, "%s", err.text);
        for (size_t k = 0; k < 3; k++)
            n[k] = load3(normal, k);
        struct surface at = surface_at(&geo, 0, b1, b2);
        vec3 want = normalize(transform_normal(&m, barycentric3(n, b1, b2)));
        CHECK(t, near3(at.ns, want, 1e-6), "transform %d: normal off by %g", i, length(sub(at.ns, want)));
        for (int k = 0; k < 2; k++) {
            struct surface a = surface_at(&geo, 0, b1 + (k ? 0 : h), b2 + (k ? h : 0));
            struct surface b = surface_at(&geo, 0, b1 - (k ? 0 : h), b2 - (k ? h : 0));
            vec3 dn = add(mul(at.dndu, a.u - b.u), mul(at.dndv, a.v - b.v)), moved = sub(a.ns, b.ns);
            CHECK(t, near3(dn, moved, 1e-4 * h + 1e-4 * length(moved)), "transform %d: dn/du, dn/dv", i);
        }
        geometry_free(&geo);
    }
}

static void check_degenerate_uv(struct test *t)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    struct error err;
    float same[] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    struct mesh m = {corner, corner_normal, same, corner_index, 3, 1, 0, 0, 0, 0};
    shape_add_mesh(&geo, &m, &id, group_of(0, -1), false, &err);
    m.N = NULL;
    shape_add_mesh(&geo, &m, &id, group_of(0, -1), false, &err);
    for (int i = 0; i < 2; i++) {
        struct surface at = surface_at(&geo, i, 0.3, 0.3);
        CHECK(t, length(cross(at.dpdu, at.dpdv)) > 0.5 && fabs(dot(at.dpdu, at.ns)) < 1e-12, "degenerate (u,v)");
        CHECK(t, is_finite3(at.dndu) && is_finite3(at.dndv) && at.light == -1, "finite derivatives");
    }
    geometry_free(&geo);
}

/* The one rule of orientation: the side stays with the object under any transform; ReverseOrientation turns it;
 * normals given by the mesh decide where there are any. */
static void check_triangle_orientation(struct test *t)
{
    struct transform plain = transform_identity(), mirror = transform_scale(-1, 1, 1);
    for (int i = 0; i < 8; i++) {
        struct geometry geo = {0};
        bool with_n = i & 1, mirrored = i & 2, reverse = i & 4;
        add_triangle(t, &geo, with_n, true, mirrored ? mirror : plain, reverse);
        struct surface at = surface_at(&geo, 0, 0.3, 0.3), sample;
        double pdf, up = reverse ? -1 : 1;
        CHECK(t, at.ng.z == up && at.ns.z * up > 0, "case %d: ng.z = %g, ns.z = %g", i, at.ng.z, at.ns.z);
        shape_sample(&geo, 0, 0.3, 0.3, &sample, &pdf);
        CHECK(t, sample.ng.z == at.ng.z, "case %d: sampled and hit points face different ways", i);
        geometry_free(&geo);
    }
}

static void check_mesh_refused(struct test *t)
{
    struct geometry geo = {0};
    struct mesh m = {corner, NULL, NULL, corner_index, 3, 1, 0, 0, 0, 0};
    struct error err = {""};
    struct transform far = transform_translate(vec(1e30, 0, 0));
    CHECK(t, shape_add_mesh(&geo, &m, &far, group_of(0, -1), false, &err) == -1, "a vertex at 1e30");
    CHECK(t, geo.n_triangles == 0 && geo.n_groups == 0 && strstr(err.text, "vertex 0") != NULL, "%s", err.text);
    geometry_free(&geo);
}

/* --- quadrics ----------------------------------------------------------------------------------------- */

/* Quadrics, whole and cut, some in a crooked space; the first seven can be sampled. */
enum { N_QUADRICS = 13, N_SAMPLED = 7 };

static struct quadric quadric(enum quadric_kind kind, struct transform to_world, double radius, double inner_radius,
                              double zmin, double zmax, double phi_max)
{
    struct quadric q = {.kind = kind, .to_world = to_world, .radius = radius, .zmin = zmin, .zmax = zmax};
    q.inner_radius = inner_radius;
    q.phi_max = phi_max;
    return q;
}

static struct quadric hyperboloid(struct transform to_world, vec3 p1, vec3 p2, double phi_max)
{
    struct quadric q = quadric(QUADRIC_HYPERBOLOID, to_world, 0, 0, 0, 0, phi_max);
    q.p1 = p1;
    q.p2 = p2;
    return q;
}

static struct quadric quadric_number(int i)
{
    struct transform id = transform_identity();
    struct transform turn =
        transform_compose(transform_translate(vec(1, 2, 3)), transform_rotate(50, vec(1, 2, -1)));
    struct transform skew = transform_compose(turn, transform_scale(1, 2, -0.5));
    struct quadric q[N_QUADRICS] = {
        quadric(QUADRIC_SPHERE, id, 2, 0, -2, 2, 2 * PI),
        quadric(QUADRIC_SPHERE, turn, 2, 0, -1, 1.5, 5),
        quadric(QUADRIC_DISK, turn, 1.5, 0, 0.25, 0.25, 2 * PI),
        quadric(QUADRIC_DISK, id, 1.5, 0.5, -1, -1, 4),
        quadric(QUADRIC_CYLINDER, turn, 0.5, 0, -1, 2, 2 * PI),
        quadric(QUADRIC_CYLINDER, skew, 0.5, 0, -1, 2, 3),
        quadric(QUADRIC_SPHERE, skew, 1, 0, -1, 1, 2 * PI),
        quadric(QUADRIC_CONE, turn, 1.5, 0, 0, 2, 2 * PI),
        quadric(QUADRIC_CONE, skew, 0.5, 0, 0, 1, 4),
        quadric(QUADRIC_PARABOLOID, turn, 1, 0, 0, 2, 2 * PI),
        quadric(QUADRIC_PARABOLOID, skew, 1.5, 0, 0.25, 1, 2),
        hyperboloid(turn, vec(1, -0.5, -1), vec(0.5, 1, 1.5), 2 * PI),
        hyperboloid(skew, vec(0.5, 0.3, 1), vec(1, 0.5, 0), 4),
    };
    return q[i];
}

static vec3 to_object(const struct quadric *q, vec3 p)
{
    struct transform back = transform_inverse(q->to_world);
    return transform_point(&back, p);
}

/* How far an object-space point is from the uncut quadric. */
static double distance_from(const struct quadric *q, vec3 p)
{
    double ring = sqrt(p.x * p.x + p.y * p.y);
    switch (q->kind) {
    case QUADRIC_SPHERE: return fabs(length(p) - q->radius);
    case QUADRIC_DISK: return fabs(p.z - q->zmin);
    case QUADRIC_CYLINDER: return fabs(ring - q->radius);
    case QUADRIC_CONE: return fabs(ring - q->radius * (1 - p.z / q->zmax));
    case QUADRIC_PARABOLOID: return fabs(ring * ring - q->radius * q->radius * p.z / q->zmax);
    case QUADRIC_HYPERBOLOID: {
        double v = (p.z - q->p1.z) / (q->p2.z - q->p1.z);
        vec3 from = lerp3(v, q->p1, q->p2);
        return fabs(ring - sqrt(from.x * from.x + from.y * from.y));
    }
    }
    return 1;
}

/* The point with parameters (u,v), written down independently of the module. */
static vec3 point_of(const struct quadric *q, double u, double v)
{
    double phi = u * q->phi_max, r = q->radius, z = q->zmin + v * (q->zmax - q->zmin);
    if (q->kind == QUADRIC_SPHERE) {
        double theta0 = acos(q->zmin / r), theta1 = acos(q->zmax / r), theta = theta0 + v * (theta1 - theta0);
        z = r * cos(theta);
        r = r * sin(theta);
    } else if (q->kind == QUADRIC_DISK) {
        r = r + v * (q->inner_radius - r);
    } else if (q->kind == QUADRIC_CONE) {
        r = r * (1 - v);
    } else if (q->kind == QUADRIC_PARABOLOID) {
        r = r * sqrt(z / q->zmax);
    } else if (q->kind == QUADRIC_HYPERBOLOID) {
        vec3 from = lerp3(v, q->p1, q->p2);
        struct transform turn = transform_rotate(phi * 180 / PI, vec(0, 0, 1));
        vec3 p = transform_point(&turn, from);
        return transform_point(&q->to_world, p);
    }
    return transform_point(&q->to_world, vec(r * cos(phi), r * sin(phi), z));
}

/* Aim at a known point from a random place: the first hit is on the quadric, no farther than the target. */
static void check_quadric_hits(struct test *t, const struct geometry *geo, int i, struct rng *r)
{
    const struct quadric *q = &geo->quadric[i];
    int prim = FIRST_QUADRIC + i;
    float lo[3], hi[3];
    shape_bounds(geo, prim, lo, hi);
    for (int k = 0; k < 300; k++) {
        vec3 target = point_of(q, rng_uniform(r), rng_uniform(r)), o = add(target, mul(on_sphere(r), 8));
        struct ray ray = {o, normalize(sub(target, o)), 0, HUGE_VAL, 0, 0};
        struct hit hit;
        struct surface at;
        if (!CHECK(t, shape_intersect(geo, prim, &ray, &hit), "quadric %d is missed", i))
            continue;
        CHECK(t, hit.t <= 8 + 1e-6 && hit.prim == prim, "quadric %d: hit at %g, behind the target", i, hit.t);
        shape_surface(geo, &hit, &ray, &at);
        CHECK(t, distance_from(q, to_object(q, at.p)) < 1e-14, "quadric %d: off the surface", i);
        CHECK(t, near3(at.p, add(ray.o, mul(ray.d, hit.t)), 1e-10), "quadric %d: off the ray", i);
        CHECK(t, near3(at.p, point_of(q, at.u, at.v), 1e-7), "quadric %d: (%g, %g) is another point", i, at.u,
              at.v);
        CHECK(t, at.u >= 0 && at.u <= 1 && at.v >= -1e-9 && at.v <= 1 + 1e-9, "quadric %d: cut off", i);
        bool boxed = at.p.x >= lo[0] && at.p.x <= hi[0] && at.p.y >= lo[1] && at.p.y <= hi[1] && at.p.z >= lo[2] &&
                     at.p.z <= hi[2];
        CHECK(t, boxed, "quadric %d: outside its bounds", i);
        struct ray leave = {at.p, on_sphere(r), 1e-7, 1e-3, 0, 0};
        CHECK(t, fabs(dot(leave.d, at.ng)) < 0.05 || !shape_intersect(geo, prim, &leave, &hit), "it meets itself");
    }
}

/* Rays that end on a quadric do not meet it there, and rays that leave it do not meet it at once, however they graze
 * it, whatever its size, shape and place, and with no margin: what is left is the other meeting, if there is one. */
static void check_own_quadric(struct test *t, int i, struct rng *r)
{
    struct geometry geo = {0};
    struct hit hit, next, again;
    struct surface at;
    double size = pow(10, 9 * rng_uniform(r) - 3);
    struct quadric q = quadric_number(i);
    q.to_world = transform_compose(transform_translate(mul(on_sphere(r), size)),
                                   transform_compose(random_affine(r), transform_scale(size, size, size)));
    CHECK(t, shape_add_quadric(&geo, q, group_of(0, -1), false, NULL) == 0, "quadric %d", i);
    for (int k = 0; k < 100; k++) {
        vec3 target = point_of(&q, rng_uniform(r), rng_uniform(r)), o = add(target, mul(on_sphere(r), 9 * size));
        struct ray ray = {o, normalize(sub(target, o)), 0, HUGE_VAL, 0, 0};
        if (!CHECK(t, shape_intersect(&geo, FIRST_QUADRIC, &ray, &hit), "quadric %d is missed", i))
            continue;
        shape_surface(&geo, &hit, &ray, &at);
        struct ray arrive = {o, ray.d, 0, length(sub(at.p, o)), 0, shape_triangle_id(FIRST_QUADRIC)};
        CHECK(t, !shape_intersect(&geo, FIRST_QUADRIC, &arrive, &again), "quadric %d stands before itself", i);
        double cosine = pow(10, -5 * rng_uniform(r));
        vec3 along = normalize(cross(at.ng, on_sphere(r)));
        struct ray leave = {at.p, normalize(add(along, mul(at.ng, cosine))), 0, HUGE_VAL,
                            shape_triangle_id(FIRST_QUADRIC), 0};
        double blur = 1e-7 * size + 1e-10 * length(at.p);
        struct ray beyond = {at.p, leave.d, blur, HUGE_VAL, 0, 0};
        bool met = shape_intersect(&geo, FIRST_QUADRIC, &leave, &next);
        CHECK(t, met == shape_intersect(&geo, FIRST_QUADRIC, &beyond, &again) &&
                     (!met || fabs(next.t - again.t) <= blur),
              "quadric %d of size %g meets itself: %d at %g, cosine %g", i, size, met, met ? next.t : again.t, cosine);
    }
    geometry_free(&geo);
}

/* Derivatives against central differences. */
static void check_quadric_partials(struct test *t, const struct geometry *geo, int i, struct rng *r)
{
    const struct quadric *q = &geo->quadric[i];
    const double h = 1e-5;
    for (int k = 0; k < 50; k++) {
        double u = 0.1 + 0.8 * rng_uniform(r), v = 0.1 + 0.8 * rng_uniform(r);
        struct surface at, step[4];
        for (int m = 0; m < 5; m++) {
            double du = m == 0 ? h : m == 1 ? -h : 0, dv = m == 2 ? h : m == 3 ? -h : 0;
            quadric_surface_at(q, false, to_object(q, point_of(q, u + du, v + dv)), m < 4 ? &step[m] : &at);
        }
        vec3 dpdu = mul(sub(step[0].p, step[1].p), 0.5 / h), dpdv = mul(sub(step[2].p, step[3].p), 0.5 / h);
        vec3 dndu = mul(sub(step[0].ns, step[1].ns), 0.5 / h), dndv = mul(sub(step[2].ns, step[3].ns), 0.5 / h);
        CHECK(t, near3(at.dpdu, dpdu, 1e-5 * (1 + length(dpdu))), "quadric %d: dp/du", i);
        CHECK(t, near3(at.dpdv, dpdv, 1e-5 * (1 + length(dpdv))), "quadric %d: dp/dv", i);
        CHECK(t, near3(at.dndu, dndu, 1e-4 * (1 + length(dndu))), "quadric %d: dn/du", i);
        CHECK(t, near3(at.dndv, dndv, 1e-4 * (1 + length(dndv))), "quadric %d: dn/dv", i);
        CHECK(t, fabs(dot(at.ng, dpdu)) < 1e-4 && fabs(dot(at.ng, dpdv)) < 1e-4, "quadric %d: normal", i);
    }
}

/* Bounds beyond what a box can hold are refused, by whatever they get there. */
static void check_quadric_refused(struct test *t)
{
    struct quadric q[] = {quadric(QUADRIC_DISK, transform_identity(), 2e38, 0, 0, 0, 2 * PI),
                          quadric(QUADRIC_CYLINDER, transform_identity(), 1, 0, -1, 1e39, 2 * PI),
                          quadric(QUADRIC_CYLINDER, transform_identity(), 1, 0, -1, 3e18, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_translate(vec(0, 1e51, 0)), 1, 0, -1, 1, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_scale(1, 1, 1e19), 1, 0, -1, 1, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_translate(vec(NAN, 0, 0)), 1, 0, -1, 1, 2 * PI)};
    for (size_t i = 0; i < sizeof q / sizeof q[0]; i++) {
        struct geometry geo = {0};
        struct error err = {""};
        CHECK(t, shape_add_quadric(&geo, q[i], group_of(0, -1), false, &err) == -1 && geo.n_quadrics == 0,
              "quadric %d was taken", (int)i);
        CHECK(t, strstr(err.text, "not a usable position") != NULL, "\"%s\"", err.text);
        geometry_free(&geo);
    }
}

/* Outwards, whatever the transform; ReverseOrientation inwards. */
static void check_quadric_orientation(struct test *t)
{
    for (int i = 0; i < 4; i++) {
        struct geometry geo = {0};
        struct quadric q = quadric(QUADRIC_SPHERE, transform_scale(i & 1 ? -1 : 1, 1, 1), 1, 0, -1, 1, 2 * PI);
        shape_add_quadric(&geo, q, group_of(3, 9), i & 2, NULL);
        struct ray ray = {vec(0, 0, 5), vec(0, 0, -1), 0, HUGE_VAL, 0, 0};
        struct hit hit;
        struct surface at, sample;
        double pdf, out = i & 2 ? -1 : 1;
        CHECK(t, shape_intersect(&geo, FIRST_QUADRIC, &ray, &hit) && fabs(hit.t - 4) < 1e-14, "sphere from above");
        shape_surface(&geo, &hit, &ray, &at);
        shape_sample(&geo, FIRST_QUADRIC, 0.2, 0.3, &sample, &pdf);
        CHECK(t, near3(at.ng, vec(0, 0, out), 1e-12), "case %d: normal", i);
        CHECK(t, dot(sample.ng, sample.p) * out > 0.999, "case %d: normal of a sampled point", i);
        CHECK(t, at.material == 3 && at.light == 9 && is_finite3(at.dpdu),
              "material and light; the pole's tangent");
        geometry_free(&geo);
    }
}

/* Where formulas divide by the distance from the axis: rays at the tip of a cone, the vertex of a paraboloid and where
 * a hyperboloid is a double cone. Lines along the axis and, on a cone, along its slope. */
static void check_quadric_tips(struct test *t)
{
    struct transform id = transform_identity();
    struct quadric q[3] = {quadric(QUADRIC_CONE, id, 1, 0, 0, 1, 2 * PI),
                           quadric(QUADRIC_PARABOLOID, id, 1, 0, 0, 1, 2 * PI),
                           hyperboloid(id, vec(-1, 0, -1), vec(1, 0, 1), 2 * PI)};
    const vec3 tip[3] = {vec(0, 0, 1), vec(0, 0, 0), vec(0, 0, 0)};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            struct geometry geo = {0};
            struct hit hit;
            struct surface at;
            vec3 d = normalize(k == 0 ? vec(0, 0, -1) : k == 1 ? vec(1, 0, -1) : vec(0.3, 0.2, -1));
            struct ray ray = {sub(tip[i], mul(d, 2)), d, 0, HUGE_VAL, 0, 0};
            shape_add_quadric(&geo, q[i], group_of(0, -1), false, NULL);
            if (shape_intersect(&geo, FIRST_QUADRIC, &ray, &hit)) {
                shape_surface(&geo, &hit, &ray, &at);
                CHECK(t, is_finite3(at.ng) && is_finite3(at.dpdu) && is_finite3(at.dpdv) && is_finite3(at.dndu) &&
                             is_finite3(at.dndv), "tip of quadric %d, ray %d", i, k);
            }
            CHECK(t, k < 2 || near3(add(ray.o, mul(ray.d, hit.t)), tip[i], 1e-7), "tip %d is missed", i);
            geometry_free(&geo);
        }
    struct geometry geo = {0};
    shape_add_quadric(&geo, q[0], group_of(0, -1), false, NULL);
    struct ray slope = {vec(-0.5, 0, 1), normalize(vec(1, 0, -1)), 0, HUGE_VAL, 0, 0};
    struct ray above = {vec(0, 0, 2), normalize(vec(-1, 0, -1)), 0, HUGE_VAL, 0, 0};
    struct hit hit;
    CHECK(t, shape_intersect(&geo, FIRST_QUADRIC, &slope, &hit) && fabs(hit.t - 0.25 * sqrt(2)) < 1e-14,
          "a line along the slope meets the cone once");
    CHECK(t, !shape_intersect(&geo, FIRST_QUADRIC, &above, &hit), "the cone's other half is not there");
    geometry_free(&geo);
}

/* --- sampling ----------------------------------------------------------------------------------------- */

/* Chi-square over equal steps of u and v: expected counts from the area of each patch, in object space or, weighed
 * with the density, in the world. `forget` leaves the transform out of the density, which must be noticed. */
static double sample_p(const struct geometry *geo, int prim, bool forget, struct rng *r, double *area)
{
    enum { N = 12, DRAWS = 40000, FINE = 6 };
    const struct quadric *q = &geo->quadric[prim - FIRST_QUADRIC];
    double observed[N * N] = {0}, expected[N * N] = {0}, inverse_sum = 0, whole = shape_area(geo, prim);
    for (int i = 0; i < DRAWS; i++) {
        struct surface at;
        double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
        shape_sample(geo, prim, u1, u2, &at, &pdf);
        int a = (int)clamp(at.u * N, 0, N - 1), b = (int)clamp(at.v * N, 0, N - 1);
        observed[a * N + b]++;
        inverse_sum += 1 / pdf;
    }
    *area = inverse_sum / DRAWS;
    for (int i = 0; i < N * FINE; i++)
        for (int k = 0; k < N * FINE; k++) {
            struct surface at;
            double u = (i + 0.5) / (N * FINE), v = (k + 0.5) / (N * FINE);
            quadric_surface_at(q, false, to_object(q, point_of(q, u, v)), &at);
            double patch = length(cross(at.dpdu, at.dpdv)) / (N * FINE * N * FINE);
            double pdf = forget ? 1 / whole : shape_pdf_a(geo, prim, &at);
            expected[i / FINE * N + k / FINE] += DRAWS * patch * pdf;
        }
    return stats_chi2_test(observed, expected, N * N);
}

static void check_sampling(struct test *t, const struct geometry *geo, struct rng *r)
{
    for (int i = 0; i < N_SAMPLED; i++) {
        double area;
        double p = sample_p(geo, FIRST_QUADRIC + i, false, r, &area);
        TEST_ACCEPT(t, p, "samples of quadric %d follow shape_pdf_a", i);
        double want = shape_area(geo, FIRST_QUADRIC + i);
        CHECK(t, fabs(area / want - 1) < 0.01, "quadric %d: area %g, mean of 1/pdf %g", i, want, area);
    }
    double ignored;
    TEST_REJECT(t, sample_p(geo, FIRST_QUADRIC + 6, true, r, &ignored),
                "a density without the transform's stretch");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC) - 16 * PI) < 1e-9, "area of a sphere");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC + 2) - PI * 2.25) < 1e-9, "area of a disk");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC + 4) - 3 * PI) < 1e-9, "area of a cylinder");
}

/* A triangle's samples, in barycentric coordinates: uniform over the 45-degree triangle, by quarters of its area.
 */
static void check_triangle_sampling(struct test *t, struct rng *r)
{
    struct geometry geo = {0};
    double count[4] = {0}, expected[4] = {10000, 10000, 10000, 10000}, skewed[4] = {0};
    add_triangle(t, &geo, false, false, transform_identity(), false);
    CHECK(t, shape_area(&geo, 0) == 1, "area %g", shape_area(&geo, 0));
    for (int i = 0; i < 40000; i++) {
        struct surface at;
        double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
        shape_sample(&geo, 0, u1, u2, &at, &pdf);
        double b1 = at.p.x / 2, b2 = at.p.y;
        count[b1 > 0.5 ? 0 : b2 > 0.5 ? 1 : b1 + b2 < 0.5 ? 2 : 3]++;
        b1 = 1 - u1;
        b2 = u2 * u1; /* without the square root */
        skewed[b1 > 0.5 ? 0 : b2 > 0.5 ? 1 : b1 + b2 < 0.5 ? 2 : 3]++;
    }
    TEST_ACCEPT(t, stats_chi2_test(count, expected, 4), "samples of a triangle are uniform");
    TEST_REJECT(t, stats_chi2_test(skewed, expected, 4), "samples crowded into a corner");
    geometry_free(&geo);
}

void test_shape(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 102, 0);
    struct geometry quadrics = {0};
    check_triangle_hits(t);
    check_triangle_random(t, &r);
    check_triangle_partials(t);
    check_vertex_normals(t, &r);
    check_degenerate_uv(t);
    check_triangle_orientation(t);
    check_mesh_refused(t);
    check_quadric_refused(t);
    check_triangle_sampling(t, &r);
    for (int i = 0; i < N_QUADRICS; i++)
        shape_add_quadric(&quadrics, quadric_number(i), group_of(0, -1), false, NULL);
    for (int i = 0; i < N_QUADRICS; i++) {
        check_quadric_hits(t, &quadrics, i, &r);
        check_own_quadric(t, i, &r);
        check_quadric_partials(t, &quadrics, i, &r);
    }
    check_quadric_orientation(t);
    check_quadric_tips(t);
    check_sampling(t, &quadrics, &r);
    geometry_free(&quadrics);
}
