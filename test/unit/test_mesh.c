/* test_mesh.c: meshes: between the corners of their triangles, and subdivided. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "geometry/mesh.h"
#include "geometry/shape.h"
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
    bool ok = shape_fields_mesh(&f, 2e9, &made, err);
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
    refuse(t, three, 1, 12, "1.678e+07 triangles: this needs 3355.4 MB more memory, but 2000.0 of");
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

/* subdivide: Loop subdivision: known limits, agreement of levels, topology, normals, and what is refused. */
void test_subdivide(struct test *t)
{
    check_closed(t);
    check_boundary(t);
    check_normal_lengths(t);
    check_refused(t);
    check_odd(t);
}

/* --- the suite smooth ----------------------------------------------------------------------------------------- */

static vec3 corner[] = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
static float corner_normal[] = {0, 0, 1, 0.6f, 0, 0.8f, 0, -0.6f, 0.8f};
static float corner_uv[] = {0.5f, 0, 1, 0.25f, 0.25f, 1};
static uint32_t corner_index[] = {0, 1, 2};

/* Vertex normals of any length under any transform: they are interpolated as they come out of it, as in pbrt-v3, and
 * the partials of ns are its differences. */
static void check_vertex_normals(struct test *t, struct rng *r)
{
    const double h = 1e-5;
    for (int i = 0; i < 50; i++) {
        struct geometry geo = {0};
        struct error err = {.text = ""};
        struct transform m = random_affine(r);
        double b1 = 0.1 + 0.4 * rng_uniform(r), b2 = 0.1 + 0.3 * rng_uniform(r);
        float normal[9];
        vec3 n[3];
        for (int k = 0; k < 9; k++)
            normal[k] = corner_normal[k] * (float)(k / 3 + 1);
        struct mesh mesh = {.P = corner, .N = normal, .UV = corner_uv, .index = corner_index, .n_vertices = 3,
                            .n_triangles = 1};
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

/* Vertex tangents of any length under any transform: what comes of their mean across ns is where dpdu points, and no
 * normal, length or handedness changes; where nothing comes of it, nothing does. */
static void check_vertex_tangents(struct test *t, struct rng *r)
{
    for (int i = 0; i < 50; i++) {
        struct geometry geo = {0};
        struct error err = {.text = ""};
        struct transform m = random_affine(r);
        float tangent[9];
        vec3 s[3], s0 = on_sphere(r);
        for (int k = 0; k < 3; k++) {
            vec3 v = mul(i % 5 == 4 ? vec(0, 0, 0) : add(s0, mul(on_sphere(r), 0.3)), k + 1);
            store3(tangent, (size_t)k, v);
            s[k] = load3(tangent, (size_t)k);
        }
        struct mesh mesh = {.P = corner, .N = i % 2 ? corner_normal : NULL, .UV = corner_uv, .index = corner_index,
                            .n_vertices = 3, .n_triangles = 1};
        CHECK(t, shape_add_mesh(&geo, &mesh, &m, group_of(7, 40), i % 3 == 0, &err) == 0, "%s", err.text);
        mesh.S = tangent;
        CHECK(t, shape_add_mesh(&geo, &mesh, &m, group_of(7, 40), i % 3 == 0, &err) == 1, "%s", err.text);
        double b1 = 0.1 + 0.4 * rng_uniform(r), b2 = 0.1 + 0.3 * rng_uniform(r);
        struct surface without = surface_at(&geo, 0, b1, b2), with = surface_at(&geo, 1, b1, b2);
        vec3 mean = transform_vector(&m, barycentric3(s, b1, b2));
        vec3 want = normalize(sub(mean, mul(with.ns, dot(mean, with.ns))));
        vec3 old = cross(without.dpdu, without.dpdv), new = cross(with.dpdu, with.dpdv);
        CHECK(t, near3(with.ns, without.ns, 0) && near3(with.ng, without.ng, 0), "tangents %d turn a normal", i);
        if (i % 5 == 4)
            CHECK(t, near3(with.dpdu, without.dpdu, 0) && near3(with.dpdv, without.dpdv, 0), "tangents of 0 count");
        else
            CHECK(t, near3(normalize(with.dpdu), want, 1e-5) && dot(old, with.ns) * dot(new, with.ns) > 0 &&
                         fabs(length(with.dpdu) / length(without.dpdu) - 1) < 1e-9 &&
                         fabs(length(with.dpdv) / length(without.dpdv) - 1) < 1e-9 &&
                         fabs(dot(with.dpdv, want)) < 1e-5 * length(with.dpdv), "tangents %d", i);
        geometry_free(&geo);
    }
}

static void check_degenerate_uv(struct test *t)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    float same[] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    struct mesh m = {.P = corner, .N = corner_normal, .UV = same, .index = corner_index, .n_vertices = 3,
                     .n_triangles = 1};
    for (int i = 0; i < 2; i++, m.N = NULL) {
        shape_add_mesh(&geo, &m, &id, group_of(0, -1), false, NULL);
        struct surface at = surface_at(&geo, i, 0.3, 0.3);
        CHECK(t, length(cross(at.dpdu, at.dpdv)) > 0.5 && fabs(dot(at.dpdu, at.ns)) < 1e-12 && is_finite3(at.dndu) &&
                     is_finite3(at.dndv) && at.light == -1, "degenerate (u,v)");
    }
    geometry_free(&geo);
}

/* A triangle as a scene has it, and as a file has it. */
static void check_rows(struct test *t)
{
    static const double P[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, uv[] = {0, 0, 1, 0, 0, 1}, indices[] = {0, 1, 2};
    static const char *const ROWS[] = {"trianglemesh", "plymesh"};
    const char *path = "test/data/fixtures/parts/triangle.ply";
    const struct field_list points = {P, 3}, corners = {indices, 1}, parameters = {uv, 3};
    for (int i = 0; i < 2; i++) {
        struct shape_fields f = shape_fields_of(ROWS[i]);
        struct mesh m;
        struct error err = {.text = ""};
        if (i == 0) {
            shape_fields_set(&f, "P", &points, sizeof points);
            shape_fields_set(&f, "indices", &corners, sizeof corners);
            shape_fields_set(&f, "uv", &parameters, sizeof parameters);
        } else {
            shape_fields_set(&f, "filename", &path, sizeof path);
        }
        bool ok = CHECK(t, shape_fields_mesh(&f, 1e4, &m, &err), "%s: %s", ROWS[i], err.text);
        ok = ok && CHECK(t, m.n_vertices == 3 && m.n_triangles == 1 && m.UV != NULL, "%s: %d points, %d triangles",
                         ROWS[i], m.n_vertices, m.n_triangles);
        for (size_t k = 0; ok && k < 3; k++)
            CHECK(t, near3(m.P[k], vec(P[3 * k], P[3 * k + 1], P[3 * k + 2]), 0) && m.index[k] == k &&
                      (double)m.UV[2 * k] == uv[2 * k] && (double)m.UV[2 * k + 1] == uv[2 * k + 1],
                  "%s: corner %d", ROWS[i], (int)k);
        mesh_free(&m);
    }
}

/* smooth: triangles with normals, tangents and parameters of their own: what the surface is like between their
 * corners. */
void test_smooth(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 102, 1);
    check_vertex_normals(t, &r);
    check_vertex_tangents(t, &r);
    check_degenerate_uv(t);
    check_rows(t);
}
