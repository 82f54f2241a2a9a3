/* test_rival_parts.c: what the methods of test/lab/rivals are made of, each part alone; test_rivals.c has their images. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "base/warp.h"
#include "caustics/specular.h"
#include "rivals/ellipse.h"
#include "rivals/ris.h"
#include "rivals/sdtree.h"
#include "rivals/spcbpt.h"
#include "bench.h"
#include "helpers.h"
#include "oracle.h"
#include "suites.h"

enum { SIDE = 16 };

/* The eye vertex that lies where light vertex x does, the eye walk coming from z with that density, 1/sr, there: what
 * strategies with fewer light vertices have of the same path. */
static struct vertex as_eye_vertex(const struct vertex *x, const struct vertex *z, double pdf)
{
    struct vertex v = *x;
    vec3 d = sub(x->p, z->p);
    v.wo = neg(normalize(d));
    v.kind = VERTEX_SURFACE;
    v.prev_delta = false;
    v.g = vertex_cosine(z, v.wo) / length2(d);
    v.pdf_fwd = pdf * abs_dot(x->ng, v.wo) / length2(d);
    v.beta = rgb_grey(1);
    return v;
}

/* The strategies s, s - 1 ... 0 of the path of s light vertices and two eye vertices, all one after the other weighed
 * by ris: each takes the last light vertex of the one before for an eye vertex. Returns the sum. */
static double sum_weights(struct cache *r, const struct vertex *light, int s, struct vertex *eye)
{
    double sum = 0;
    for (int t = 2; s >= 0; s--, t++) {
        struct vertex *z = &eye[t - 1];
        struct connection c;
        if (s >= 2) {
            struct joint j;
            if (!connect_join(&light[s - 1], z, &j))
                return NAN;
            r->one = r->all = ris_worth(r, &light[s - 1], z);
            c = ris_joint(r, &j);
            eye[t] = as_eye_vertex(&light[s - 1], z, j.pdf_z);
        } else if (s == 1) {
            struct light_point at = vertex_light_point(r->scene, light);
            struct lit l;
            at.pdf = at.pdf_cell = light->pdf_fwd;
            if (!connect_light(r->scene, z, &at, at.pdf, &l))
                return NAN;
            c = ris_lit(r, &l);
            eye[t] = as_eye_vertex(light, z, l.pdf_z);
        } else {
            c = ris_hit(r, &eye[t - 2], z, t);
        }
        sum += rgb_is_black(c.value) ? NAN : c.weight;
    }
    return sum;
}

/* What an eye vertex draws from: probabilities sum to 1, and evenly spread numbers draw by them, each part of the
 * mixture being off by less than one number. */
static void check_mixture(struct test *t, const struct cache *r, const struct vertex *z)
{
    enum { NUMBERS = 5000, MOST = 4000 };
    static int drawn[MOST];
    int V = r->V, which, parts = RECORDS_NEAR + 1;
    double sum = 0, worst = 0;
    if (!CHECK(t, V > 0 && V <= MOST, "%d light vertices", V))
        return;
    struct mixture m = records_mixture(&r->records, r->scene, z, 0.5, false, V);
    memset(drawn, 0, sizeof drawn);
    for (int i = 0; i < NUMBERS; i++)
        drawn[mixture_draw(&m, (i + 0.5) / NUMBERS, &which)]++;
    for (int v = 0; v < V; v++) {
        double P = mixture_pmf(&m, v);
        sum += P;
        worst = fmax(worst, fabs(drawn[v] - P * NUMBERS));
    }
    CHECK(t, fabs(sum - 1) < 1e-12 && worst <= parts, "P sums to 1 but for %g, draws are off by %g", sum - 1, worst);
}

/* Given the pool, the mean of what an eye vertex z_1 draws is the sum over all it could draw, over K. */
static void check_draws(struct test *t, struct cache *r, const char *method, struct sample sample,
                        const struct vertex *z)
{
    enum { BATCHES = 32, DRAWS = 300 };
    struct batches drawn = batches_new(BATCHES, 1, false);
    double expected = 0;
    sample.choice = sampler_start(test_seed(t), RNG_TEST, (uint64_t)sample.x, (uint64_t)sample.y);
    sample.filter_weight = 1;
    for (int v = 0; v < r->V; v++) {
        const struct vertex *y = r->found[v];
        struct joint j;
        r->one = r->all = ris_worth(r, y, z);
        if (drawn_vertex(y, 1).end + 2 > sample.pass->job->max_depth + 2 || !connect_join(y, z, &j))
            continue;
        struct connection k = ris_joint(r, &j);
        expected += rgb_is_black(k.value) ? 0 : rgb_luminance(k.value) * k.weight * (r->u != NULL ? r->u[v] : 1) / r->K;
    }
    for (int b = 0; b < BATCHES; b++) {
        sample.value = rgb_black();
        for (int i = 0; i < DRAWS * test_effort(t); i++)
            ris_join(r, &sample, z, 2);
        drawn.value[b] = rgb_luminance(sample.value) / (DRAWS * test_effort(t));
    }
    if (expected > 0)
        TEST_ACCEPT(t, mean_p(&drawn, expected), "%s, pixel (%d,%d): %g drawn, %g expected", method, sample.x,
                    sample.y, batches_mean(&drawn, NULL), expected);
    batches_free(&drawn);
}

