/* test_strategies.c: every strategy (s,t) alone, unweighted, has the expectation of all the others of its path length.
 *
 * Only then may their weights be chosen freely. Six scenes without delta lobes or delta lights, so that every
 * strategy can make every path; surfaces do not touch, so that no connection is short and its geometry factor has a
 * variance. In the second, shading normals lean: without the adjoint factor [V97 5.3] strategies would differ. In the
 * fifth, see-through lamps stand before each other and the sky, so that each strategy must let through what the others
 * do. In the sixth, the light has holes: s = 0 never meets them.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "lab/stats.h"
#include "lab/strategies.h"
#include "render/render.h"
#include "helpers.h"
#include "tests.h"

enum { DEPTH = 3, BATCHES = 16, SPP = 256 };

#define VIEW "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera "
#define PERSPECTIVE VIEW "\"perspective\" \"float fov\" 42\n"
#define ORTHOGRAPHIC VIEW "\"orthographic\" \"float screenwindow\" [-1.6 1.6 -1.4 1.8]\n"
#define ENVIRONMENT "LookAt 0 1.9 -.4  0 .9 0  0 1 1 Camera \"environment\"\n"

#define HEAD(camera) camera                                                                                            \
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"triangle\"\n"                  \
    "WorldBegin\n"                                                                                                     \
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"          \
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 4 -2  2 4 -2  2 4 2  -2 4 2]\n"          \
    "AttributeEnd\n"                                                                                                   \
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6]\n"                                                                       \
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"                                                       \
    "  \"point P\" [-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5]\n"

#define WALL                                                                                                           \
    "Material \"plastic\" \"rgb Kd\" [.5 .6 .7] \"float roughness\" .4\n"                                            \
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"                                                       \
    "  \"point P\" [-2 1 2.5  2 1 2.5  2 3.4 2.5  -2 3.4 2.5] WorldEnd\n"

static const char PLAIN[] = HEAD(PERSPECTIVE) WALL;

static const char LEANING[] = HEAD(PERSPECTIVE)
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 1 2.5  2 1 2.5  2 3.4 2.5  -2 3.4 2.5]\n"
    "  \"normal N\" [-.2 -1 -1  .2 -1 -1  .2 -.8 -1  -.2 -.8 -1]\n"
    "WorldEnd\n";

/* The first scene by the other cameras: t = 1 joins a point to its projection on a plane, and to a point from where the
 * whole sphere is seen, whose picture goes on beyond its edges. */
static const char PARALLEL[] = HEAD(ORTHOGRAPHIC) WALL;
static const char AROUND[] = HEAD(ENVIRONMENT) WALL;

/* See-through lamps: a ball that shines inwards and outwards, between the surfaces and before the eye, and a pane above
 * it that shines to both sides; the sky is behind them. */
static const char LAMPS[] =
    "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera \"perspective\" \"float fov\" 42\n"
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"triangle\" WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [1 1 1] Material \"matte\" \"rgb Kd\" [.8 .7 .6]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 1 2.5  2 1 2.5  2 3.4 2.5  -2 3.4 2.5]\n"
    "Material \"none\" AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 4 -2  2 4 -2  2 4 2  -2 4 2]\n"
    "Translate 0 1.5 .5 Shape \"sphere\" \"float radius\" 1 WorldEnd\n";

/* A light with holes, where it neither shines nor stops light: a chequered alpha texture. */
static const char HOLED[] = PERSPECTIVE
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"triangle\" WorldBegin\n"
    "Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 3 \"float vscale\" 3\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 9] Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 4 -2  2 4 -2  2 4 2  -2 4 2]\n"
    "  \"float uv\" [0 0 1 0 1 1 0 1] \"texture alpha\" \"holes\" AttributeEnd\n"
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6] Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5]\n" WALL;

/* Mean of the unweighted image of each strategy. */
static void strategy_means(const struct strategy_images *images, double *out)
{
    size_t pixels = (size_t)rect_width(images->rect) * (size_t)rect_height(images->rect) * 3;
    for (int i = 0; i < strategy_count(DEPTH); i++) {
        double sum = 0;
        for (size_t k = 0; k < pixels; k++)
            sum += images->unweighted[pixels * (size_t)i + k];
        out[i] = sum / ((double)pixels * (double)images->iterations);
    }
}

/* Differences between two strategies of the same renders: by Student's t over the batches. */
static double paired_p(double (*mean)[64], int a, int b, double factor)
{
    double sum = 0, square = 0;
    for (int k = 0; k < BATCHES; k++) {
        double d = factor * mean[k][a] - mean[k][b];
        sum += d;
        square += d * d;
    }
    double variance = (square - sum * sum / BATCHES) / (BATCHES - 1);
    return stats_student_p(sum / BATCHES / sqrt(variance / BATCHES), BATCHES - 1);
}

static void test_scene(struct test *t, const char *name, const char *text)
{
    struct scene scene;
    static double mean[BATCHES][64];
    if (!scene_from_text(t, text, &scene) || !CHECK(t, strategy_count(DEPTH) <= 64, "too many strategies"))
        return;
    for (int k = 0; k < BATCHES; k++) {
        struct strategy_images images;
        struct error err;
        struct render_options o = {.integrator = "bdpt", .end = SPP * test_effort(t), .max_depth = DEPTH};
        o.n_threads = os_cores();
        o.seed = test_seed(t) * 7919 + (uint64_t)k;
        strategies_init(&images, render_crop(&scene), DEPTH);
        CHECK(t, strategies_render(&scene, &o, &images, &err), "%s", err.text);
        strategy_means(&images, mean[k]);
        strategies_free(&images);
    }
    for (int depth = 1; depth <= DEPTH; depth++)
        for (int s = 1; s <= depth + 1; s++)
            for (int r = 0; r < s; r++) {
                int a = strategy_index(r, depth + 2 - r), b = strategy_index(s, depth + 2 - s);
                double ratio = 0;
                for (int k = 0; k < BATCHES; k++)
                    ratio += mean[k][a] / mean[k][b] / BATCHES;
                CHECK(t, mean[0][a] > 0, "%s: strategy (%d,%d) makes no path", name, r, depth + 2 - r);
                TEST_ACCEPT(t, paired_p(mean, a, b, 1), "%s: strategies (%d,%d) and (%d,%d), ratio %.4f", name, r,
                            depth + 2 - r, s, depth + 2 - s, ratio);
                if (depth == 2)
                    TEST_REJECT(t, paired_p(mean, a, b, 1.25), "%s: (%d,%d) made 25 %% brighter against (%d,%d)", name,
                                r, depth + 2 - r, s, depth + 2 - s);
            }
    scene_free(&scene);
}

static void test_strategy_numbers(struct test *t)
{
    int next = 0;
    for (int depth = 0; depth < 6; depth++)
        for (int s = 0; s <= depth + 1; s++, next++)
            CHECK(t, strategy_index(s, depth + 2 - s) == next, "strategy (%d,%d) has number %d, not %d", s,
                  depth + 2 - s, strategy_index(s, depth + 2 - s), next);
    CHECK(t, strategy_count(5) == next, "%d strategies, not %d", strategy_count(5), next);
}

void test_strategies(struct test *t)
{
    test_strategy_numbers(t);
    test_scene(t, "plain normals", PLAIN);
    test_scene(t, "leaning normals", LEANING);
    test_scene(t, "orthographic camera", PARALLEL);
    test_scene(t, "environment camera", AROUND);
    test_scene(t, "see-through lamps", LAMPS);
    test_scene(t, "a light with holes", HOLED);
}
