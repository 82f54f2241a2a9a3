/* test_kdtree.c: the kd-tree answers exactly what asking every primitive answers.
 *
 * Geometry that builders and traversals get wrong is generated: everything coplanar, everything at one place,
 * needles, far from the origin, one triangle, none. Rays are chosen to be awkward as well: along axes, in planes of
 * splits, through vertices and edges. The distance must be that of brute force to the last bit. Closed surfaces
 * must let no ray out; with one triangle taken away they must.
 */
#include "geometry/kdtree.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "base/warp.h"
#include "tests.h"

/* --- geometry ----------------------------------------------------------------------------------------- */

/* A mesh that grows; every triangle has vertices of its own unless given by index. */
struct soup {
    struct mesh mesh;
    size_t vertex_capacity, index_capacity;
};

static uint32_t add_vertex(struct soup *s, vec3 p)
{
    size_t n = (size_t)s->mesh.n_vertices;
    s->mesh.P = mem_grow(s->mesh.P, &s->vertex_capacity, n + 1, 3 * sizeof *s->mesh.P);
    s->mesh.P[3 * n] = (float)p.x;
    s->mesh.P[3 * n + 1] = (float)p.y;
    s->mesh.P[3 * n + 2] = (float)p.z;
    return (uint32_t)s->mesh.n_vertices++;
}

static void add_face(struct soup *s, uint32_t a, uint32_t b, uint32_t c)
{
    size_t n = (size_t)s->mesh.n_triangles;
    s->mesh.index = mem_grow(s->mesh.index, &s->index_capacity, n + 1, 3 * sizeof *s->mesh.index);
    s->mesh.index[3 * n] = a;
    s->mesh.index[3 * n + 1] = b;
    s->mesh.index[3 * n + 2] = c;
    s->mesh.n_triangles++;
}

static void add_triangle(struct soup *s, vec3 a, vec3 b, vec3 c)
{
    uint32_t ia = add_vertex(s, a), ib = add_vertex(s, b), ic = add_vertex(s, c);
    add_face(s, ia, ib, ic);
}

static struct shape_group plain_group(void)
{
    struct shape_group g = {0};
    g.alpha = g.shadow_alpha = g.first_light = -1;
    return g;
}

/* Move the soup into a geometry. */
static struct geometry geometry_of(struct test *t, struct soup *s)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    struct error err;
    if (s->mesh.n_triangles > 0)
        CHECK(t, shape_add_mesh(&geo, &s->mesh, &id, plain_group(), false, &err) == 0, "%s", err.text);
    mesh_free(&s->mesh);
    return geo;
}