/* Q of a record is what records of another iteration have met, not those of its own. */
static void check_expected(struct test *t, const struct cache *r)
{
    int same = 0;
    for (int i = 0; i < r->records.n; i++) {
        int near[RECORDS_NEAR], n = records_near(&r->records, r->scene, &r->records.item[i].z, 0, near);
        double sum = 0;
        for (int k = 0; k < n; k++)
            sum += r->records.item[near[k]].sum / r->K / n;
        same += fabs(sum - r->records.item[i].expected) < 1e-9 * sum;
    }
    CHECK(t, r->records.n > 0 && same == 0, "%d of %d records know what they have met", same, r->records.n);
}

/* Sums of weights, t = 1 being BDPT's by the oracle, of all light sub-paths of a pool of the given number of them, each
 * joined to the first hit of a pixel; twice, since what roulette has done must not matter. */
static void check_weights(struct test *t, const char *path, const char *method)
{
    struct scene scene;
    struct bench b;
    if (!scene_from_file(t, path, SIDE, SIDE, &scene) || !bench_new(t, &scene, set_method(&scene, method), 5, 0, &b))
        return;
    struct tile_pass pass = bench_pass(&b, 3, 4);
    struct cache r = {.scene = NULL};
    ris_begin(&r, &b.prepared, &pass, 3);
    check_expected(t, &r);
    double worst = 0, weight[16];
    int n = 0;
    for (int k = 0; k < r.K; k++)
        for (int s = 2; s <= r.pool->length[k] && pass_goes_on(&pass, k); s++) {
            const struct vertex *light = pool_path(r.pool, k);
            if (light[s - 1].prev_delta)
                break;
            struct sample sample = sample_begin(&pass, k, 3);
            struct vertex eye[16]; /* longer than the sample's: light vertices follow */
            int n_eye = sample_eye_path(&sample, 2);
            memcpy(eye, sample.eye, 2 * sizeof *eye);
            if (n_eye < 2 || !oracle_weights(&scene, r.counts, light, s, eye, 2, weight))
                continue;
            if (s == 2)
                check_mixture(t, &r, &eye[1]);
            if (s == 2 && k % 20 == 0)
                check_draws(t, &r, method, sample, &eye[1]);
            double sum = sum_weights(&r, light, s, eye) + weight[s + 1];
            worst = sum == sum ? fmax(worst, fabs(sum - 1)) : worst; /* NaN: they do not see each other */
            n += sum == sum;
        }
    CHECK(t, n > 20 && worst < 1e-6, "%s: weights of %d paths sum to 1 but for %g", method, n, worst);
    ris_end(&r);
    bench_free(&b);
    scene_free(&scene);
}

/* ris: the weights of ris (test/lab/rivals): those of all strategies that make a path sum to 1, draws have the
 * probabilities that they say, and records know what they have met. */
void test_ris(struct test *t)
{
    check_weights(t, "scenes/cornell-box-modified.pbrt", "ris records=.02 subpaths=200 rrthreshold=1");
    check_weights(t, "scenes/cornell-box-modified.pbrt", "ris2 records=.02 presampled=30");
    check_weights(t, "scenes/veach-ajar.pbrt", "ris records=.02 subpaths=200");
    check_weights(t, "scenes/many-lights.pbrt", "ris records=.02 subpaths=200 emission=0.2");
}

/* --- the suite sdtree ----------------------------------------------------------------------------------------- */

enum { PASSES = 6, RECORDS = 20000, CELLS = 1 << 9 };

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
    for (int i = 0; i < CELLS * CELLS; i++) {
        double x = (i % CELLS + 0.5) / CELLS, y = (i / CELLS + 0.5) / CELLS, u[2] = {x, y};
        vec3 even = warp_sphere(x, y), drawn = quadtree_draw(q, u);
        sum += quadtree_pdf(q, even);
        wanted += some_light(even);
        mean += some_light(drawn) / quadtree_pdf(q, drawn);
        warp_sphere_inverse(drawn, &x, &y);
        peak += in_peak(x, y);
    }
    double area = 4 * PI / (CELLS * CELLS);
    CHECK(t, fabs(sum * area - 1) < 1e-9, "the density integrates to %.12g", sum * area);
    CHECK(t, fabs(mean / (wanted * 4 * PI) - 1) < 0.01, "what is drawn is off by %g", mean / (wanted * 4 * PI));
    CHECK(t, fabs(peak / (CELLS * CELLS) - 0.5) < 0.08, "%g is drawn in the peak", peak / (CELLS * CELLS));
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

