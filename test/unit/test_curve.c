/* test_curve.c: curves: points and normals of their nets against closed forms, and where rays meet them against a mesh
 * of the same triangles.
 */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "geometry/mesh.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "kd_parts.h"
#include "suites.h"

enum { ENOUGH = 1 << 23, RING = CURVE_SIDES };

/* What a scene file says of a curve; a ribbon if it has normals. */
struct told {
    const double *P;
    int n, degree;
    bool bspline;
    double width[2];
    const double *N;
};

/* By the row of "curve", with room for so many bytes. */
static bool curve_mesh(const struct told *c, struct mesh *m, double most, struct error *err)
{
    struct shape_fields f = shape_fields_of("curve");
    struct field_list P = {c->P, c->n}, N = {c->N, (c->n - 1) / c->degree + 1};
    int basis = c->bspline, type = c->N != NULL ? 1 : 2;
    shape_fields_set(&f, "P", &P, sizeof P);
    shape_fields_set(&f, "N", &N, sizeof N);
    shape_fields_set(&f, "degree", &c->degree, sizeof c->degree);
    shape_fields_set(&f, "basis", &basis, sizeof basis);
    shape_fields_set(&f, "type", &type, sizeof type);
    shape_fields_set(&f, "width0", &c->width[0], sizeof c->width[0]);
    shape_fields_set(&f, "width1", &c->width[1], sizeof c->width[1]);
    return shape_fields_mesh(&f, most, m, err);
}

/* Add it to the geometry. */
static void draw(struct test *t, const struct told *c, struct transform to_world, bool reverse, struct geometry *geo)
{
    struct mesh m = {0};
    struct error err = {.text = ""};
    CHECK(t, curve_mesh(c, &m, ENOUGH, &err), "%s", err.text);
    CHECK(t, shape_add_mesh(geo, &m, &to_world, group_of(0, -1), reverse, &err) == geo->n_groups - 1, "%s", err.text);
    mesh_free(&m);
}

static struct geometry geometry_with(struct test *t, const struct told *c)
{
    struct geometry geo = {0};
    draw(t, c, transform_identity(), false, &geo);
    return geo;
}

/* --- the net ------------------------------------------------------------------------------------------------ */

static int columns_of(const struct geometry *geo, int i) { return geo->curves.curve[i].net.ribbon ? 1 : RING; }
static int pieces_of(const struct geometry *geo, int i) { return geo->curves.curve[i].net.pieces; }

/* A corner of the net of a curve. */
static struct surface corner_of(const struct geometry *geo, int curve, int row, int column)
{
    return surface_at(geo, FIRST_CURVE + curve, row, column);
}

static vec3 row_centre(const struct geometry *geo, int curve, int row)
{
    vec3 sum = vec(0, 0, 0);
    for (int i = 0; i < RING; i++)
        sum = add(sum, corner_of(geo, curve, row, i).p);
    return mul(sum, 1.0 / RING);
}

/* A straight tube of growing width: how wide it looks from all sides on average, its normals, u and v. */
static void straight(struct test *t)
{
    const double P[] = {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3};
    struct told c = {.P = P, .n = 4, .degree = 3, .width = {0.2, 0.4}};
    struct geometry geo = geometry_with(t, &c);
    CHECK(t, geo.curves.n == 1 && pieces_of(&geo, 0) == 1, "one piece");
    double mean = 0;
    enum { VIEWS = 1000 };
    for (int k = 0; k < VIEWS; k++) {
        double most = 0, least = 0;
        for (int i = 0; i < RING; i++) {
            double x = dot(corner_of(&geo, 0, 0, i).p, vec(cos(PI * k / VIEWS), sin(PI * k / VIEWS), 0));
            most = fmax(most, x);
            least = fmin(least, x);
        }
        mean += (most - least) / VIEWS;
    }
    CHECK(t, fabs(mean - 0.2) < 1e-6, "looks %g wide, not 0.2", mean);
    double radius = length(corner_of(&geo, 0, 0, 0).p);
    for (int i = 0; i < 2 * (RING + 1); i++) {
        bool far = i > RING;
        struct surface at = corner_of(&geo, 0, far, i % (RING + 1));
        vec3 out = vec(at.p.x, at.p.y, 0);
        CHECK(t, fabs(at.p.z - 3 * far) < 1e-6 && fabs(length(out) / radius - 1 - far) < 1e-5, "point");
        CHECK(t, length(sub(at.ns, normalize(out))) < 1e-5 && dot(at.ng, at.ns) > 0.8, "normals point outwards");
        CHECK(t, at.u == far && fabs(at.v - (double)(i % (RING + 1)) / RING) < 1e-15, "u and v");
    }
    geometry_free(&geo);
}

