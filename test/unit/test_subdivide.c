/* test_subdivide.c: Loop subdivision: known limits, agreement of levels, topology, normals, and what is refused. */
#include "geometry/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "suites.h"

static struct mesh mesh_of(const float *P, int n_vertices, const uint32_t *index, int n_triangles)
{
    struct mesh m = {.n_vertices = n_vertices, .n_triangles = n_triangles};
    m.P = mem_alloc((size_t)n_vertices, sizeof *m.P);
    m.index = mem_alloc((size_t)n_triangles, 3 * sizeof *m.index);
    for (size_t i = 0; i < (size_t)n_vertices; i++)
        m.P[i] = load3(P, i);
    memcpy(m.index, index, 3 * (size_t)n_triangles * sizeof *index);
    return m;
}

/* By the row of "loopsubdiv", in the place of its control mesh, if it is not refused. */
static bool mesh_subdivide(struct mesh *m, int levels, struct error *err)
{
    struct shape_fields f = shape_fields_of("loopsubdiv");
    struct mesh made;
    double *index = mem_alloc(3 * (size_t)m->n_triangles, sizeof *index);
    for (int i = 0; i < 3 * m->n_triangles; i++)
        index[i] = m->index[i];
    struct field_list points = {(const double *)m->P, m->n_vertices}, indices = {index, m->n_triangles};
    shape_fields_set(&f, "P", &points, sizeof points);
    shape_fields_set(&f, "indices", &indices, sizeof indices);
    shape_fields_set(&f, "levels", &levels, sizeof levels);
    bool ok = shape_fields_mesh(&f, 2.5e9, &made, err);
    free(index);
    mesh_free(ok ? m : &made);
    if (ok)
        *m = made;
    return ok;
}

/* Two tips of valence n over a ring of valence 4, its corners at odd heights: closed, counterclockwise from outside. */
static struct mesh spindle(int n)
{
    float P[3 * 16];
    uint32_t index[3 * 28];
    for (int k = 0; k < n; k++) {
        double phi = 2 * PI * k / n;
        uint32_t a = (uint32_t)k, b = (uint32_t)((k + 1) % n), up = (uint32_t)n, down = up + 1;
        const uint32_t faces[6] = {a, b, up, b, a, down};
        const float corner[3] = {(float)cos(phi), (float)sin(phi), k % 2 == 0 ? 0.2f : -0.1f};
        memcpy(index + 6 * k, faces, sizeof faces);
        memcpy(P + 3 * k, corner, sizeof corner);
    }
    const float tips[6] = {0.1f, 0, 1, 0, 0.2f, -1.5f};
    memcpy(P + 3 * n, tips, sizeof tips);
    return mesh_of(P, n + 2, index, 2 * n);
}

static struct mesh subdivided(struct test *t, struct mesh m, int levels)
{
    struct error err = {.text = ""};
    CHECK(t, mesh_subdivide(&m, levels, &err), "%s", err.text);
    return m;
}

/* Sum of the normals of the triangles around each vertex, weighed by their areas. */
static vec3 *face_normals(const struct mesh *m)
{
    vec3 *sum = mem_alloc((size_t)m->n_vertices, sizeof *sum);
    for (int f = 0; f < m->n_triangles; f++) {
        const uint32_t *v = &m->index[3 * f];
        vec3 p = m->P[v[0]], n = cross(sub(m->P[v[1]], p), sub(m->P[v[2]], p));
        for (int k = 0; k < 3; k++)
            sum[v[k]] = add(sum[v[k]], n);
    }
    return sum;
}

/* A vertex inside has the same limit from every level, whatever its valence: only the right pair of weights, of a level
 * and of the limit, does this. Normals are those of the limit, on the side where corners run clockwise. */
static void check_closed(struct test *t)
{
    for (int n = 3; n <= 9; n++) {
        struct mesh coarse = subdivided(t, spindle(n), 0), fine = subdivided(t, spindle(n), 4);
        CHECK(t, fine.n_triangles == 2 * n * 256 && fine.n_vertices == 2 + fine.n_triangles / 2, "Euler: %d vertices",
              fine.n_vertices);
        for (uint32_t v = 0; v < (uint32_t)n + 2; v++)
            CHECK(t, near3(coarse.P[v], fine.P[v], 1e-6), "valence %d: vertex %u has two limits", n, v);
        for (int f = 0; f < 2 * n; f++)
            for (int k = 0; k < 3; k++)
                CHECK(t, fine.index[3 * 256 * f + k * 3 * 85 + k] == coarse.index[3 * f + k], "corner %d of %d", k, f);
        struct mesh control = spindle(n);
        vec3 tip = control.P[n], mean = vec(0, 0, 0);
        for (uint32_t k = 0; k < (uint32_t)n; k++)
            mean = add(mean, mul(control.P[k], 1.0 / n));
        vec3 limit = lerp3(n == 3 ? 0.6 : 0.5, tip, mean); /* [PBRT3 3.8.2] */
        CHECK(t, near3(coarse.P[n], limit, 1e-6), "valence %d: limit of the tip", n);
        mesh_free(&control);
        vec3 *want = face_normals(&fine);
        double worst = 1;
        for (uint32_t v = 0; v < (uint32_t)fine.n_vertices; v++)
            worst = least_of(worst, -dot(normalize(want[v]), normalize(load3(fine.N, v))));
        CHECK(t, worst > 0.99, "valence %d: normal and triangles differ by %g degrees", n, acos(worst) * 180 / PI);
        free(want);
        mesh_free(&coarse);
        mesh_free(&fine);
    }
}

