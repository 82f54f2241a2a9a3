/* test_smooth.c: triangles with normals, tangents and parameters of their own: what the surface is like between their
 * corners. */
#include "geometry/shape.h"

#include <string.h>

#include "base/rng.h"
#include "helpers.h"
#include "suites.h"

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

void test_smooth(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 102, 1);
    check_vertex_normals(t, &r);
    check_vertex_tangents(t, &r);
    check_degenerate_uv(t);
    check_rows(t);
}