/* Of its first segment: the number of pieces, and the middle at u. */
static int first_segment(const struct geometry *geo, double u, vec3 *middle)
{
    int all = 0;
    for (int i = 0; i < geo->curves.n && (i == 0 || geo->curves.curve[i].net.u[0] > 0); i++)
        all += pieces_of(geo, i);
    double at = u * all;
    int curve = 0, row = (int)at;
    while (row >= pieces_of(geo, curve))
        row -= pieces_of(geo, curve++);
    *middle = lerp3(at - floor(at), row_centre(geo, curve, row), row_centre(geo, curve, row + 1));
    return all;
}

/* Where the segments of each basis and degree begin and end, and that the tube stays near what they are. */
static void bases(struct test *t)
{
    double P[18];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 70, 0);
    for (int i = 0; i < 18; i++)
        P[i] = rng_uniform(&r);
    /* Weights of the first four points at u = 0 and at u = 1/2 of the first segment. */
    static const struct {
        int degree, n, segments;
        bool bspline;
        double start[4], middle[4];
    } CASES[] = {{3, 4, 1, false, {1, 0, 0, 0}, {0.125, 0.375, 0.375, 0.125}},
                 {2, 5, 2, false, {1, 0, 0, 0}, {0.25, 0.5, 0.25, 0}},
                 {3, 6, 3, true, {1 / 6.0, 4 / 6.0, 1 / 6.0, 0}, {1 / 48.0, 23 / 48.0, 23 / 48.0, 1 / 48.0}},
                 {2, 4, 2, true, {0.5, 0.5, 0, 0}, {0.125, 0.75, 0.125, 0}}};
    for (int k = 0; k < 4; k++) {
        struct told c = {P, CASES[k].n, CASES[k].degree, CASES[k].bspline, {0.01, 0.01}, NULL};
        struct geometry geo = geometry_with(t, &c);
        int segments = 0, corners = 0;
        for (int i = 0; i < geo.curves.n; i++) {
            const float *u = geo.curves.curve[i].net.u;
            segments += u[0] == 0 && u[1] > 0;
            corners += u[0] == 0 && u[1] == 0;
            CHECK(t, i == 0 || length(sub(corner_of(&geo, i - 1, pieces_of(&geo, i - 1), 3).p,
                                          corner_of(&geo, i, 0, 3).p)) == 0, "case %d: a gap at curve %d", k, i);
        }
        CHECK(t, segments == CASES[k].segments && corners == (CASES[k].bspline ? 0 : segments - 1),
              "case %d: %d segments, %d corners", k, segments, corners);
        vec3 start = vec(0, 0, 0), middle = vec(0, 0, 0), got;
        for (int i = 0; i < 4; i++) {
            start = add(start, mul(vec(P[3 * i], P[3 * i + 1], P[3 * i + 2]), CASES[k].start[i]));
            middle = add(middle, mul(vec(P[3 * i], P[3 * i + 1], P[3 * i + 2]), CASES[k].middle[i]));
        }
        CHECK(t, length(sub(row_centre(&geo, 0, 0), start)) < 1e-6, "case %d: where it begins", k);
        int pieces = first_segment(&geo, 0.5, &got);
        CHECK(t, length(sub(got, middle)) < 0.01 / 20, "case %d: %g off in the middle", k, length(sub(got, middle)));
        CHECK(t, pieces > 4 && pieces < 100, "case %d: %d pieces", k, pieces);
        geometry_free(&geo);
    }
    struct told short_one = {P, 3, 3, true, {1, 1}, NULL}, uneven = {P, 6, 3, false, {1, 1}, NULL};
    struct mesh none;
    struct error err;
    CHECK(t, !curve_mesh(&short_one, &none, ENOUGH, &err) && strstr(err.text, "are no curve") != NULL &&
              !curve_mesh(&uneven, &none, ENOUGH, &err) && strstr(err.text, "are no curve") != NULL,
          "points that make no whole segments: %s", err.text);
}

/* --- the same as a mesh -------------------------------------------------------------------------------------- */

