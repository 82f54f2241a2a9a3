/* test_shape.c: triangles and quadrics: where rays meet them, the surface there, and how points are sampled.
 *
 * Derivatives are compared with differences of neighbouring points, areas with known values and sums of patches,
 * samples with their density by chi-square. A density that forgets the transform must be rejected.
 */
#include "geometry/shape.h"

#include <string.h>

#include "base/rng.h"
#include "lab/stats.h"
#include "helpers.h"
#include "suites.h"

/* --- triangles ---------------------------------------------------------------------------------------- */

static vec3 corner[] = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
static float corner_normal[] = {0, 0, 1, 0.6f, 0, 0.8f, 0, -0.6f, 0.8f};
static float corner_uv[] = {0.5f, 0, 1, 0.25f, 0.25f, 1};
static uint32_t corner_index[] = {0, 1, 2};

/* One right triangle in the plane z = 0, sides 2 and 1. */
static int add_triangle(struct test *t, struct geometry *geo, bool with_n, bool with_uv, struct transform to_world,
                        bool reverse)
{
    struct mesh m = {.P = corner, .N = with_n ? corner_normal : NULL, .UV = with_uv ? corner_uv : NULL,
                     .index = corner_index, .n_vertices = 3, .n_triangles = 1};
    struct error err = {.text = ""};
    int group = shape_add_mesh(geo, &m, &to_world, group_of(7, 40), reverse, &err);
    CHECK(t, group == geo->n_groups - 1, "%s", err.text);
    return geo->group[group].first_prim;
}

static void check_triangle_hits(struct test *t)
{
    static const struct {
        struct ray ray;
        bool hit;
        const char *why;
    } CASES[] = {
        {{{0.5, 0.25, 3}, {0, 0, -1}, 0, 3, 0, 0}, false, "the interval is open at tmax"},
        {{{0.5, 0.25, 3}, {0, 0, -1}, 3, 4, 0, 0}, false, "the interval is open at tmin"},
        {{{1.01, 0.5, 3}, {0, 0, -1}, 0, 4, 0, 0}, false, "past the long side"},
        {{{1, 0.5, 3}, {0, 0, -1}, 0, 4, 0, 0}, true, "a point of an edge belongs to the triangle"},
        {{{-1, 0.2, 0}, {1, 0, 0}, 0, 4, 0, 0}, false, "edge-on it cannot be seen"},
        {{{0.5, 0.25, 3}, {0, 0, -1}, 0, 4, 0, 0}, true, "straight down"},
    };
    struct geometry geo = {0};
    struct hit hit = {0, 0, 0, -1, 0};
    add_triangle(t, &geo, false, false, transform_identity(), false);
    for (int i = 0; i < 6; i++)
        CHECK(t, shape_intersect(&geo, 0, &CASES[i].ray, &hit) == CASES[i].hit, "%s", CASES[i].why);
    CHECK(t, hit.t == 3 && hit.prim == 0 && fabs(hit.b1 - 0.25) < 1e-15 && fabs(hit.b2 - 0.25) < 1e-15,
          "at %g, barycentric %g %g", hit.t, hit.b1, hit.b2);
    geometry_free(&geo);
}

/* A ray from o to where something is. */
static struct ray ray_at(vec3 o, vec3 target)
{
    struct ray ray = {o, normalize(sub(target, o)), 0, HUGE_VAL, 0, 0};
    return ray;
}

/* Hits from everywhere lie where the barycentric coordinates say, in the plane, at distance t. */
static void check_triangle_random(struct test *t, struct rng *r)
{
    for (int i = 0; i < 500; i++) {
        struct geometry geo = {0};
        double size = pow(10, 6 * rng_uniform(r) - 3);
        struct transform place = transform_compose(
            transform_translate(mul(on_sphere(r), 10 * size)),
            transform_compose(transform_rotate(77, on_sphere(r)), transform_scale(size, size * rng_uniform(r), 1)));
        add_triangle(t, &geo, false, false, place, false);
        struct surface target, at;
        struct hit hit = {0};
        double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
        shape_sample(&geo, 0, u1, u2, &target, &pdf);
        struct ray ray = ray_at(add(target.p, mul(on_sphere(r), 20 * size)), target.p);
        if (CHECK(t, shape_intersect(&geo, 0, &ray, &hit), "triangle %d is missed", i)) {
            shape_surface(&geo, &hit, &ray, &at);
            CHECK(t, near3(at.p, target.p, 1e-9 * size), "triangle %d is off by %g", i, length(sub(at.p, target.p)));
            CHECK(t, fabs(pdf * shape_area(&geo, 0) - 1) < 1e-12 && shape_pdf_a(&geo, 0, &at) == pdf, "pdf_a");
        }
        geometry_free(&geo);
    }
}

