/* test_kdtree.c: the kd-tree gives exactly the answers of a loop over all primitives.
 *
 * Geometry that builders and traversals get wrong is generated: everything coplanar, everything at one place,
 * needles, far from the origin, one triangle, none. Rays are chosen to be awkward as well: along axes, in planes of
 * splits, through vertices and edges. The distance must be that of brute force to the last bit. Closed surfaces
 * must let no ray out; with one triangle taken away they must.
 */
#include "geometry/kd_block.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "lab/numbers.h"
#include "lab/tree.h"
#include "helpers.h"
#include "kd_parts.h"
#include "suites.h"

/* --- comparison --------------------------------------------------------------------------------------- */

/* Does the tree say the same of this ray as all primitives one by one? *want, *a: what they say. */
static bool same_as_brute(const struct kdtree *kd, const struct geometry *geo, bool see_through, const struct ray *ray,
                          bool *want, struct hit *a, struct hit *b)
{
    *want = brute_closest(geo, see_through, ray, a);
    bool got = kd_closest(kd, geo, ray, b);
    return *want == got && (!*want || (a->t == b->t && a->prim == b->prim && a->instance == b->instance)) &&
           kd_occluded(kd, geo, ray, INFINITY) == *want;
}

/* Are all hits of the ray, and what is a little behind it, those of all primitives one by one, the nearest first? */
static bool all_as_brute(const struct kdtree *kd, const struct geometry *geo, bool see_through, struct ray ray)
{
    struct hit *hits, h;
    ray.tmin -= 0.1 * kd->reach;
    int n = kd_all(kd, geo, &ray, &hits), want = 0;
    bool same = true;
    for (int i = 0; i + 1 < n; i++)
        same &= hits[i].t <= hits[i + 1].t;
    for (int i = 0; i < geometry_primitives(geo); i++) {
        struct ray rest = ray;
        bool wanted = (shape_group_of(geo, prim_number(geo, i))->material < 0) == see_through;
        for (; wanted && shape_intersect(geo, prim_number(geo, i), &rest, &h); rest.tmin = h.t) {
            int found = 0;
            if (geo->opaque != NULL && !geo->opaque(geo->opaque_context, geo, &h))
                continue;
            for (int k = 0; k < n; k++)
                found += hits[k].prim == h.prim && hits[k].t == h.t;
            same &= found == 1;
            want++;
        }
    }
    free(hits);
    return same && n == want;
}

/* Every ray is traced as it is, again as if it began on the triangle it hit, and again as if it ended on the next. */
static void compare(struct test *t, const char *name, const struct geometry *geo, bool see_through, struct rng *r,
                    int n_rays)
{
    struct kdtree kd;
    int wrong = 0, hits = 0;
    kd_build(&kd, geo, see_through ? KD_INTERFACES : KD_SURFACES);
    double size = 0;
    for (int k = 0; k < 3; k++)
        size = fmax(size, (double)kd.hi[k] - (double)kd.lo[k]);
    for (int i = 0; i < n_rays; i++) {
        struct ray ray = awkward_ray(geo, r, size);
        struct hit a = {0}, b = {0};
        bool want, next = false, same = same_as_brute(&kd, geo, see_through, &ray, &want, &a, &b);
        hits += want;
        if (same && want && geo->opaque == NULL) {
            ray.from = shape_prim_id(a.prim, a.instance);
            same = same_as_brute(&kd, geo, see_through, &ray, &next, &a, &b);
        }
        if (same && next) {
            ray.to = shape_prim_id(a.prim, a.instance);
            ray.tmax = HUGE_VAL; /* else the shadow ray would look what is in one place with its end */
            same = same_as_brute(&kd, geo, see_through, &ray, &next, &a, &b);
        }
        same = same && (i % 8 > 0 || all_as_brute(&kd, geo, see_through, ray));
        wrong += !same;
        if (!same && wrong == 1)
            CHECK(t, false, "%s, ray %d o (%.17g %.17g %.17g) d (%.17g %.17g %.17g): hit at %.17g, not %.17g", name, i,
                  ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, b.t, a.t);
    }
    CHECK(t, wrong == 0, "%s: %d of %d rays wrong", name, wrong, n_rays);
    CHECK(t, hits > n_rays / 20, "%s: only %d of %d rays hit anything: a poor test", name, hits, n_rays);
    size_t references = tree_figures(&kd).references;
    CHECK(t, references <= 32 * (size_t)geometry_primitives(geo), "%s: %zu references for %d primitives", name,
          references, geometry_primitives(geo));
    kd_free(&kd);
}

