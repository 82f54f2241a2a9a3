/* test_spcbpt.c: what spcbpt learns (test/lab/rivals/spcbpt_learn.c): trees share out what paths contribute, and tell
 * sides of a sheet apart; the matrix is the one of least variance. */
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/rng.h"
#include "rivals/spcbpt.h"
#include "suites.h"

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

void test_spcbpt(struct test *t)
{
    test_tree(t);
    test_sides(t);
    test_matrix(t);
}
