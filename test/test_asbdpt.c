/* test_asbdpt.c: selection of light sub-paths: the unbiased ways agree with path tracing, the dissertation's does
 * not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "render/render.h"
#include "base/stats.h"
#include "helpers.h"
#include "tests.h"

/* Set integrator parameters given as "name=value name=value". */
static void set(struct scene *scene, const char *parameters)
{
    char text[256], *rest = text;
    snprintf(text, sizeof text, "%s", parameters);
    for (char *end; *rest != '\0'; rest = end) {
        end = rest + strcspn(rest, " ");
        if (*end == ' ')
            *end++ = '\0';
        char *equals = strchr(rest, '=');
        *equals = '\0';
        settings_set(&scene->settings, rest, equals + 1, "test");
    }
}

static struct batches batches_of(struct test *t, struct scene *scene, const char *parameters, int spp, int n,
                                 uint64_t seed)
{
    set(scene, parameters);
    return render_batches(t, scene, "asbdpt", 4, spp, n, 16, seed);
}

/* --- bias -------------------------------------------------------------------------------------------- */

/* The same test, the same number of samples: bdpt, pool and vertices pass, bins does not. */
static void test_bias(struct test *t)
{
    static const struct {
        const char *parameters;
        bool unbiased;
    } cases[] = {{"select=pool metric=constant", true}, {"select=pool metric=throughput", true},
                 {"select=pool metric=importance", true}, {"select=vertices metric=importance connections=2", true},
                 {"select=vertices metric=constant connections=2", true}, {"select=subspaces", true},
                 {"select=subspaces connections=2", true}, {"select=bins", false}};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 32, 32, &scene))
        return;
    enum { BATCHES = 16, SPP = 32 };
    double ratio;
    struct batches pt = render_batches(t, &scene, "pt", 4, 4 * SPP, BATCHES, 16, 51);
    struct batches bdpt = render_batches(t, &scene, "bdpt", 4, SPP, BATCHES, 16, 52);
    double p = batches_p(&bdpt, &pt, &ratio);
    TEST_ACCEPT(t, p, "Cornell box, bdpt against pt: ratio %.4f", ratio);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct batches x = batches_of(t, &scene, cases[i].parameters, SPP, BATCHES, 53);
        p = batches_p(&x, &pt, &ratio);
        if (cases[i].unbiased)
            TEST_ACCEPT(t, p, "Cornell box, %s against pt: ratio %.4f", cases[i].parameters, ratio);
        else
            TEST_REJECT(t, p, "Cornell box, %s against pt: ratio %.4f", cases[i].parameters, ratio);
        if (!cases[i].unbiased)
            printf("  bias of %s on the Cornell box: %+.2f %% of the mean, p = %.1g\n", cases[i].parameters,
                   100 * (ratio - 1), p);
        batches_free(&x);
    }
    batches_free(&pt);
    batches_free(&bdpt);
    scene_free(&scene);
}

/* --- pool with a constant metric is BDPT ------------------------------------------------------------- */

/* Replace every batch by its squared deviations from the mean over batches, so that a test of means tests variances. */
static void square_deviations(struct batches *b)
{
    for (long i = 0; i < b->n; i++) {
        double mean = 0;
        for (int k = 0; k < b->n_batches; k++)
            mean += b->value[b->n * k + i] / b->n_batches;
        for (int k = 0; k < b->n_batches; k++)
            b->value[b->n * k + i] = (b->value[b->n * k + i] - mean) * (b->value[b->n * k + i] - mean);
    }
}

static void test_constant_pool(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 16, 16, &scene))
        return;
    set(&scene, "select=pool metric=constant");
    struct batches x = render_batches(t, &scene, "asbdpt", 4, 1, 400, 1, 61);
    struct batches y = render_batches(t, &scene, "bdpt", 4, 1, 400, 1, 62);
    square_deviations(&x);
    square_deviations(&y);
    double ratio, p = batches_p(&x, &y, &ratio);
    TEST_ACCEPT(t, p, "pixel variances of pool with a constant metric against bdpt: ratio %.4f", ratio);
    batches_free(&x);
    batches_free(&y);
    scene_free(&scene);
}