static vec3 in_cube(struct rng *r)
{
    double x = rng_uniform(r), y = rng_uniform(r), z = rng_uniform(r);
    return vec(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

static vec3 on_sphere(struct rng *r)
{
    double u1 = rng_uniform(r), u2 = rng_uniform(r);
    return warp_sphere(u1, u2);
}

/* Move everything nearer to the origin, or away from it. */
static void scale_soup(struct soup *s, float factor)
{
    for (int i = 0; i < 3 * s->mesh.n_vertices; i++)
        s->mesh.P[i] *= factor;
}

static void make_random(struct soup *s, struct rng *r, int n, double size, vec3 offset)
{
    for (int i = 0; i < n; i++) {
        vec3 c = add(in_cube(r), offset);
        vec3 e1 = mul(in_cube(r), size), e2 = mul(in_cube(r), size);
        add_triangle(s, c, add(c, e1), add(c, e2));
    }
}

/* Long and thin in every direction, and some of no area at all. */
static void make_needles(struct soup *s, struct rng *r, int n)
{
    for (int i = 0; i < n; i++) {
        vec3 a = in_cube(r), b = in_cube(r), w = mul(in_cube(r), 1e-5);
        add_triangle(s, a, b, i % 10 == 0 ? lerp3(0.5, a, b) : add(b, w));
    }
}

/* Axis-aligned squares on integer coordinates: three grids that cross each other, one of them twice. */
static void make_grids(struct soup *s, int n)
{
    for (int layer = 0; layer < 4; layer++)
        for (int i = 0; i < n; i++)
            for (int k = 0; k < n; k++) {
                double x = i, y = k;
                vec3 p[4] = {vec(x, y, 2), vec(x + 1, y, 2), vec(x + 1, y + 1, 2), vec(x, y + 1, 2)};
                for (int c = 0; c < 4; c++)
                    p[c] = layer == 0   ? vec(p[c].z, p[c].x, p[c].y)
                           : layer == 1 ? vec(p[c].x, p[c].z, p[c].y)
                                        : p[c];
                add_triangle(s, p[0], p[1], p[2]);
                add_triangle(s, p[0], p[2], p[3]);
            }
}

/* The same triangle many times, and a few others. */
static void make_duplicates(struct soup *s, struct rng *r, int n)
{
    vec3 a = in_cube(r), b = in_cube(r), c = in_cube(r);
    for (int i = 0; i < n; i++)
        add_triangle(s, a, b, c);
    make_random(s, r, 20, 0.5, vec(0, 0, 0));
}

/* A closed surface: a sphere of rows x columns quads, radius varied a little, vertices shared. */
static void make_ball(struct soup *s, struct rng *r, int rows, int columns, double radius, vec3 center)
{
    uint32_t south = add_vertex(s, add(center, vec(0, 0, -radius))), first = south + 1;
    for (int i = 1; i < rows; i++)
        for (int k = 0; k < columns; k++) {
            double theta = PI * i / rows, phi = 2 * PI * k / columns, l = radius * (1 + 0.01 * rng_uniform(r));
            add_vertex(s, add(center, vec(l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta))));
        }
    uint32_t north = add_vertex(s, add(center, vec(0, 0, radius))), m = (uint32_t)columns;
    for (uint32_t k = 0; k < m; k++) {
        uint32_t next = (k + 1) % m, last = first + (uint32_t)(rows - 2) * m;
        add_face(s, south, first + next, first + k);
        add_face(s, north, last + k, last + next);
        for (uint32_t i = 0; i + 2 < (uint32_t)rows; i++) {
            uint32_t row = first + i * m;
            add_face(s, row + k, row + next, row + m + next);
            add_face(s, row + k, row + m + next, row + m + k);
        }
    }
}

static void add_quadrics(struct geometry *geo, struct rng *r, int n)
{
    for (int i = 0; i < n; i++) {
        struct transform move = transform_translate(in_cube(r));
        struct transform turn = transform_rotate(360 * rng_uniform(r), on_sphere(r));
        struct transform scale = transform_scale(1, 0.5 + rng_uniform(r), i % 2 == 0 ? -1 : 2);
        struct quadric q = {.kind = (enum quadric_kind)(i % 6), .radius = 0.2, .inner_radius = 0.05, .zmax = 0.15};
        q.to_world = transform_compose(move, transform_compose(turn, scale));
        q.zmin = i % 6 < 3 ? -0.1 : 0;
        q.phi_max = i % 4 == 0 ? 4 : 2 * PI;
        q.p1 = vec(0.1, -0.1, -0.1);
        q.p2 = vec(0.1, 0.2, 0.15);
        if (q.kind == QUADRIC_DISK)
            q.zmin = q.zmax = 0.1;
        shape_add_quadric(geo, q, plain_group(), false, NULL);
    }
}

/* --- rays --------------------------------------------------------------------------------------------- */

static int prim_number(const struct geometry *geo, int i)
{
    return i < geo->n_triangles ? i : FIRST_QUADRIC + i - geo->n_triangles;
}

/* A point of the geometry: inside a primitive, a vertex, or the middle of an edge. */
static vec3 some_point(const struct geometry *geo, struct rng *r)
{
    int i = (int)rng_below(r, (uint32_t)geometry_primitives(geo)), kind = (int)rng_below(r, 3);
    if (i < geo->n_triangles && kind > 0) {
        float v[9];
        shape_vertices(geo, i, v);
        vec3 a = vec(v[0], v[1], v[2]), b = vec(v[3], v[4], v[5]);
        return kind == 1 ? a : lerp3(0.5, a, b);
    }
    struct surface at;
    double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
    shape_sample(geo, prim_number(geo, i), u1, u2, &at, &pdf);
    return at.p;
}

static vec3 axis(int i)
{
    double sign = i % 2 == 0 ? 1 : -1;
    return vec(i / 2 == 0 ? sign : 0, i / 2 == 1 ? sign : 0, i / 2 == 2 ? sign : 0);
}

static struct ray awkward_ray(const struct geometry *geo, struct rng *r, double size)
{
    vec3 p = some_point(geo, r), q = some_point(geo, r), out = mul(on_sphere(r), 2 * size);
    struct ray ray = {p, on_sphere(r), 0, HUGE_VAL, 0, 0};
    switch (rng_below(r, 7)) {
    case 0: ray.d = axis((int)rng_below(r, 6)); break; /* from a point, along an axis */
    case 1: ray.d = normalize(sub(q, p)); break;       /* from point to point */
    case 2:
        ray.o = add(p, out);
        ray.d = normalize(neg(out));
        break; /* from outside, at a point */
    case 3:
        ray.d = axis((int)rng_below(r, 6));
        ray.o = sub(p, mul(ray.d, 2 * size));
        break; /* along an axis at it */
    case 4:
        ray.d.z = 0;
        ray.d = normalize(ray.d);
        break;                          /* within a plane */
    case 5: ray.o = add(p, out); break; /* mostly past everything */
    default: break;
    }
    if (!(length(ray.d) > 0.5))
        ray.d = vec(0, 0, 1);
    ray.tmin = rng_below(r, 2) == 0 ? 0 : 1e-6 * size;
    ray.tmax = rng_below(r, 3) == 0 ? size * rng_uniform(r) : HUGE_VAL;
    return ray;
}

/* --- comparison --------------------------------------------------------------------------------------- */

/* see_through: among the primitives without material, else among those with one. */
static bool brute_closest(const struct geometry *geo, bool see_through, const struct ray *ray, struct hit *hit)
{
    bool found = false;
    for (int i = 0; i < geometry_primitives(geo); i++) {
        struct hit h;
        if ((shape_group_of(geo, prim_number(geo, i))->material < 0) != see_through ||
            !shape_intersect(geo, prim_number(geo, i), ray, &h) || (found && !(h.t < hit->t)))
            continue;
        if (geo->opaque != NULL && !geo->opaque(geo->opaque_context, geo, &h, false))
            continue;
        *hit = h;
        found = true;
    }
    return found;
}

/* Does the tree say the same of this ray as all primitives one by one? *want, *a: what they say. */
static bool same_as_brute(const struct kdtree *kd, const struct geometry *geo, bool see_through, const struct ray *ray,
                          bool *want, struct hit *a, struct hit *b)
{
    *want = brute_closest(geo, see_through, ray, a);
    bool got = kd_closest(kd, geo, ray, b);
    return *want == got && (!*want || a->t == b->t) && kd_occluded(kd, geo, ray) == *want;
}

/* Every ray is traced as it is, again as if it began on the triangle it hit, and again as if it ended on the next. */
static void compare(struct test *t, const char *name, const struct geometry *geo, bool see_through, struct rng *r,
                    int n_rays)
{
    struct kdtree kd;
    int wrong = 0, hits = 0;
    kd_build(&kd, geo, see_through);
    double size = 0;
    for (int k = 0; k < 3; k++)
        size = fmax(size, (double)kd.hi[k] - (double)kd.lo[k]);
    for (int i = 0; i < n_rays; i++) {
        struct ray ray = awkward_ray(geo, r, size);
        struct hit a = {0}, b = {0};
        bool want, next = false, same = same_as_brute(&kd, geo, see_through, &ray, &want, &a, &b);
        hits += want;
        if (same && want && geo->opaque == NULL) {
            ray.from = shape_prim_id(a.prim);
            same = same_as_brute(&kd, geo, see_through, &ray, &next, &a, &b);
        }
        if (same && next) {
            ray.to = shape_prim_id(a.prim);
            same = same_as_brute(&kd, geo, see_through, &ray, &next, &a, &b);
        }
        wrong += !same;
        if (!same && wrong == 1)
            CHECK(t, false, "%s, ray %d o (%.17g %.17g %.17g) d (%.17g %.17g %.17g): hit at %.17g, not %.17g", name, i,
                  ray.o.x, ray.o.y, ray.o.z, ray.d.x, ray.d.y, ray.d.z, b.t, a.t);
    }
    CHECK(t, wrong == 0, "%s: %d of %d rays wrong", name, wrong, n_rays);
    CHECK(t, n_rays == 0 || hits > n_rays / 20, "%s: only %d of %d rays hit anything: a poor test", name, hits,
          n_rays);
    CHECK(t, kd.n_items <= 32 * geometry_primitives(geo), "%s: %d references for %d primitives", name, kd.n_items,
          geometry_primitives(geo));
    kd_free(&kd);
}

static void check_against_brute_force(struct test *t, struct rng *r)
{
    enum { RANDOM, TINY, LARGE, OFFSET, NEEDLES, GRIDS, DUPLICATES, SINGLE, BALL, MINUTE, IMMENSE, MIXED, N };
    static const char *const names[N] = {"random",  "small triangles", "huge triangles", "far from the origin",
                                         "needles", "grids",           "duplicates",     "one triangle",
                                         "ball",    "minute world",    "immense world",  "mixed"};
    for (int i = 0; i < N; i++) {
        struct soup s = {{0}, 0, 0};
        switch (i) {
        case RANDOM: make_random(&s, r, 500, 0.3, vec(0, 0, 0)); break;
        case TINY: make_random(&s, r, 1000, 0.01, vec(0, 0, 0)); break;
        case LARGE: make_random(&s, r, 100, 50, vec(0, 0, 0)); break;
        case OFFSET: make_random(&s, r, 300, 0.3, vec(1e5, -1e6, 1e7)); break;
        case NEEDLES: make_needles(&s, r, 300); break;
        case GRIDS: make_grids(&s, 8); break;
        case DUPLICATES: make_duplicates(&s, r, 400); break;
        case SINGLE: make_random(&s, r, 1, 1, vec(0, 0, 0)); break;
        case BALL: make_ball(&s, r, 12, 20, 1, vec(0.1, 0.2, 0.3)); break;
        case MINUTE: make_random(&s, r, 300, 0.3, vec(0, 0, 0)); break;
        case IMMENSE: make_random(&s, r, 300, 0.3, vec(0, 0, 0)); break;
        default: make_random(&s, r, 100, 0.3, vec(0, 0, 0)); break;
        }
        if (i == MINUTE || i == IMMENSE)
            scale_soup(&s, i == MINUTE ? 1e-22f : 1e15f);
        struct geometry geo = geometry_of(t, &s);
        if (i == MIXED)
            add_quadrics(&geo, r, 60);
        for (int k = 1; i == MIXED && k < geo.n_groups; k += 2)
            geo.group[k].material = -1;
        compare(t, names[i], &geo, false, r, 3000);
        if (i == MIXED)
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
    kd_build(&kd, &geo, false);
    CHECK(t, !kd_closest(&kd, &geo, &ray, &hit) && !kd_occluded(&kd, &geo, &ray), "a hit in an empty scene");
    CHECK(t, kd.lo[0] > kd.hi[0], "bounds of nothing are not inside out");
    kd_free(&kd);
}

/* Rays that are no rays must not hang or crash; what they return does not matter. */
static void check_nonsense_rays(struct test *t, struct rng *r)
{
    struct soup s = {{0}, 0, 0};
    make_random(&s, r, 300, 0.3, vec(0, 0, 0));
    struct geometry geo = geometry_of(t, &s);
    struct kdtree kd;
    struct hit hit;
    kd_build(&kd, &geo, false);
    vec3 odd[4] = {{NAN, 0, 0}, {HUGE_VAL, 0, 0}, {0, 0, 0}, {0, -HUGE_VAL, NAN}};
    for (int i = 0; i < 16; i++) {
        struct ray ray = {odd[i / 4], odd[i % 4], 0, HUGE_VAL, 0, 0};
        CHECK(t, !kd_closest(&kd, &geo, &ray, &hit) || isfinite(hit.t), "a hit at no finite distance");
        kd_occluded(&kd, &geo, &ray);
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
        bool closed = kd_closest(kd, geo, &ray, &hit) && kd_occluded(kd, geo, &ray);
        escaped += !closed;
    }
    return escaped;
}

static void check_watertight(struct test *t, struct rng *r)
{
    vec3 center[3] = {vec(0, 0, 0), vec(0.3, -0.7, 1e3), vec(1e4, 2e4, -3e4)};
    for (int i = 0; i < 3; i++) {
        struct soup s = {{0}, 0, 0};
        struct kdtree kd;
        make_ball(&s, r, 60, 90, i == 2 ? 1000 : 1, center[i]);
        struct geometry geo = geometry_of(t, &s);
        kd_build(&kd, &geo, false);
        int escaped = count_escapes(&kd, &geo, center[i], i == 2 ? 1000 : 1, 40000, r);
        CHECK(t, escaped == 0, "ball %d: %d of 40000 rays got out", i, escaped);
        kd_free(&kd);
        geometry_free(&geo);
    }
}

/* The companion that must fail: with a hole, rays do get out. */
static void check_hole(struct test *t, struct rng *r)
{
    struct soup s = {{0}, 0, 0};
    struct kdtree kd;
    make_ball(&s, r, 12, 12, 1, vec(0, 0, 0));
    s.mesh.n_triangles -= 3;
    struct geometry geo = geometry_of(t, &s);
    kd_build(&kd, &geo, false);
    CHECK(t, count_escapes(&kd, &geo, vec(0, 0, 0), 1, 4000, r) > 0, "nothing gets out through a hole");
    kd_free(&kd);
    geometry_free(&geo);
}

/* --- alpha -------------------------------------------------------------------------------------------- */

/* Surfaces are there only where b1 < 1/2; for shadow rays only where b2 < 1/4 as well. */
static bool half_open(const void *context, const struct geometry *geo, const struct hit *hit, bool shadow)
{
    int *asked = *(int *const *)context;
    ++*asked;
    return shape_group_of(geo, hit->prim)->alpha < 0 || (hit->b1 < 0.5 && !(shadow && hit->b2 >= 0.25));
}

static void check_alpha(struct test *t, struct rng *r)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    struct error err;
    int asked = 0, *counter = &asked, lit = 0;
    for (int i = 0; i < 2; i++) {
        struct soup s = {{0}, 0, 0};
        struct shape_group g = plain_group();
        g.alpha = i == 0 ? 0 : -1;
        make_random(&s, r, 200, 0.5, vec(0, 0, 0));
        CHECK(t, shape_add_mesh(&geo, &s.mesh, &id, g, false, &err) == i, "%s", err.text);
        mesh_free(&s.mesh);
    }
    geo.opaque = half_open;
    geo.opaque_context = &counter;
    struct kdtree kd;
    kd_build(&kd, &geo, false);
    for (int i = 0; i < 2000; i++) {
        struct ray ray = {in_cube(r), on_sphere(r), 1e-6, HUGE_VAL, 0, 0};
        struct hit a = {0}, b = {0};
        bool want = brute_closest(&geo, false, &ray, &a), got = kd_closest(&kd, &geo, &ray, &b);
        CHECK(t, want == got && a.t == b.t, "alpha: ray %d hits at %g, not at %g", i, b.t, a.t);
        lit += want && !kd_occluded(&kd, &geo, &ray);
        CHECK(t, want || !kd_occluded(&kd, &geo, &ray), "a shadow ray is stopped where no ray is");
    }
    CHECK(t, asked > 0 && lit > 0, "alpha: asked %d times, %d rays pass only as shadow rays", asked, lit);
    kd_free(&kd);
    geometry_free(&geo);
}

/* The same geometry gives the same tree, byte by byte in what can be seen of it. */
static void check_repeatable(struct test *t, struct rng *r)
{
    struct soup s = {{0}, 0, 0};
    struct kdtree a, b;
    make_random(&s, r, 2000, 0.1, vec(0, 0, 0));
    struct geometry geo = geometry_of(t, &s);
    kd_build(&a, &geo, false);
    kd_build(&b, &geo, false);
    CHECK(t, a.n_nodes == b.n_nodes && a.n_items == b.n_items && a.cost == b.cost && a.depth == b.depth,
          "trees differ");
    CHECK(t, a.cost < 200 && a.n_nodes > 100, "a cost of %g with %d nodes is no good tree", a.cost, a.n_nodes);
    kd_free(&a);
    kd_free(&b);
    geometry_free(&geo);
}

void test_kdtree(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 101, 0);
    check_empty(t);
    check_against_brute_force(t, &r);
    check_nonsense_rays(t, &r);
    check_watertight(t, &r);
    check_hole(t, &r);
    check_alpha(t, &r);
    check_repeatable(t, &r);
}