/* Fans of 1 to 6 triangles: points of the boundary see their two neighbours along it only. */
static void check_boundary(struct test *t)
{
    for (int n = 1; n <= 6; n++) {
        float P[3 * 8] = {0, 0, 0};
        uint32_t index[3 * 6];
        for (int k = 0; k <= n; k++) {
            const float corner[3] = {(float)cos(0.8 * k), (float)sin(0.8 * k), 0};
            memcpy(P + 3 * (k + 1), corner, sizeof corner);
        }
        for (int k = 0; k < n; k++) {
            const uint32_t face[3] = {0, (uint32_t)k + 1, (uint32_t)k + 2};
            memcpy(index + 3 * k, face, sizeof face);
        }
        for (int levels = 0; levels < 3; levels++) {
            struct mesh m = subdivided(t, mesh_of(P, n + 2, index, n), levels);
            vec3 ends = add(load3(P, 1), load3(P, (uint32_t)n + 1)); /* p is 0 */
            /* A level: 1/8, then the neighbours are halfway. The limit: 1/5. */
            double step = levels == 0 ? 0 : levels == 1 ? 1.0 / 8 : 1.0 / 8 + 1.0 / 32;
            double reach = levels == 0 ? 1 : levels == 1 ? 1.0 / 4 : 1.0 / 16;
            vec3 want = mul(ends, step + 0.2 * reach);
            CHECK(t, near3(m.P[0], want, 1e-6), "%d triangles, %d levels: boundary at (%g %g)", n, levels,
                  m.P[0].x, m.P[0].y);
            for (uint32_t v = 0; v < (uint32_t)m.n_vertices; v++)
                CHECK(t, near3(normalize(load3(m.N, v)), vec(0, 0, -1), 1e-6), "a flat mesh has one normal");
            mesh_free(&m);
        }
    }
}

static void refuse(struct test *t, const uint32_t *index, int n_triangles, int levels, const char *why)
{
    static const float P[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    struct mesh m = mesh_of(P, 5, index, n_triangles);
    struct error err = {.text = ""};
    CHECK(t, !mesh_subdivide(&m, levels, &err) && strstr(err.text, why) != NULL,
          "\"%s\", not \"%s\"", err.text, why);
    mesh_free(&m);
}

static void check_refused(struct test *t)
{
    static const uint32_t three[] = {0, 1, 2, 1, 0, 3, 0, 1, 4}, same[] = {0, 1, 2, 0, 1, 3}, none[] = {0, 0, 1};
    refuse(t, three, 3, 2, "between points 0 and 1 has 3 triangles");
    refuse(t, same, 2, 2, "two that run along it the same way");
    refuse(t, none, 1, 2, "between points 0 and 0");
    refuse(t, three, 1, 30, "there can be 2^30");
    refuse(t, three, 1, 12, "1.678e+07 triangles: this needs 3355.4 MB more memory, but 2500.0 of");
}

/* Normals are as long as the product of two tangents: a mesh twice as large has them four times as long. */
static void check_normal_lengths(struct test *t)
{
    struct mesh small = subdivided(t, spindle(5), 1), control = spindle(5);
    for (int i = 0; i < control.n_vertices; i++)
        control.P[i] = mul(control.P[i], 2);
    struct mesh large = subdivided(t, control, 1);
    for (uint32_t v = 0; v < (uint32_t)small.n_vertices; v++) {
        vec3 want = mul(load3(small.N, v), 4);
        CHECK(t, length(want) > 0 && near3(load3(large.N, v), want, 1e-5 * length(want)), "normal %u", (unsigned)v);
    }
    mesh_free(&small);
    mesh_free(&large);
}

/* Triangles that touch in a point, and a point of none: nothing runs for ever, all numbers are numbers. */
static void check_odd(struct test *t)
{
    static const float P[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 7, 7, 7};
    static const uint32_t index[] = {0, 1, 2, 0, 3, 4};
    struct mesh m = subdivided(t, mesh_of(P, 6, index, 2), 3);
    for (int i = 0; i < 3 * m.n_vertices; i++)
        CHECK(t, is_finite3(m.P[i / 3]) && isfinite(m.N[i]), "number %d is none", i);
    CHECK(t, near3(m.P[5], vec(7, 7, 7), 0) && near3(load3(m.N, 5), vec(0, 0, 0), 0), "a point of no triangle");
    mesh_free(&m);
}

void test_subdivide(struct test *t)
{
    check_closed(t);
    check_boundary(t);
    check_normal_lengths(t);
    check_refused(t);
    check_odd(t);
}