/* The triangles of all nets, made from their corners. */
static struct mesh mesh_of_nets(const struct geometry *geo)
{
    struct mesh m = {0};
    for (int i = 0; i < geo->curves.n; i++)
        for (int row = 0; row < pieces_of(geo, i); row++)
            for (int j = 0; j < columns_of(geo, i); j++) {
                vec3 a = corner_of(geo, i, row, j).p, b = corner_of(geo, i, row, j + 1).p;
                vec3 c = corner_of(geo, i, row + 1, j + 1).p, d = corner_of(geo, i, row + 1, j).p;
                add_triangle(&m, a, b, c);
                add_triangle(&m, a, c, d);
            }
    return m;
}

/* How large a net looks from far away in the direction x. */
static double seen(const struct geometry *geo)
{
    double area = 0;
    struct mesh m = mesh_of_nets(geo);
    for (int i = 0; i < m.n_triangles; i++) {
        const vec3 *p = &m.P[3 * i];
        area += fabs(cross(sub(p[1], p[0]), sub(p[2], p[0])).x) / 2;
    }
    mesh_free(&m);
    return area;
}

/* A straight ribbon whose normal turns by a quarter: its width, its normals, how wide it looks, and that it is
 * refused. */
static void ribbon(struct test *t)
{
    const double P[] = {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 1, 4, 0, 0, 5, 0, 0, 6};
    const double N[] = {1, 0, 0, 0, 2, 0, 0, 1, 0};
    struct told c = {P, 7, 3, false, {0.2, 0.2}, N};
    struct geometry geo = geometry_with(t, &c);
    struct mesh m;
    struct error err;
    struct surface a = corner_of(&geo, 0, 0, 0), b = corner_of(&geo, 0, 0, 1);
    CHECK(t, length(sub(sub(b.p, a.p), vec(0, -0.2, 0))) < 1e-6, "across the normal and the curve");
    CHECK(t, length(sub(a.ns, vec(1, 0, 0))) < 1e-6 && a.v == 0 && b.v == 1, "normal, v");
    geometry_free(&geo);
    c.n = 4;
    geo = geometry_with(t, &c);
    double wide = seen(&geo) / (3 * 0.2 * 2 / PI); /* 2/PI: the mean of the cosine over a quarter */
    CHECK(t, fabs(wide - 1) < 1e-3, "looks %g times as wide as it is", wide);
    geometry_free(&geo);
    c.width[0] = c.width[1] = 1e-3;
    double bent[12] = {0, 0, 0, 0, 0, 1, 0, 0, 1.1, 0, 0, 3};
    c.P = bent;
    geo = geometry_with(t, &c);
    int pieces = 0, n = geo.curves.n;
    for (int i = 0; i < n; i++)
        for (int row = 0; row <= pieces_of(&geo, i); row++) {
            struct surface at = corner_of(&geo, i, row, 0);
            double angle = at.u * PI / 2;
            CHECK(t, length(sub(at.ns, vec(cos(angle), sin(angle), 0))) < 1e-5, "turns evenly");
            pieces += row > 0;
        }
    geometry_free(&geo);
    double most = (double)(sizeof(struct strand) + sizeof(struct curve) + 200) * pieces;
    CHECK(t, !curve_mesh(&c, &m, most, &err) && strstr(err.text, "parts of a curve") != NULL,
          "too many curves are refused: %s", err.text);
    mesh_free(&m);
    c.width[0] = c.width[1] = 0;
    CHECK(t, curve_mesh(&c, &m, 0, &err) && mesh_primitives(&m) == 0, "no width, no curves");
}

/* --- rays ---------------------------------------------------------------------------------------------------- */

/* A random curve: some have a corner, a cusp, points in one place or no width at one end. */
static void random_curve(struct test *t, struct rng *r, struct transform place, bool reverse, struct geometry *geo)
{
    double P[21], N[21];
    int degree = 2 + (int)rng_below(r, 2), segments = 1 + (int)rng_below(r, 2);
    bool bspline = rng_below(r, 2) == 0, flat = rng_below(r, 3) == 0;
    for (int i = 0; i < 21; i++) {
        P[i] = 2 * rng_uniform(r) - 1;
        N[i] = 2 * rng_uniform(r) - 1;
    }
    if (rng_below(r, 4) == 0)
        memcpy(P + 3 * rng_below(r, 3), P + 9, 3 * sizeof *P);
    double width = pow(10, -2.5 * rng_uniform(r));
    struct told c = {P, bspline ? segments + degree : 1 + segments * degree, degree, bspline,
                      {width, width * rng_below(r, 3)}, flat && !bspline ? N : NULL};
    draw(t, &c, place, reverse, geo);
}