/* p is linear in (u,v): its values at two points must differ by the partials times the difference. */
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
    b = surface_at(&geo, flat, 0.2, 0.3);
    CHECK(t, near3(a.ng, vec(0, 0, 1), 1e-15) && fabs(dot(a.dpdu, a.ns)) + fabs(dot(a.dpdv, a.ns)) < 1e-14 &&
                 length(cross(sub(a.dpdu, b.dpdu), a.ns)) < 1e-14 && length(cross(sub(a.dpdv, b.dpdv), a.ns)) < 1e-14,
          "tangents are those of the flat triangle, projected");
    geometry_free(&geo);
}

/* --- quadrics ----------------------------------------------------------------------------------------- */

/* Quadrics, whole and cut, some in a crooked space; the first seven can be sampled. */
enum { N_QUADRICS = 13, N_SAMPLED = 7 };

static struct quadric quadric(enum quadric_kind kind, struct transform to_world, double radius, double inner_radius,
                              double zmin, double zmax, double phi_max)
{
    struct quadric q = {kind, to_world, radius, inner_radius, zmin, zmax, phi_max, 0, {0, 0, 0}, {0, 0, 0}};
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
    struct transform turn = transform_compose(transform_translate(vec(1, 2, 3)), transform_rotate(50, vec(1, 2, -1)));
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
        phi += atan2(from.y, from.x);
        r = sqrt(sqr(from.x) + sqr(from.y));
        z = from.z;
    }
    return transform_point(&q->to_world, vec(r * cos(phi), r * sin(phi), z));
}

/* Aim at a known point from a random place, whatever the quadric's size, shape and place: the first hit is on the
 * quadric, no farther than the target. Rays that end there do not meet it there, and rays that leave it do not meet it
 * at once, however they graze it, with no margin: what is left is the other meeting, if there is one. */
