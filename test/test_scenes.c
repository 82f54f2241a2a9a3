/* test_scenes.c: the scenes of scenes/test: known radiance, pairs of light kinds, mirrored worlds, all methods. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../src/stats.h"
#include "helpers.h"
#include "tests.h"

/* p-value of "the expectation lies between low and high". */
static double within_p(const struct batches *b, double low, double high)
{
    double error, mean = batches_mean(b, &error);
    return mean < low ? mean_p(b, low) : mean > high ? mean_p(b, high) : 1;
}

/* Expected radiance, as the comments of the scene files derive it; `low` to `high` where the depth limit cuts a little off. */
static void test_analytic(struct test *t)
{
    static const struct {
        const char *name;
        double low, high;
        int spp;
    } cases[] = {
        {"furnace-sphere", 2 * (1 - 0.5 / 4096), 2 * (1 - 0.5 / 4096), 8},
        {"furnace-open", 0.998, 1, 4},
        {"disk-light", 0.4, 0.4, 32},
        {"glass-sheets", 1.6 - 2e-6, 1.6, 64},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[256];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/test/%s.pbrt", cases[i].name);
        if (!scene_from_file(t, path, 0, 0, &scene))
            continue;
        static const char *const methods[] = {"pt", "bdpt", "asbdpt"};
        for (int m = 0; m < 3; m++) {
            struct batches b = render_batches(t, &scene, methods[m], 0, cases[i].spp, 8, 64, 820 + (uint64_t)m);
            double error, mean = batches_mean(&b, &error);
            TEST_ACCEPT(t, within_p(&b, cases[i].low, cases[i].high), "%s by %s: %.5f +- %.5f, expected %.5f", cases[i].name,
                        methods[m], mean, error, cases[i].high);
            for (long k = 0; k < b.n * b.n_batches; k++)
                b.value[k] *= 1.15;
            TEST_REJECT(t, within_p(&b, cases[i].low, cases[i].high), "%s by %s made 15 %% brighter", cases[i].name, methods[m]);
            batches_free(&b);
        }
        scene_free(&scene);
    }
}

static struct batches render(struct test *t, const char *name, const char *method, int size, int spp, uint64_t seed)
{
    char path[256];
    struct scene scene;
    struct batches b = {0, 0, NULL};
    snprintf(path, sizeof path, "scenes/test/%s.pbrt", name);
    if (!scene_from_file(t, path, size, size, &scene))
        return b;
    b = render_batches(t, &scene, method, 4, spp, 12, size / 2, seed);
    scene_free(&scene);
    return b;
}

/* Two kinds of light in one room: the density with which a light is chosen is where methods differ. */
static void test_light_pairs(struct test *t, int spp)
{
    static const char *const pairs[] = {"area-infinite",  "area-point", "distant-area", "distant-infinite", "distant-point",
                                        "point-infinite", "spot-area",  "spot-distant", "spot-infinite",    "spot-point"};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        char name[64];
        double ratio;
        snprintf(name, sizeof name, "light-%s", pairs[i]);
        struct batches pt = render(t, name, "pt", 16, 2 * spp, 831), bdpt = render(t, name, "bdpt", 16, spp, 832);
        struct batches vertices = render(t, name, "asbdpt", 16, spp, 833);
        double p = batches_p(&pt, &bdpt, &ratio);
        TEST_ACCEPT(t, p, "%s: pt against bdpt, ratio %.4f", name, ratio);
        p = batches_p(&vertices, &pt, &ratio);
        TEST_ACCEPT(t, p, "%s: asbdpt against pt, ratio %.4f", name, ratio);
        for (long k = 0; k < bdpt.n * bdpt.n_batches; k++)
            bdpt.value[k] *= 1.2;
        TEST_REJECT(t, batches_p(&pt, &bdpt, &ratio), "%s: bdpt made 20 %% brighter", name);
        batches_free(&pt);
        batches_free(&bdpt);
        batches_free(&vertices);
    }
}

/* A mirrored world and the same world with its mirrored coordinates written out. */
static void test_mirrored(struct test *t, int spp)
{
    static const char *const methods[] = {"pt", "bdpt"};
    for (int m = 0; m < 2; m++) {
        double ratio;
        struct batches a = render(t, "negative-scale", methods[m], 24, spp, 841);
        struct batches b = render(t, "negative-scale-plain", methods[m], 24, spp, 842);
        double p = batches_p(&a, &b, &ratio);
        TEST_ACCEPT(t, p, "a mirrored world by %s, ratio %.4f", methods[m], ratio);
        batches_free(&a);
        batches_free(&b);
    }
}

static void test_agreement(struct test *t, int spp)
{
    static const char *const scenes[] = {"all-materials", "alpha", "bump",     "instances",     "mirror-glass",
                                         "negative-scale", "quadrics", "smooth-normals", "thin-lens"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        double ratio;
        struct batches pt = render(t, scenes[i], "pt", 24, 2 * spp, 851), bdpt = render(t, scenes[i], "bdpt", 24, spp, 852);
        double p = batches_p(&pt, &bdpt, &ratio);
        TEST_ACCEPT(t, p, "%s: pt against bdpt, ratio %.4f", scenes[i], ratio);
        batches_free(&pt);
        batches_free(&bdpt);
    }
}

void test_scenes(struct test *t)
{
    test_analytic(t);
    test_light_pairs(t, 8);
    test_mirrored(t, 16);
    test_agreement(t, 8);
}

void test_scenes_long(struct test *t)
{
    test_light_pairs(t, 200);
    test_mirrored(t, 400);
    test_agreement(t, 200);
}