static void check_against_brute_force(struct test *t, struct rng *r)
{
    static const struct {
        const char *name;
        int n;
        double size; /* of random triangles; 0: others */
        vec3 offset;
        float scale;
    } CASES[] = {
        {"random", 500, 0.3, {0, 0, 0}, 1},       {"small triangles", 1000, 0.01, {0, 0, 0}, 1},
        {"huge triangles", 100, 50, {0, 0, 0}, 1}, {"far from the origin", 300, 0.3, {1e5, -1e6, 1e7}, 1},
        {"one triangle", 1, 1, {0, 0, 0}, 1},     {"minute world", 300, 0.3, {0, 0, 0}, 1e-22f},
        {"immense world", 300, 0.3, {0, 0, 0}, 5e11f}, {"mixed", 100, 0.3, {0, 0, 0}, 1},
        {"needles", 300, 0, {0, 0, 0}, 1},        {"grids", 8, 0, {0, 0, 0}, 1},
        {"duplicates", 400, 0, {0, 0, 0}, 1},     {"ball", 12, 0, {0, 0, 0}, 1},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct mesh s = {0};
        int n = CASES[i].n;
        switch (CASES[i].size > 0 ? 'r' : CASES[i].name[0]) {
        case 'n': make_needles(&s, r, n); break;
        case 'g': make_grids(&s, n); break;
        case 'd': make_duplicates(&s, r, n); break;
        case 'b': make_ball(&s, r, n, 20, 1, vec(0.1, 0.2, 0.3)); break;
        default: make_random(&s, r, n, CASES[i].size, CASES[i].offset); break;
        }
        for (int k = 0; k < s.n_vertices; k++)
            s.P[k] = mul(s.P[k], CASES[i].scale);
        struct geometry geo = geometry_of(t, &s);
        bool mixed = strcmp(CASES[i].name, "mixed") == 0;
        if (mixed)
            add_quadrics(&geo, r, 60);
        for (int k = 1; mixed && k < geo.n_groups; k += 2)
            geo.group[k].material = -1, geo.group[k].medium[0] = 1; /* bounds of media */
        compare(t, CASES[i].name, &geo, false, r, 3000);
        if (mixed)
            compare(t, "see-through", &geo, true, r, 3000);
        geometry_free(&geo);
    }
}

static void check_empty(struct test *t)
{
    struct geometry geo = {0};
    struct kdtree kd;
    struct ray ray = {vec(0, 0, 0), vec(0, 0, 1), 0, HUGE_VAL, 0, 0};
    struct hit hit;
    kd_build(&kd, &geo, KD_SURFACES);
    CHECK(t, !kd_closest(&kd, &geo, &ray, &hit) && !kd_occluded(&kd, &geo, &ray, INFINITY) && kd.lo[0] > kd.hi[0],
          "a hit in an empty scene, or bounds of nothing that are not inside out");
    kd_free(&kd);
}

/* Rays that are no rays must not hang or crash; what they return does not matter. */
static void check_nonsense_rays(struct test *t, struct rng *r)
{
    struct mesh s = {0};
    make_random(&s, r, 300, 0.3, vec(0, 0, 0));
    struct geometry geo = geometry_of(t, &s);
    struct kdtree kd;
    struct hit hit;
    kd_build(&kd, &geo, KD_SURFACES);
    vec3 odd[4] = {{NAN, 0, 0}, {HUGE_VAL, 0, 0}, {0, 0, 0}, {0, -HUGE_VAL, NAN}};
    for (int i = 0; i < 16; i++) {
        struct ray ray = {odd[i / 4], odd[i % 4], 0, HUGE_VAL, 0, 0};
        CHECK(t, !kd_closest(&kd, &geo, &ray, &hit) || isfinite(hit.t), "a hit at no finite distance");
        kd_occluded(&kd, &geo, &ray, INFINITY);
    }
    kd_free(&kd);
    geometry_free(&geo);
}

