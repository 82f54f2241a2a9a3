/* test_regions.c: regions (regions.h) are found again at the finest level that was met. Whoever comes to a point of a
 * flat surface at a round height, from wherever, finds the same region. */
#include "tables/regions.h"

#include "base/rng.h"
#include "helpers.h"
#include "suites.h"

static vec3 random_point(struct rng *r)
{
    double x = 2 * rng_uniform(r) - 1, y = 2 * rng_uniform(r) - 1;
    return vec(x, y, 2 * rng_uniform(r) - 1);
}

static void test_levels(struct test *t, struct rng *r)
{
    enum { CELLS = 8, POINTS = 3000 };
    struct regions a, b;
    regions_init(&a, vec(-1, -1, -1), vec(1, 1, 1), CELLS, 1 << 20);
    const vec3 up = vec(0, 0, 1), p = vec(0.1, 0.1, 0.1);
    CHECK(t, a.n == 1 && region_at(&a, p, up) == 0, "an empty scene is one region");
    int first = regions_add(&a, regions_key(&a, p, up));
    CHECK(t, a.n == 1 + REGION_LEVELS && a.level[first] == 0, "%d regions after the first point", a.n);
    CHECK(t, region_at(&a, p, up) == first, "the point is not found again");
    /* One cube further: its own is not known, but the one above it holds both; the other side of a wall is no kin. */
    int near = region_at(&a, vec(0.3, 0.1, 0.1), up), far = region_at(&a, p, neg(up));
    CHECK(t, near == a.above[first] && far == 0, "neighbour in region %d, other side in %d", near, far);
    for (int i = 0; i < POINTS; i++) {
        vec3 q = random_point(r), n = on_sphere(r);
        int added = regions_add(&a, regions_key(&a, q, n));
        CHECK(t, added == region_at(&a, q, n) && a.above[added] < added && a.level[added] < a.level[a.above[added]],
              "point %d: another region", i);
    }
    regions_init(&b, vec(-1, -1, -1), vec(1, 1, 1), CELLS, 50);
    for (int i = 0; i < POINTS; i++)
        regions_add(&b, regions_key(&b, random_point(r), up));
    CHECK(t, b.n <= 50, "%d regions, the limit is 50", b.n);
    CHECK(t, region_at(&b, vec(NAN, INFINITY, -INFINITY), up) >= 0, "a point that is no point lies nowhere");
    regions_free(&a);
    regions_free(&b);
}

/* The box from the origin to (2,3,6) is 7 long, so 7 cubes are each 1 wide. Within it: surfaces across every axis, in
 * which cubes without a shift would have their sides. */
static const char ROUND[] =
    "Camera \"perspective\" WorldBegin LightSource \"point\"\n" QUAD("1 0 0  1 3 0  1 3 6  1 0 6")
    QUAD("0 2 0  2 2 0  2 2 6  0 2 6") QUAD("0 0 3  2 0 3  2 3 3  0 3 3")
    "Translate 0 0 5 Shape \"disk\" \"float radius\" 4 WorldEnd\n";

static vec3 within_box(struct rng *r)
{
    double x = 2 * rng_uniform(r), y = 3 * rng_uniform(r);
    return vec(x, y, 6 * rng_uniform(r));
}

/* Which share of points that two rays meet has two regions. */
static double unlike(struct test *t, const struct scene *scene, const struct regions *regions, struct rng *r)
{
    enum { POINTS = 20000 };
    int met = 0, differ = 0;
    for (int i = 0; i < POINTS; i++) {
        vec3 from = within_box(r), other = within_box(r);
        struct ray ray = {from, normalize(sub(within_box(r), from)), 0, INFINITY, 0, 0};
        struct surface a, b;
        if (!scene_intersect(scene, &ray, &a))
            continue;
        struct ray second = {other, normalize(sub(a.p, other)), 0, INFINITY, 0, 0};
        if (!scene_intersect(scene, &second, &b) || b.prim_id != a.prim_id || !near3(a.p, b.p, 1e-9))
            continue;
        vec3 n = dot(a.ng, b.ng) > 0 ? b.ng : neg(b.ng); /* the side is another matter: vertex_side */
        met++;
        differ += regions_key(regions, a.p, a.ng) != regions_key(regions, b.p, n);
    }
    CHECK(t, met > POINTS / 10, "only %d points were met twice", met);
    return (double)differ / met;
}

void test_regions(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 95, 0);
    struct scene scene;
    struct regions regions;
    test_levels(t, &r);
    if (!scene_from_text(t, ROUND, &scene))
        return;
    regions_init(&regions, vec(0, 0, 0), vec(2, 3, 6), 7, 1000);
    double shifted = unlike(t, &scene, &regions, &r);
    regions.origin = vec(0, 0, 0);
    double plain = unlike(t, &scene, &regions, &r);
    CHECK(t, shifted == 0, "of surfaces at round heights %g of all points have two regions", shifted);
    CHECK(t, plain > 0.05, "a surface on a border is not noticed: %g of all points have two regions", plain);
    regions_free(&regions);
    scene_free(&scene);
}