/* --- light sub-paths for a share of the pixels -------------------------------------------------------- */

/* One tile of 3x3 pixels, whose light sub-paths are one for every 1, 2, 5 or 8 of them: 9, 5, 2 and 2. */
static void test_few_light_paths(struct test *t)
{
    static const char *const cases[] = {"pathpixels=1", "pathpixels=2", "pathpixels=5", "pathpixels=8",
                                        "select=subspaces pathpixels=2", "pathpixels=5", "pathpixels=9"};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 3, 3, &scene))
        return;
    set(&scene, "select=vertices connections=2");
    struct batches pt = render_batches(t, &scene, "pt", 4, 1024, 32, 3, 63);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct batches x = batches_of(t, &scene, cases[i], 512, 32, 64);
        double ratio, p = batches_p(&x, &pt, &ratio);
        TEST_ACCEPT(t, p, "Cornell box in 9 pixels, %s against pt: ratio %.4f", cases[i], ratio);
        batches_free(&x);
    }
    batches_free(&pt);
    scene_free(&scene);
}

/* --- every kind of scene ----------------------------------------------------------------------------- */

static void test_every_scene(struct test *t)
{
    static const char *const scenes[] = {"light-kinds", "mirror-glass", "thin-lens", "all-materials", "smooth-normals",
                                         "negative-scale", "alpha", "instances"};
    static const char *const ways[] = {"select=pool metric=importance",
                                       "select=vertices metric=importance connections=3",
                                       "select=subspaces connections=0"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        char path[256];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/test/%s.pbrt", scenes[i]);
        if (!scene_from_file(t, path, 24, 24, &scene))
            continue;
        struct batches bdpt = render_batches(t, &scene, "bdpt", 4, 8, 12, 12, 71);
        for (int k = 0; k < 3; k++) {
            set(&scene, ways[k]);
            struct batches x = render_batches(t, &scene, "asbdpt", 4, 8, 12, 12, 72);
            double ratio, p = batches_p(&x, &bdpt, &ratio);
            TEST_ACCEPT(t, p, "%s, %s against bdpt: ratio %.4f", scenes[i], ways[k], ratio);
            batches_free(&x);
        }
        batches_free(&bdpt);
        scene_free(&scene);
    }
}

/* --- reproducibility --------------------------------------------------------------------------------- */

static void test_selection_threads(struct test *t)
{
    static const char *const ways[] = {"select=bins restart=16", "select=pool", "select=vertices", "select=subspaces"};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 40, 24, &scene))
        return;
    for (int k = 0; k < 4; k++) {
        set(&scene, ways[k]);
        static float image[3][40 * 24 * 3];
        static const int threads[] = {1, 2, 7};
        for (int i = 0; i < 3; i++) {
            struct film film;
            struct error err;
            film_init(&film, render_crop(&scene), scene.width, scene.height);
            struct render_options o = {.integrator = integrator_find("asbdpt"), .end = 40, .n_threads = threads[i]};
            o.max_depth = 4;
            CHECK(t, render_scene(&scene, &o, &film, &err), "%s", err.text);
            film_develop(&film, 1, image[i]);
            film_free(&film);
        }
        CHECK(t, memcmp(image[0], image[1], sizeof image[0]) == 0 && memcmp(image[0], image[2], sizeof image[0]) == 0,
              "%s depends on the number of threads", ways[k]);
    }
    scene_free(&scene);
}

void test_asbdpt(struct test *t)
{
    test_bias(t);
    test_constant_pool(t);
    test_few_light_paths(t);
    test_every_scene(t);
    test_selection_threads(t);
}