/* --- closed surfaces ---------------------------------------------------------------------------------- */

/* Rays from within, aimed at vertices, edges and faces; returns how many get out. */
static int count_escapes(const struct kdtree *kd, const struct geometry *geo, vec3 center, double radius, int n,
                         struct rng *r)
{
    int escaped = 0;
    for (int i = 0; i < n; i++) {
        float v[9];
        int kind = i % 4;
        shape_vertices(geo, (int)rng_below(r, (uint32_t)geo->n_triangles), v);
        vec3 a = vec(v[0], v[1], v[2]), b = vec(v[3], v[4], v[5]);
        vec3 o = add(center, mul(in_cube(r), i % 5 == 0 ? 0 : 0.5 * radius));
        vec3 target = kind == 0 ? a : kind == 1 ? lerp3(0.5, a, b) : lerp3(rng_uniform(r), a, b);
        struct ray ray = {o, normalize(sub(target, o)), 0, HUGE_VAL, 0, 0};
        if (kind == 3)
            ray.d = axis((int)rng_below(r, 6));
        struct hit hit;
        bool closed = kd_closest(kd, geo, &ray, &hit) && kd_occluded(kd, geo, &ray, INFINITY);
        escaped += !closed;
    }
    return escaped;
}

/* A ball lets nothing out; the last, which has a hole, does. */
static void check_watertight(struct test *t, struct rng *r)
{
    static const struct {
        vec3 centre;
        double radius;
    } BALL[] = {{{0, 0, 0}, 1}, {{0.3, -0.7, 1e3}, 1}, {{1e4, 2e4, -3e4}, 1000}, {{0, 0, 0}, 1e-21}, {{0, 0, 0}, 1}};
    const int n = sizeof BALL / sizeof BALL[0];
    for (int i = 0; i < n; i++) {
        struct mesh s = {0};
        struct kdtree kd;
        make_ball(&s, r, 60, 90, BALL[i].radius, BALL[i].centre);
        s.n_triangles -= i == n - 1 ? 9 : 0;
        struct geometry geo = geometry_of(t, &s);
        kd_build(&kd, &geo, KD_SURFACES);
        int escaped = count_escapes(&kd, &geo, BALL[i].centre, BALL[i].radius, 40000, r);
        CHECK(t, (escaped > 0) == (i == n - 1), "ball %d: %d of 40000 rays got out", i, escaped);
        double cost = tree_figures(&kd).cost;
        CHECK(t, cost < 100 && kd.n_nodes > 1000, "a cost of %g with %d nodes is no good tree", cost, kd.n_nodes);
        kd_free(&kd);
        geometry_free(&geo);
    }
}

/* --- alpha -------------------------------------------------------------------------------------------- */

/* Surfaces are there only where b1 < 1/2. */
static bool half_open(const void *context, const struct geometry *geo, const struct hit *hit)
{
    int *asked = *(int *const *)context;
    ++*asked;
    return shape_group_of(geo, hit->prim)->alpha < 0 || hit->b1 < 0.5;
}

static void check_alpha(struct test *t, struct rng *r)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    struct error err;
    int asked = 0, *counter = &asked;
    for (int i = 0; i < 2; i++) {
        struct mesh s = {0};
        struct shape_group g = group_of(0, -1);
        g.alpha = i == 0 ? 0 : -1;
        make_random(&s, r, 200, 0.5, vec(0, 0, 0));
        CHECK(t, shape_add_mesh(&geo, &s, &id, g, false, &err) == i, "%s", err.text);
        mesh_free(&s);
    }
    geo.opaque = half_open;
    geo.opaque_context = &counter;
    struct kdtree kd;
    kd_build(&kd, &geo, KD_SURFACES);
    for (int i = 0; i < 2000; i++) {
        struct ray ray = {in_cube(r), on_sphere(r), 1e-6, HUGE_VAL, 0, 0};
        struct hit a = {0}, b = {0};
        bool want = brute_closest(&geo, false, &ray, &a), got = kd_closest(&kd, &geo, &ray, &b);
        CHECK(t, want == got && (!want || a.t == b.t), "alpha: ray %d hits at %g, not at %g", i, b.t, a.t);
        CHECK(t, want == kd_occluded(&kd, &geo, &ray, INFINITY), "alpha: a shadow ray and another ray differ");
    }
    CHECK(t, asked > 0, "alpha is asked for");
    kd_free(&kd);
    geometry_free(&geo);
}