/* All hits of a ray with the mesh, which is where an instance places it, in order. */
static int mesh_hits(const struct geometry *mesh, const struct transform *place, const struct ray *ray, double t[64])
{
    struct ray r = *ray;
    int n = 0;
    r.o = transform_point_back(place, ray->o);
    r.d = transform_vector_back(place, ray->d);
    for (int i = 0; i < mesh->n_triangles; i++) {
        struct hit h;
        if (n < 64 && shape_intersect(mesh, i, &r, &h))
            t[n++] = h.t;
    }
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && t[k] < t[k - 1]; k--) {
            double swap = t[k];
            t[k] = t[k - 1];
            t[k - 1] = swap;
        }
    return n;
}

/* Follow a ray from hit to hit, with the primitive where it begins left out, and compare with all of the mesh. Hits
 * in one place, as on an edge, count once. Returns how many there were; *wrong: how many differ. */
static int follow(const struct geometry *geo, const struct kdtree *kd, const struct geometry *mesh,
                  const struct transform *place, struct ray ray, double size, int *wrong)
{
    double want[64], last = 0;
    int n = mesh_hits(mesh, place, &ray, want), k = 0, hits = 0;
    struct hit hit;
    while (kd_closest(kd, geo, &ray, &hit)) {
        struct surface at;
        shape_surface(geo, &hit, &ray, &at);
        double here = last + hit.t;
        while (k < n && want[k] < here - 1e-6 * size)
            (*wrong)++, k++;
        *wrong += !(k < n && fabs(want[k] - here) <= 1e-6 * size) ||
                  !(length(sub(at.p, add(ray.o, mul(ray.d, hit.t)))) < 1e-9 * size);
        while (k < n && want[k] <= here + 1e-6 * size)
            k++;
        ray.o = at.p;
        ray.from = at.prim_id;
        ray.tmin = 1e-6 * size;
        last = here;
        hits++;
    }
    *wrong += n - k;
    return hits;
}

/* A ray that leaves from where another has hit, away from edges, does not meet the curve there, and meets what it would
 * meet if it began a little farther on. */
static bool leaves(const struct geometry *geo, const struct kdtree *kd, const struct surface *at, double size, vec3 d)
{
    struct ray own = {at->p, d, 0, INFINITY, at->prim_id, 0}, far = {at->p, d, 1e-8 * size, INFINITY, 0, 0};
    struct hit a, b;
    bool met = kd_closest(kd, geo, &own, &a);
    return met == kd_closest(kd, geo, &far, &b) && (!met || fabs(a.t - b.t) <= 1e-9 * size);
}

/* Is a place in a net away from the edges of its triangles? */
static bool is_inside(const struct hit *h)
{
    double along = h->b1 - floor(h->b1), across = h->b2 - floor(h->b2);
    return fmin(along, across) > 0.05 && fmax(along, across) < 0.95 && fabs(along - across) > 0.05;
}

static void against_mesh(struct test *t, struct rng *r)
{
    int hits = 0, wrong = 0, late = 0, left = 0, stuck = 0;
    for (int k = 0; k < 120; k++) {
        struct geometry geo = {0};
        double size = pow(10, 4 * rng_uniform(r) - 2);
        struct transform place = k % 3 == 0 ? random_affine(r) : transform_rotate(77, on_sphere(r));
        place = transform_compose(transform_scale(size, size, size), place);
        for (int i = 0; i < 3; i++)
            random_curve(t, r, place, i == 1, &geo);
        struct mesh m = mesh_of_nets(&geo);
        struct geometry mesh = geometry_of(t, &m);
        struct transform instance = transform_identity();
        if (k % 4 == 1) {
            instance = random_affine(r);
            CHECK(t, shape_add_instance(&geo, shape_make_object(&geo, 0), &instance, NULL), "an instance");
        }
        struct kdtree kd;
        kd_build(&kd, &geo, KD_SURFACES);
        size = fmax(kd.reach, 1e-30);
        for (int i = 0; i < 300; i++) {
            vec3 target = mesh.n_triangles > 0 ? load3(mesh.P, rng_below(r, (uint32_t)mesh.n_vertices)) : in_cube(r);
            target = add(transform_point(&instance, target), mul(on_sphere(r), i % 2 == 0 ? 1e-3 * size : 0.05 * size));
            vec3 d = i % 8 == 0 ? axis((int)rng_below(r, 6)) : on_sphere(r);
            struct ray ray = {sub(target, mul(d, 4 * size)), d, 0, INFINITY, 0, 0};
            int n = follow(&geo, &kd, &mesh, &instance, ray, size, &wrong);
            hits += n;
            /* A shadow ray that ends on a curve is not shaded by it there. */
            struct hit hit;
            if (n > 0 && kd_closest(&kd, &geo, &ray, &hit)) {
                struct surface at;
                shape_surface(&geo, &hit, &ray, &at);
                if (is_inside(&hit) && geo.curves.curve[0].net.radius[0] > 1e-3f) {
                    left++;
                    stuck += !leaves(&geo, &kd, &at, size, on_sphere(r));
                }
                ray.tmax = hit.t - 1e-7 * size;
                ray.to = shape_prim_id(hit.prim, hit.instance);
                late += kd_occluded(&kd, &geo, &ray, INFINITY);
            }
        }
        kd_free(&kd);
        geometry_free(&geo);
        geometry_free(&mesh);
    }
    CHECK(t, hits > 30000 && wrong == 0, "%d of %d hits differ from those of the mesh", wrong, hits);
    CHECK(t, left > 4000 && stuck <= left / 100, "%d of %d rays do not leave the curve where they begin", stuck, left);
    CHECK(t, late == 0, "%d shadow rays are shaded where they end", late);
}