/* sdtree: the tree of `ppg` draws directions with the density that it states, in proportion to light; it halves
 * space where records are, and finds the best share. What images make of it is in test_rivals.c. */
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

/* --- the suite spcbpt ----------------------------------------------------------------------------------------- */

enum { LINKS = 4000, CLASSES = 16 };

/* A path of one edge each, all from (0,0,0) to points of a square, more of them near a corner; both sides of the square
 * are met if `sides`. */
static struct lessons edges(uint64_t seed, bool sides)
{
    struct lessons all = {mem_alloc(LINKS, sizeof *all.lesson), mem_alloc(LINKS, sizeof *all.link), LINKS, LINKS,
                          LINKS};
    struct rng r = rng_stream(seed, RNG_TEST, 0, 0);
    for (int i = 0; i < LINKS; i++) {
        double x = rng_uniform(&r), y = rng_uniform(&r), side = sides && rng_uniform(&r) < 0.5 ? -1 : 1;
        all.lesson[i] = (struct lesson){1, 1, 1};
        all.link[i] = (struct link){{{{0, 0, 0, 0, 0, 1}}, {{x * x, y * y, 0, 0, 0, side}}}, {0, 0}, 1, 1};
    }
    return all;
}

static void free_lessons(struct lessons *all)
{
    free(all->lesson);
    free(all->link);
}

/* All places of the eye ends are the same: one subspace. Those of the light ends have about equal shares. */
static void test_tree(struct test *t)
{
    struct lessons all = edges(test_seed(t), false);
    struct tree_node *eye = learn_tree(&all, 0, CLASSES, vec(0, 0, 0), 2);
    struct tree_node *light = learn_tree(&all, 1, CLASSES, vec(0, 0, 0), 2);
    int of_eye = 0, wrong = 0, share[CLASSES] = {0}, least = LINKS, most = 0;
    for (int i = 0; i < LINKS; i++) {
        int l = all.link[i].label[1];
        of_eye += all.link[i].label[0] != 0;
        wrong += l < 0 || l >= CLASSES || l != tree_find(light, all.link[i].end[1]);
        share[l >= 0 && l < CLASSES ? l : 0]++;
    }
    for (int l = 0; l < CLASSES; l++) {
        least = share[l] < least ? share[l] : least;
        most = share[l] > most ? share[l] : most;
    }
    CHECK(t, of_eye == 0 && wrong == 0, "one place has several subspaces: %d; wrong labels: %d", of_eye, wrong);
    CHECK(t, least > LINKS / CLASSES / 6 && most < 3 * LINKS / CLASSES, "subspaces have %d to %d of %d links", least,
          most, LINKS);
    free(eye);
    free(light);
    free_lessons(&all);
}

/* With subspaces enough, no two links on different sides of a sheet share one. */
static void test_sides(struct test *t)
{
    struct lessons all = edges(test_seed(t), true);
    int mixed = 0;
    double sum[8 * CLASSES] = {0}, n[8 * CLASSES] = {0};
    struct tree_node *light = learn_tree(&all, 1, 8 * CLASSES, vec(0, 0, 0), 2);
    for (int i = 0; i < LINKS; i++) {
        sum[all.link[i].label[1]] += all.link[i].end[1].x[5];
        n[all.link[i].label[1]]++;
    }
    for (int l = 0; l < 8 * CLASSES; l++)
        mixed += fabs(sum[l]) < n[l];
    CHECK(t, mixed == 0, "%d subspaces have both sides of a sheet", mixed);
    free(light);
    free_lessons(&all);
}

/* Three paths of one edge, from eye subspace 0 to a light subspace each, which nothing else makes: J is the sum of
 * square / (ratio each Gamma), and its minimum has Gamma in proportion to the root of square / (ratio each). */