/* --- figures ------------------------------------------------------------------------------------------ */

/* Planes that cross the whole cube in three directions: no single cut is worth its cost, and yet a ray meets the first
 * of them soon. Spheres around one point: no cut helps, and the tree stays small. */
static void check_crossing(struct test *t, struct rng *r)
{
    enum { MANY = 2000 };
    struct mesh s = {0};
    struct geometry spheres = {0};
    struct kdtree kd;
    for (int i = 0; i < MANY; i++) {
        double z = 2 * rng_uniform(r) - 1;
        vec3 p[3] = {{-1, -1, z}, {1, -1, z}, {1, 1, z}};
        for (int k = 0; k < 3 * (i % 3); k++)
            p[k % 3] = vec(p[k % 3].y, p[k % 3].z, p[k % 3].x);
        add_triangle(&s, p[0], p[1], p[2]);
        struct quadric q = {.kind = QUADRIC_SPHERE, .to_world = transform_identity(), .phi_max = 2 * PI};
        q.radius = q.zmax = (i + 1.0) / MANY;
        q.zmin = -q.radius;
        shape_add_quadric(&spheres, q, group_of(0, -1), false, NULL);
    }
    struct geometry geo = geometry_of(t, &s);
    kd_build(&kd, &geo, KD_SURFACES);
    double most = 0;
    for (int i = 0; i < kd.n_nodes; i++)
        if (i != 1 && kd_is_leaf(kd.node[i]))
            most = fmax(most, kd_blocks(kd.node[i]));
    CHECK(t, most < MANY / KD_LANES / 3, "crossing planes: a leaf of %g blocks", most);
    kd_free(&kd);
    kd_build(&kd, &spheres, KD_SURFACES);
    size_t references = tree_figures(&kd).references;
    CHECK(t, references < 8 * MANY, "concentric spheres: %zu references", references);
    kd_free(&kd);
    geometry_free(&geo);
    geometry_free(&spheres);
}

/* Triangles far smaller than a float's step at the ray's origin are hit where they are. */
static void check_tiny(struct test *t, struct rng *r)
{
    struct mesh s = {0};
    struct kdtree kd;
    struct hit a, b;
    int wrong = 0, hits = 0;
    make_random(&s, r, 500, 5e-7, vec(0, 0, 0));
    struct geometry geo = geometry_of(t, &s);
    kd_build(&kd, &geo, KD_SURFACES);
    for (int i = 0; i < 20000; i++) {
        float v[9];
        bool want;
        shape_vertices(&geo, (int)(rng_uniform(r) * 500), v);
        vec3 p = add(load3(v, 0), mul(add(sub(load3(v, 1), load3(v, 0)), sub(load3(v, 2), load3(v, 0))), 0.3));
        vec3 o = mul(in_cube(r), 3000);
        struct ray ray = {o, normalize(sub(p, o)), 0, INFINITY, 0, 0};
        wrong += !same_as_brute(&kd, &geo, false, &ray, &want, &a, &b);
        hits += want;
    }
    CHECK(t, wrong == 0 && hits > 10000, "tiny triangles: %d of %d hits wrong", wrong, hits);
    kd_free(&kd);
    geometry_free(&geo);
}

void test_kdtree(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 101, 0);
    check_empty(t);
    check_against_brute_force(t, &r);
    check_nonsense_rays(t, &r);
    check_watertight(t, &r);
    check_tiny(t, &r);
    check_crossing(t, &r);
    check_alpha(t, &r);
}
