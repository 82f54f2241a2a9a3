/* test_figures.c: work and noise of small renders against stored numbers, to find faults that change no expectation.
 * What a render costs and what it brings for that are counted, no clock is asked, and compared with what they were
 * when the figures below were written down: a change that is meant to move them writes them anew. */
#include <math.h>
#include <stdio.h>

#include "lab/tree.h"
#include "helpers.h"
#include "learning/learn.h"
#include "tests.h"

/* Is the figure what it was, but for this share? */
static void figure(struct test *t, const char *name, double value, double was, double share)
{
    CHECK(t, fabs(value / was - 1) <= share, "%s: %.4g, but it was %.4g", name, value, was);
}

/* --- rays -------------------------------------------------------------------------------------------- */

/* The expected cost of a ray, in tests of a block of triangles. */
static void test_trees(struct test *t)
{
    static const struct {
        const char *name;
        double cost;
    } trees[] = {{"forest", 42.9}, {"living-room", 31.3}, {"many-lights", 34.3}, {"veach-ajar", 23.9}};
    for (size_t i = 0; i < sizeof trees / sizeof trees[0]; i++) {
        char path[64];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/%s.pbrt", trees[i].name);
        if (!scene_from_file(t, path, 0, 0, &scene))
            continue;
        figure(t, path, tree_figures(&scene.kd).cost, trees[i].cost, 0.03);
        scene_free(&scene);
    }
}

/* --- what is learnt ---------------------------------------------------------------------------------- */

/* How far the worth of pairs of regions is from even: the mean of h^2 over that of h, squared. */
static void test_pairs_learnt(struct test *t)
{
    static const struct learn_options all = {.importance = true, .guide = true, .pairs = true, .eye_cells = 8,
                                             .light_cells = 16, .levels = REGION_LEVELS, .delta = 0.1, .emission = 0.2};
    static const struct {
        const char *path;
        double unevenness;
    } cases[] = {{"scenes/veach-ajar.pbrt", 4.78}, {"scenes/corridor.pbrt", 5.95}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        double sum = 0, square = 0;
        if (!scene_from_file(t, cases[i].path, 32, 24, &scene))
            continue;
        struct render_job job = {.scene = &scene, .film_rect = render_crop(&scene), .seed = 3, .eye_seed = 3,
                                 .max_depth = 5, .n_threads = 2, .rr_threshold = 0.5, .spatial_lights = true};
        struct tables l = learn(&job, &all);
        for (int k = 0; k < l.pairs.n_eye * l.pairs.n_light; k++) {
            sum += l.pairs.h[k] / (l.pairs.n_eye * l.pairs.n_light);
            square += sqr(l.pairs.h[k]) / (l.pairs.n_eye * l.pairs.n_light);
        }
        figure(t, cases[i].path, square / sqr(sum), cases[i].unevenness, 0.03);
        tables_free(&l);
        scene_free(&scene);
    }
}

void test_figures(struct test *t)
{
    test_trees(t);
    test_pairs_learnt(t);
}
