/* test_sdtree.c: the tree of `ppg` draws directions with the density that it states, in proportion to light; it halves
 * space where records are, and finds the best share. What images make of it is in test_rivals.c. */
#include "rivals/sdtree.h"

#include <math.h>

#include "base/number.h"
#include "base/rng.h"
#include "base/warp.h"
#include "suites.h"

enum { PASSES = 6, RECORDS = 20000, FINE = 1 << 9 };

static vec3 any_point(struct rng *r)
{
    double x = rng_uniform(r), y = rng_uniform(r);
    return vec(x, y, rng_uniform(r));
}

/* Where half of the light comes from: a square of directions. */
static bool in_peak(double u, double v) { return u >= 0.25 && u < 0.3125 && v >= 0.5 && v < 0.5625; }

/* Uniform directions that see light of 1, and as much from the peak as from everywhere. */
static void add_lights(struct sdtree *t, struct rng *r)
{
    for (int i = 0; i < RECORDS; i++) {
        struct sd_leaf *leaf = &t->node[sdtree_find(t, any_point(r), NULL)].leaf;
        double u = rng_uniform(r), v = rng_uniform(r);
        sd_add_record(leaf, 1, 0.5);
        sd_add_light(leaf, u, v, 1);
        sd_add_light(leaf, 0.25 + u / 16, 0.5 + v / 16, 1);
    }
}

/* --- directions -------------------------------------------------------------------------------------- */

static double some_light(vec3 w) { return 1 + w.z + sqr(w.x); }

/* The density integrates to 1; what is drawn by evenly spaced numbers has it, and is half in the peak. */
static void test_directions(struct test *t, const struct quadtree *q)
{
    double sum = 0, mean = 0, peak = 0, wanted = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        double x = (i % FINE + 0.5) / FINE, y = (i / FINE + 0.5) / FINE, u[2] = {x, y};
        vec3 even = warp_sphere(x, y), drawn = quadtree_draw(q, u);
        sum += quadtree_pdf(q, even);
        wanted += some_light(even);
        mean += some_light(drawn) / quadtree_pdf(q, drawn);
        warp_sphere_inverse(drawn, &x, &y);
        peak += in_peak(x, y);
    }
    double area = 4 * PI / (FINE * FINE);
    CHECK(t, fabs(sum * area - 1) < 1e-9, "the density integrates to %.12g", sum * area);
    CHECK(t, fabs(mean / (wanted * 4 * PI) - 1) < 0.01, "what is drawn is off by %g", mean / (wanted * 4 * PI));
    CHECK(t, fabs(peak / (FINE * FINE) - 0.5) < 0.08, "%g is drawn in the peak", peak / (FINE * FINE));
}

/* --- space ------------------------------------------------------------------------------------------- */

/* The leaf of a point has edges that are halves of the cube's; a point that is none has a leaf. */
static void test_space(struct test *t, const struct sdtree *tree, struct rng *r)
{
    double volume = 0;
    vec3 size;
    for (int i = 0; i < RECORDS; i++) {
        sdtree_find(tree, any_point(r), &size);
        volume += size.x * size.y * size.z / RECORDS;
        CHECK(t, size.x <= size.y && size.y <= size.z && size.z <= 2 * size.x, "edges %g %g %g", size.x, size.y,
              size.z);
    }
    CHECK(t, tree->n == 2 * 32 - 1 && fabs(volume - 1.0 / 32) < 1e-12, "%d nodes, volume %g", tree->n, volume);
    int far = sdtree_find(tree, vec(NAN, INFINITY, -INFINITY), NULL);
    CHECK(t, far == sdtree_find(tree, vec(0, 1, 0), NULL), "a point that is no point");
}

/* --- the share --------------------------------------------------------------------------------------- */

/* Two directions, of which BSDF and guide draw the first with probability 0.9 and 0.2. Contributions are those of a
 * mixture. Its share is found, if neither is left too little. */
static void test_share(struct test *t, double share, double wanted)
{
    struct sdtree tree;
    double first = share * 0.9 + (1 - share) * 0.2;
    sdtree_init(&tree, vec(0, 0, 0), vec(1, 1, 1));
    for (int pass = 0; pass < PASSES; pass++) {
        sd_add_light(&tree.node->leaf, 0.5, 0.5, 1);
        sd_add_record(&tree.node->leaf, first, 0.9 / 1.1);
        sd_add_record(&tree.node->leaf, 1 - first, 0.1 / 0.9);
        sdtree_build(&tree, INFINITY);
    }
    CHECK(t, fabs(tree.node->leaf.share - wanted) < 1e-6, "share %g, not %g", tree.node->leaf.share, wanted);
    sdtree_free(&tree);
}

void test_sdtree(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 91, 0);
    struct sdtree tree;
    sdtree_init(&tree, vec(0, 0, 0), vec(1, 1, 1));
    for (int pass = 0; pass < PASSES; pass++) {
        add_lights(&tree, &r);
        sdtree_build(&tree, RECORDS / 24);
    }
    test_directions(t, &tree.node[sdtree_find(&tree, vec(0.4, 0.4, 0.4), NULL)].leaf.known);
    test_space(t, &tree, &r);
    sdtree_free(&tree);
    test_share(t, 0.3, 0.3);
    test_share(t, 0.75, 0.75);
    test_share(t, 0, 0.1);
    test_share(t, 1, 0.9);
}
