/* test_curve.c: curves as triangles: points and normals against closed forms. */
#include <math.h>
#include <string.h>

#include "base/rng.h"
#include "geometry/mesh.h"
#include "helpers.h"
#include "suites.h"

enum { ENOUGH = 1 << 23 }; /* triangles */
enum { RING = 9 }; /* points of a tube's row; the first and the last are one */

/* What a scene file says of a curve; a ribbon if it has normals. */
struct curve {
    const double *P;
    int n, degree;
    bool bspline;
    double width[2];
    const double *N;
};

/* By the row of "curve", with room for so many triangles. */
static bool curve_mesh(const struct curve *c, struct mesh *m, double most, struct error *err)
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
    return shape_fields_mesh(&f, 200 * most, m, err);
}

static struct mesh mesh_of(struct test *t, const struct curve *c)
{
    struct mesh m = {0};
    struct error err = {.text = ""};
    CHECK(t, curve_mesh(c, &m, ENOUGH, &err), "%s", err.text);
    return m;
}

static vec3 row_centre(const struct mesh *m, int row)
{
    vec3 sum = vec(0, 0, 0);
    for (int i = 0; i < RING - 1; i++)
        sum = add(sum, m->P[row * RING + i]);
    return mul(sum, 1.0 / (RING - 1));
}

/* A straight tube of growing width: how wide it looks from all sides on average, its normals, u and v. */
static void straight(struct test *t)
{
    const double P[] = {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3};
    struct curve c = {.P = P, .n = 4, .degree = 3, .width = {0.2, 0.4}};
    struct mesh m = mesh_of(t, &c);
    CHECK(t, m.n_vertices == 2 * RING && m.n_triangles == 4 * (RING - 1) / 2, "one piece: %d points, %d triangles",
          m.n_vertices, m.n_triangles);
    double mean = 0;
    enum { VIEWS = 1000 };
    for (int k = 0; k < VIEWS; k++) {
        double most = 0, least = 0;
        for (size_t i = 0; i < RING - 1; i++) {
            double x = dot(m.P[i], vec(cos(PI * k / VIEWS), sin(PI * k / VIEWS), 0));
            most = fmax(most, x);
            least = fmin(least, x);
        }
        mean += (most - least) / VIEWS;
    }
    CHECK(t, fabs(mean - 0.2) < 1e-6, "looks %g wide, not 0.2", mean);
    for (size_t i = 0; i < 2 * RING; i++) {
        vec3 p = m.P[i], n = load3(m.N, i), out = vec(p.x, p.y, 0);
        bool far = i >= RING;
        CHECK(t, fabs(p.z - 3 * far) < 1e-6 && fabs(length(out) / length(m.P[0]) - 1 - far) < 1e-5, "point");
        CHECK(t, length(sub(n, normalize(out))) < 1e-5, "normals point outwards");
        CHECK(t, m.UV[2 * i] == (float)far && m.UV[2 * i + 1] == (float)(i % RING) / (RING - 1), "u and v");
    }
    mesh_free(&m);
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
        struct curve c = {P, CASES[k].n, CASES[k].degree, CASES[k].bspline, {0.01, 0.01}, NULL};
        struct mesh m = mesh_of(t, &c);
        int segments = 0;
        for (int i = 0; i < m.n_vertices; i += RING)
            segments += m.UV[2 * i] == 0;
        CHECK(t, segments == CASES[k].segments, "case %d: %d segments", k, segments);
        int pieces = 0;
        while (m.UV[2 * RING * pieces] < 1)
            pieces++;
        vec3 start = vec(0, 0, 0), middle = vec(0, 0, 0);
        for (int i = 0; i < 4; i++) {
            start = add(start, mul(vec(P[3 * i], P[3 * i + 1], P[3 * i + 2]), CASES[k].start[i]));
            middle = add(middle, mul(vec(P[3 * i], P[3 * i + 1], P[3 * i + 2]), CASES[k].middle[i]));
        }
        CHECK(t, length(sub(row_centre(&m, 0), start)) < 1e-6, "case %d: where it begins", k);
        vec3 chord = lerp3(pieces % 2 * 0.5, row_centre(&m, pieces / 2), row_centre(&m, (pieces + 1) / 2));
        CHECK(t, length(sub(chord, middle)) < 0.01 / 20, "case %d: %g off in the middle", k,
              length(sub(chord, middle)));
        CHECK(t, pieces > 4 && pieces < 100, "case %d: %d pieces", k, pieces);
        CHECK(t, CASES[k].segments == 1 || length(sub(row_centre(&m, pieces), row_centre(&m, pieces + 1))) < 1e-6,
              "case %d: segments meet", k);
        mesh_free(&m);
    }
    struct curve short_one = {P, 3, 3, true, {1, 1}, NULL}, uneven = {P, 6, 3, false, {1, 1}, NULL};
    struct mesh none;
    struct error err;
    CHECK(t, !curve_mesh(&short_one, &none, ENOUGH, &err) && strstr(err.text, "are no curve") != NULL &&
              !curve_mesh(&uneven, &none, ENOUGH, &err) && strstr(err.text, "are no curve") != NULL,
          "points that make no whole segments: %s", err.text);
}

/* How large a mesh looks from far away in the direction x. */
static double seen(const struct mesh *m)
{
    double area = 0;
    for (int i = 0; i < m->n_triangles; i++) {
        vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = m->P[m->index[3 * i + k]];
        area += fabs(cross(sub(p[1], p[0]), sub(p[2], p[0])).x) / 2;
    }
    return area;
}

/* A straight ribbon whose normal turns by a quarter: its width, its normals, how wide it looks, and that it is
 * refused. */
static void ribbon(struct test *t)
{
    const double P[] = {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 1, 4, 0, 0, 5, 0, 0, 6};
    const double N[] = {1, 0, 0, 0, 2, 0, 0, 1, 0};
    struct curve c = {P, 7, 3, false, {0.2, 0.2}, N};
    struct mesh m = mesh_of(t, &c);
    struct error err;
    vec3 a = m.P[0], b = m.P[1];
    CHECK(t, length(sub(sub(b, a), vec(0, -0.2, 0))) < 1e-6, "across the normal and the curve");
    CHECK(t, m.N[0] == 1 && m.UV[1] == 0 && m.UV[3] == 1, "normal, v");
    mesh_free(&m);
    c.n = 4;
    m = mesh_of(t, &c);
    double wide = seen(&m) / (3 * 0.2 * 2 / PI); /* 2/PI: the mean of the cosine over a quarter */
    CHECK(t, fabs(wide - 1) < 1e-3, "looks %g times as wide as it is", wide);
    mesh_free(&m);
    c.width[0] = c.width[1] = 1e-3;
    double bent[12] = {0, 0, 0, 0, 0, 1, 0, 0, 1.1, 0, 0, 3};
    c.P = bent;
    m = mesh_of(t, &c);
    for (int i = 0; i < m.n_vertices; i += 2) {
        double angle = m.UV[2 * i] * PI / 2;
        CHECK(t, length(sub(load3(m.N, (size_t)i), vec(cos(angle), sin(angle), 0))) < 1e-5, "turns evenly");
    }
    int most = m.n_triangles - 1;
    mesh_free(&m);
    CHECK(t, !curve_mesh(&c, &m, most, &err) && m.P == NULL, "too many triangles are refused");
    c.width[0] = c.width[1] = 0;
    CHECK(t, curve_mesh(&c, &m, most, &err) && m.n_triangles == 0, "no width, no triangles");
}

void test_curve(struct test *t)
{
    straight(t);
    bases(t);
    ribbon(t);
}