static void check_quadric_rays(struct test *t, int i, struct rng *r)
{
    enum { PRIM = FIRST_QUADRIC };
    struct geometry geo = {0};
    struct hit hit, next, again;
    struct surface at;
    float lo[3], hi[3];
    double size = pow(10, 9 * rng_uniform(r) - 3);
    struct quadric q = quadric_number(i);
    q.to_world = transform_compose(transform_translate(mul(on_sphere(r), size)),
                                   transform_compose(random_affine(r), transform_scale(size, size, size)));
    CHECK(t, shape_add_quadric(&geo, q, group_of(0, -1), false, NULL) == 0, "quadric %d", i);
    shape_bounds(&geo, PRIM, lo, hi);
    for (int k = 0; k < 300; k++) {
        vec3 target = point_of(geo.quadric, rng_uniform(r), rng_uniform(r));
        struct ray ray = ray_at(add(target, mul(on_sphere(r), 9 * size)), target);
        if (!CHECK(t, shape_intersect(&geo, PRIM, &ray, &hit), "quadric %d is missed", i))
            continue;
        shape_surface(&geo, &hit, &ray, &at);
        double blur = 1e-7 * size + 1e-10 * length(at.p);
        CHECK(t, hit.t <= 9 * size + blur && hit.prim == PRIM, "quadric %d: hit at %g of %g", i, hit.t, 9 * size);
        CHECK(t, near3(at.p, add(ray.o, mul(ray.d, hit.t)), 0.001 * blur), "quadric %d: off the ray", i);
        CHECK(t, near3(at.p, point_of(geo.quadric, at.u, at.v), 10 * blur) && at.u >= 0 && at.u <= 1 && at.v >= -1e-9 &&
                     at.v <= 1 + 1e-9, "quadric %d: (%g, %g) is another point", i, at.u, at.v);
        CHECK(t, at.p.x >= lo[0] && at.p.x <= hi[0] && at.p.y >= lo[1] && at.p.y <= hi[1] && at.p.z >= lo[2] &&
                     at.p.z <= hi[2], "quadric %d: outside its bounds", i);
        struct ray arrive = {ray.o, ray.d, 0, length(sub(at.p, ray.o)), 0, shape_prim_id(PRIM, 0)};
        CHECK(t, !shape_intersect(&geo, PRIM, &arrive, &again), "quadric %d stands before itself", i);
        double cosine = pow(10, -5 * rng_uniform(r));
        vec3 along = normalize(cross(at.ng, on_sphere(r)));
        struct ray leave = {at.p, normalize(add(along, mul(at.ng, cosine))), 0, HUGE_VAL, shape_prim_id(PRIM, 0), 0};
        struct ray beyond = {at.p, leave.d, blur, HUGE_VAL, 0, 0};
        bool met = shape_intersect(&geo, PRIM, &leave, &next);
        CHECK(t, met == shape_intersect(&geo, PRIM, &beyond, &again) && (!met || fabs(next.t - again.t) <= blur),
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
            vec3 p = transform_point_back(&q->to_world, point_of(q, u + du, v + dv));
            quadric_surface_at(q, false, false, p, m < 4 ? &step[m] : &at);
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

/* What lies beyond any place is refused, however it gets there. */
static void check_refused(struct test *t)
{
    struct quadric q[] = {quadric(QUADRIC_DISK, transform_identity(), 2e38, 0, 0, 0, 2 * PI),
                          quadric(QUADRIC_CYLINDER, transform_identity(), 1, 0, -1, 1e39, 2 * PI),
                          quadric(QUADRIC_CYLINDER, transform_identity(), 1, 0, -1, 3e18, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_translate(vec(0, 1e51, 0)), 1, 0, -1, 1, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_scale(1, 1, 1e19), 1, 0, -1, 1, 2 * PI),
                          quadric(QUADRIC_SPHERE, transform_translate(vec(NAN, 0, 0)), 1, 0, -1, 1, 2 * PI)};
    struct geometry geo = {0};
    struct error err = {.text = ""};
    for (size_t i = 0; i < sizeof q / sizeof q[0]; i++)
        CHECK(t, shape_add_quadric(&geo, q[i], group_of(0, -1), false, &err) == -1 && geo.n_quadrics == 0 &&
                     strstr(err.text, "places go up to 1e12") != NULL, "quadric %d: \"%s\"", (int)i, err.text);
    struct mesh m = {.P = corner, .N = NULL, .UV = NULL, .index = corner_index, .n_vertices = 3, .n_triangles = 1};
    struct transform far = transform_translate(vec(1e30, 0, 0));
    CHECK(t, shape_add_mesh(&geo, &m, &far, group_of(0, -1), false, &err) == -1 && geo.n_triangles == 0 &&
                 geo.n_groups == 0 && strstr(err.text, "vertex 0") != NULL, "a vertex at 1e30: %s", err.text);
    geometry_free(&geo);
}

/* The one rule of orientation: the side stays with the object under any transform; ReverseOrientation turns it;
 * normals given by a mesh decide where there are any. */
static void check_orientation(struct test *t)
{
    for (int i = 0; i < 8; i++) {
        struct geometry geo = {0};
        bool with_n = i & 1, reverse = i & 4;
        struct transform place = transform_scale(i & 2 ? -1 : 1, 1, 1);
        double pdf, up = reverse ? -1 : 1;
        add_triangle(t, &geo, with_n, true, place, reverse);
        struct surface at = surface_at(&geo, 0, 0.3, 0.3), sample;
        CHECK(t, at.ng.z == up && at.ns.z * up > 0, "case %d: ng.z = %g, ns.z = %g", i, at.ng.z, at.ns.z);
        shape_sample(&geo, 0, 0.3, 0.3, &sample, &pdf);
        CHECK(t, sample.ng.z == at.ng.z, "case %d: sampled and hit points face different ways", i);
        shape_add_quadric(&geo, quadric(QUADRIC_SPHERE, place, 1, 0, -1, 1, 2 * PI), group_of(3, 9), reverse, NULL);
        const struct hit hit = {4, 0, 0, FIRST_QUADRIC, 0};
        const struct ray ray = ray_at(vec(0, 0, 5), vec(0, 0, 0));
        shape_surface(&geo, &hit, &ray, &at);
        shape_sample(&geo, FIRST_QUADRIC, 0.2, 0.3, &sample, &pdf);
        CHECK(t, near3(at.ng, vec(0, 0, up), 1e-12) && dot(sample.ng, sample.p) * up > 0.999, "case %d: a ball", i);
        CHECK(t, at.material == 3 && at.light == 9 && is_finite3(at.dpdu), "case %d: the pole's tangent", i);
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
    struct geometry geo = {0};
    struct hit hit;
    struct surface at;
    for (int i = 0; i < 9; i++) {
        int number = i / 3, k = i % 3, prim = FIRST_QUADRIC + number;
        vec3 d = normalize(k == 0 ? vec(0, 0, -1) : k == 1 ? vec(1, 0, -1) : vec(0.3, 0.2, -1));
        struct ray ray = {sub(tip[number], mul(d, 2)), d, 0, HUGE_VAL, 0, 0};
        if (k == 0)
            shape_add_quadric(&geo, q[number], group_of(0, -1), false, NULL);
        bool met = shape_intersect(&geo, prim, &ray, &hit);
        if (met) {
            shape_surface(&geo, &hit, &ray, &at);
            CHECK(t, is_finite3(at.ng) && is_finite3(at.dpdu) && is_finite3(at.dpdv) && is_finite3(at.dndu) &&
                         is_finite3(at.dndv), "tip of quadric %d, ray %d", number, k);
        }
        /* A double cone met in nothing but its tip may be missed. */
        CHECK(t, k < 2 || (met ? near3(at.p, tip[number], 1e-7) : number == 2), "tip %d is missed", number);
    }
    struct ray slope = ray_at(vec(-0.5, 0, 1), vec(0.5, 0, 0)), above = ray_at(vec(0, 0, 2), vec(-1, 0, 1));
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
    double observed[N * N] = {0}, expected[N * N] = {0}, whole = shape_area(geo, prim);
    for (int i = 0; i < DRAWS; i++) {
        struct surface at;
        double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
        shape_sample(geo, prim, u1, u2, &at, &pdf);
        int a = (int)clamp(at.u * N, 0, N - 1), b = (int)clamp(at.v * N, 0, N - 1);
        observed[a * N + b]++;
    }
    *area = 0;
    for (int i = 0; i < N * FINE; i++)
        for (int k = 0; k < N * FINE; k++) {
            struct surface at;
            double u = (i + 0.5) / (N * FINE), v = (k + 0.5) / (N * FINE);
            quadric_surface_at(q, false, false, transform_point_back(&q->to_world, point_of(q, u, v)), &at);
            double patch = length(cross(at.dpdu, at.dpdv)) / (N * FINE * N * FINE);
            *area += patch;
            double pdf = forget ? 1 / whole : shape_pdf_a(geo, prim, &at);
            expected[i / FINE * N + k / FINE] += DRAWS * patch * pdf;
        }
    return stats_chi2_test(observed, expected, N * N);
}

static void check_sampling(struct test *t, const struct geometry *geo, struct rng *r)
{
    for (int i = 0; i < N_SAMPLED; i++) {
        double area, p = sample_p(geo, FIRST_QUADRIC + i, false, r, &area);
        TEST_ACCEPT(t, p, "samples of quadric %d follow shape_pdf_a", i);
        double want = shape_area(geo, FIRST_QUADRIC + i);
        CHECK(t, fabs(area / want - 1) < 1e-3, "quadric %d: area %g, of patches %g", i, want, area);
    }
    double ignored;
    TEST_REJECT(t, sample_p(geo, FIRST_QUADRIC + 6, true, r, &ignored), "a density without the transform's stretch");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC) - 16 * PI) < 1e-9, "area of a sphere");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC + 2) - PI * 2.25) < 1e-9, "area of a disk");
    CHECK(t, fabs(shape_area(geo, FIRST_QUADRIC + 4) - 3 * PI) < 1e-9, "area of a cylinder");
}

void test_shape(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 102, 0);
    struct geometry quadrics = {0};
    check_triangle_hits(t);
    check_triangle_random(t, &r);
    check_triangle_partials(t);
    check_refused(t);
    for (int i = 0; i < N_QUADRICS; i++) {
        shape_add_quadric(&quadrics, quadric_number(i), group_of(0, -1), false, NULL);
        check_quadric_rays(t, i, &r);
        check_quadric_partials(t, &quadrics, i, &r);
    }
    check_orientation(t);
    check_quadric_tips(t);
    check_sampling(t, &quadrics, &r);
    geometry_free(&quadrics);
}