static void test_matrix(struct test *t)
{
    static const double square[3] = {9, 1, 4}, ratio[3] = {1, 2, 0.5}, each[3] = {1, 0.5, 4};
    struct lesson lesson[3];
    struct link link[3];
    struct lessons all = {lesson, link, 3, 3, 3};
    double root[3], total = 0;
    for (int l = 0; l < 3; l++) {
        lesson[l] = (struct lesson){square[l], 1e-12, 1};
        link[l] = (struct link){{{{0}}, {{0}}}, {0, l}, ratio[l], 1};
        root[l] = sqrt(square[l] / (ratio[l] * each[l]));
        total += root[l];
    }
    double *first = learn_gamma(&all, 3, each, 1e12, 0), *best = learn_gamma(&all, 3, each, 1e12, 60);
    for (int l = 0; l < 3; l++) {
        CHECK(t, fabs(first[l] - 1 / 3.0) < 1e-12, "at first Gamma(0,%d) is %g", l, first[l]);
        CHECK(t, fabs(best[l] - root[l] / total) < 1e-9, "Gamma(0,%d) is %g, not %g", l, best[l], root[l] / total);
        CHECK(t, fabs(best[3 + l] - 1 / 3.0) < 1e-12, "where nothing was learnt Gamma(1,%d) is %g", l, best[3 + l]);
    }
    free(first);
    free(best);
}

/* spcbpt: what spcbpt learns (test/lab/rivals/spcbpt_learn.c): trees share out what paths contribute, and tell
 * sides of a sheet apart; the matrix is the one of least variance. */
void test_spcbpt(struct test *t)
{
    test_tree(t);
    test_sides(t);
    test_matrix(t);
}

/* --- the suite ellipse ---------------------------------------------------------------------------------------- */

enum { TRIANGLES = 8 };

/* Two points and a triangle that does not come near them, and all lengths of the ways by it. */
struct placing {
    vec3 y, z, corner[3];
    double least, most;
};

static vec3 around(struct rng *r, vec3 centre, double size)
{
    double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
    return add(centre, mul(vec(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5), size));
}

static double way(const struct placing *s, vec3 x) { return length(sub(x, s->y)) + length(sub(x, s->z)); }

static struct placing any_setting(struct rng *r)
{
    struct placing s = {.y = around(r, vec(-1, 0, 0), 1), .z = around(r, vec(1, 0, 0), 1)};
    for (int i = 0; i < 3; i++) {
        s.corner[i] = around(r, vec(0, 0, 2.5), 2.5);
        s.most = fmax(s.most, way(&s, s.corner[i]));
    }
    s.least = length(sub(s.y, s.z));
    return s;
}

static vec3 point(const struct placing *s, double b1, double b2)
{
    return add(add(mul(s->corner[0], 1 - b1 - b2), mul(s->corner[1], b1)), mul(s->corner[2], b2));
}

/* What arrives by way of the triangle, but for materials. */
static double arrives(const struct placing *s, vec3 x)
{
    return 1 / (length2(sub(x, s->y)) * length2(sub(x, s->z)));
}

/* Points lie where light's way has the length that was asked for. In each of some gates, and in all together, what is
 * drawn brings as much as a sum over small parts of the triangle has; no numbers are random here. */
static void integrals(struct test *t, const struct placing *s)
{
    enum { GATES = 4, FINE = 300, LENGTHS = 256, ANGLES = 64 };
    double sum[GATES] = {0}, total = 0, all = 0, range = (s->most - s->least) / GATES, pdf;
    double area = length(cross(sub(s->corner[1], s->corner[0]), sub(s->corner[2], s->corner[0]))) / 2;
    int off = 0;
    vec3 x;
    for (int i = 0; i < FINE; i++)
        for (int j = 0; i + j < FINE; j++)
            for (int k = 1; k <= 2 && i + j + k <= FINE; k++) {
                x = point(s, (i + k / 3.0) / FINE, (j + k / 3.0) / FINE);
                double f = arrives(s, x) * area / (FINE * FINE);
                sum[(int)fmin((way(s, x) - s->least) / range, GATES - 1)] += f;
                total += f;
            }
    for (int g = 0; g < GATES; g++) {
        double mean = 0;
        for (int i = 0; i < LENGTHS * ANGLES; i++) {
            double tau = s->least + range * (g + (i / ANGLES + 0.5) / LENGTHS), u = (i % ANGLES + 0.5) / ANGLES;
            if (!ellipse_draw(s->y, s->z, s->corner, tau, range, u, &x, &pdf))
                continue;
            mean += arrives(s, x) / pdf / (LENGTHS * ANGLES);
            off += !(fabs(way(s, x) / tau - 1) < 1e-9);
        }
        CHECK(t, fabs(mean - sum[g]) < 0.005 * total, "gate %d: %g, not %g, of %g", g, mean, sum[g], total);
        all += mean;
    }
    CHECK(t, off == 0, "the ways by %d points have other lengths", off);
    CHECK(t, fabs(all / total - 1) < 0.002, "all gates: %g, not %g", all, total);
}

/* ellipse: points of a triangle that give a path the wanted length are drawn with the density that is stated.
 * What pictures of narrow gates make of them is in test_gates.c. */
void test_ellipse(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 73, 0);
    for (int i = 0; i < TRIANGLES; i++) {
        struct placing s = any_setting(&r);
        integrals(t, &s);
    }
}