/* All of a net is within the bounds, and so is what lies in a cell; and the bounds are tight. */
static void bounds(struct test *t, struct rng *r)
{
    int outside = 0, wide = 0, n = 0;
    for (int k = 0; k < 100; k++) {
        struct geometry geo = {0};
        random_curve(t, r, random_affine(r), false, &geo);
        for (int i = 0; i < geo.curves.n; i++, n++) {
            float lo[3], hi[3], cell[2][3], in_lo[3] = {1, 1, 1}, in_hi[3] = {0, 0, 0};
            double slack = 1e-6;
            shape_bounds(&geo, FIRST_CURVE + i, lo, hi);
            for (int axis = 0; axis < 3; axis++) {
                double a = rng_uniform(r), b = rng_uniform(r);
                slack = fmax(slack, 1e-6 * (fabs((double)lo[axis]) + fabs((double)hi[axis])));
                cell[0][axis] = (float)(lo[axis] + fmin(a, b) * ((double)hi[axis] - lo[axis]));
                cell[1][axis] = (float)(lo[axis] + fmax(a, b) * ((double)hi[axis] - lo[axis]));
            }
            bool any = curve_bounds(&geo.curves, i, cell[0], cell[1], in_lo, in_hi);
            double most = 0;
            for (int point = 0; point < 400; point++) {
                vec3 v = surface_at(&geo, FIRST_CURVE + i, rng_uniform(r) * pieces_of(&geo, i),
                                    rng_uniform(r) * columns_of(&geo, i)).p;
                const double p[3] = {v.x, v.y, v.z};
                bool in = true, there = any;
                for (int axis = 0; axis < 3; axis++) {
                    outside += p[axis] < lo[axis] - slack || p[axis] > hi[axis] + slack;
                    in = in && p[axis] > cell[0][axis] && p[axis] < cell[1][axis];
                    there = there && p[axis] >= in_lo[axis] - slack && p[axis] <= in_hi[axis] + slack;
                }
                outside += in && !there;
                most = fmax(most, fabs(p[0] - 0.5 * ((double)lo[0] + hi[0])));
            }
            wide += most < 0.2 * ((double)hi[0] - lo[0]);
        }
        geometry_free(&geo);
    }
    CHECK(t, n > 300 && outside == 0 && wide < n / 10, "of %d curves %d points are outside, %d boxes too wide", n,
          outside, wide);
}

/* A hair of 34 pieces, as it was measured: a few hundred bytes, and not the 88000 of its triangles. */
static void hair(struct test *t)
{
    const double P[] = {0, 0, 0, 0.3, 0, 0.3, -0.3, 0.3, 0.6, 0, 0.1, 1};
    struct told c = {P, 4, 3, false, {0.02, 0.02}, NULL};
    struct geometry geo = geometry_with(t, &c);
    int pieces = 0;
    for (int i = 0; i < geo.curves.n; i++)
        pieces += pieces_of(&geo, i);
    CHECK(t, pieces == 34 && (double)sizeof(struct curve) * geo.curves.n < 1500, "%d pieces, %d curves", pieces,
          geo.curves.n);
    geometry_free(&geo);
}

void test_curve(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 71, 0);
    straight(t);
    bases(t);
    ribbon(t);
    against_mesh(t, &r);
    bounds(t, &r);
    hair(t);
}
