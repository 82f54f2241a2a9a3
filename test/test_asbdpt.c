/* test_asbdpt.c: selection of light sub-paths: the unbiased ways agree with path tracing, the dissertation's does
 * not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "lab/stats.h"
#include "render/render.h"
#include "helpers.h"
#include "tests.h"

static struct batches batches_of(struct test *t, struct scene *scene, const char *method, int spp, int n,
                                 uint64_t seed)
{
    const char *integrator = set_method(scene, method);
    return render_batches(t, scene, integrator, 4, spp, n, 16, seed);
}

/* --- bias -------------------------------------------------------------------------------------------- */

/* Against the stored reference, with the same number of samples: bdpt and all selections pass, but for bins. */
static void test_bias(struct test *t)
{
    static const struct {
        const char *parameters;
        bool unbiased;
    } cases[] = {{"bdpt", true},
                 {"asbdpt select=pool metric=constant", true},
                 {"asbdpt select=pool metric=throughput", true},
                 {"asbdpt select=pool metric=importance", true},
                 {"asbdpt select=vertices metric=importance connections=2", true},
                 {"asbdpt select=vertices metric=constant connections=2", true},
                 {"asbdpt select=subspaces", true},
                 {"asbdpt select=subspaces connections=2", true},
                 {"lvc connections=1", true},
                 {"cbdpt connections=3", true},
                 {"asbdpt select=bins", false}};
    struct scene scene;
    struct batches reference;
    int width, height;
    enum { DEPTH = 6 }; /* the reference's; set_method() has cleared the scene's own */
    if (!load_reference(t, "cornell-box", 16, &width, &height, &reference) ||
        !scene_from_file(t, "scenes/cornell-box.pbrt", width, height, &scene))
        return;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *integrator = set_method(&scene, cases[i].parameters);
        struct batches x = render_batches(t, &scene, integrator, DEPTH, 8, 16, 16, 53);
        double ratio, p = batches_p(&x, &reference, &ratio);
        if (cases[i].unbiased)
            TEST_ACCEPT(t, p, "Cornell box, %s against its reference: ratio %.4f", cases[i].parameters, ratio);
        else
            TEST_REJECT(t, p, "Cornell box, %s against its reference: ratio %.4f", cases[i].parameters, ratio);
        if (!cases[i].unbiased)
            printf("  bias of %s on the Cornell box: %+.2f %% of the mean, p = %.1g\n", cases[i].parameters,
                   100 * (ratio - 1), p);
        batches_free(&x);
    }
    batches_free(&reference);
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
    set_method(&scene, "asbdpt select=pool metric=constant");
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
    static const char *const cases[] = {
        "asbdpt select=vertices connections=2 pathpixels=1", "asbdpt select=vertices connections=2 pathpixels=2",
        "asbdpt select=vertices connections=2 pathpixels=5", "asbdpt select=vertices connections=2 pathpixels=8",
        "asbdpt select=subspaces pathpixels=2", "asbdpt select=subspaces pathpixels=5",
        "asbdpt select=subspaces pathpixels=9", "lvc connections=1 pathpixels=5", "lvc connections=1 pathpixels=9",
        "cbdpt connections=3 pathpixels=2", "cbdpt connections=3 pathpixels=5", "cbdpt connections=1 pathpixels=9"};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 3, 3, &scene))
        return;
    struct batches pt = render_batches(t, &scene, "pt", 4, 1024, 32, 3, 63);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct batches x = batches_of(t, &scene, cases[i], 256, 32, 64);
        double ratio, p = batches_p(&x, &pt, &ratio);
        TEST_ACCEPT(t, p, "Cornell box in 9 pixels, %s against pt: ratio %.4f", cases[i], ratio);
        batches_free(&x);
    }
    batches_free(&pt);
    scene_free(&scene);
}

/* --- cbdpt with one light sub-path is BDPT --------------------------------------------------- */

enum { WIDTH = 40, HEIGHT = 24 };

static void render_image(struct test *t, const struct scene *scene, const char *integrator, int spp, float *image)
{
    struct film film;
    struct error err;
    struct render_options o = {.integrator = integrator, .end = spp, .n_threads = 2};
    film_init(&film, render_crop(scene), scene->width, scene->height);
    o.max_depth = 4;
    CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
    film_develop(&film, 1, image);
    film_free(&film);
}

/* And with two sub-paths it is something else. */
static void test_one_path(struct test *t)
{
    static float bdpt[WIDTH * HEIGHT * 3], image[WIDTH * HEIGHT * 3];
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", WIDTH, HEIGHT, &scene))
        return;
    render_image(t, &scene, "bdpt", 20, bdpt);
    render_image(t, &scene, set_method(&scene, "cbdpt connections=1"), 20, image);
    CHECK(t, memcmp(bdpt, image, sizeof bdpt) == 0, "cbdpt with M = 1 is not bdpt");
    render_image(t, &scene, set_method(&scene, "cbdpt connections=2"), 20, image);
    CHECK(t, memcmp(bdpt, image, sizeof bdpt) != 0, "cbdpt with M = 2 is bdpt");
    scene_free(&scene);
}

/* --- how many light vertices the cache expects -------------------------------------------------------- */

/* A light in a closed white ball: all vertices but the light point are to be connected to. */
static const char BALL[] = "Camera \"perspective\" WorldBegin LightSource \"point\"\n"
                           "Material \"matte\" \"rgb Kd\" [1 1 1] Shape \"sphere\" \"float radius\" 2 WorldEnd\n";

/* A spot light on a mirror, which throws all of it onto a ceiling; from there it meets the mirror again or leaves. */
static const char MIRROR[] =
    "Camera \"perspective\" WorldBegin\n"
    "LightSource \"spot\" \"point from\" [0 1 0] \"point to\" [0 0 0] \"float coneangle\" 10\n"
    "Material \"mirror\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-2 0 -2  2 0 -2  2 0 2  -2 0 2]\n"
    "Material \"matte\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
    "  \"point P\" [-2 3 -2  2 3 -2  2 3 2  -2 3 2] WorldEnd\n";

/* The count of lvc is C / l, known here exactly. A scene without any light vertex must not make it infinite. */
static void test_expected_vertices(struct test *t)
{
    static const struct {
        const char *name, *text;
        int depth;
        double count;
    } cases[] = {{"ball", BALL, 4, 3.0 / 4}, {"ball", BALL, 1, 3}, {"mirror", MIRROR, 3, 3}, {"mirror", MIRROR, 1, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        struct error err;
        if (!scene_from_text(t, cases[i].text, &scene))
            return;
        set_method(&scene, "lvc connections=3");
        struct render_options o = {.integrator = "lvc", .max_depth = cases[i].depth, .n_threads = 2};
        struct render_job job;
        struct preparation prepared;
        if (CHECK(t, render_prepare(&scene, &o, render_crop(&scene), &job, &prepared, &err), "%s", err.text)) {
            const double *count = ((const struct frozen *)prepared.state)->counts.connect;
            CHECK(t, count[FIRST_HIT] == cases[i].count && count[LATER_HIT] == cases[i].count,
                  "%s, maxdepth %d: lvc counts %g and %g draws, not %g", cases[i].name, cases[i].depth,
                  count[FIRST_HIT], count[LATER_HIT], cases[i].count);
            method_release(&prepared);
        }
        scene_free(&scene);
    }
}

/* --- every kind of scene ----------------------------------------------------------------------------- */

static void test_every_scene(struct test *t)
{
    static const char *const scenes[] = {"light-kinds", "mirror-glass", "thin-lens", "all-materials", "smooth-normals",
                                         "negative-scale", "alpha", "instances"};
    static const char *const ways[] = {"asbdpt select=pool metric=importance",
                                       "asbdpt select=vertices metric=importance connections=3",
                                       "asbdpt select=subspaces connections=0", "lvc connections=2",
                                       "cbdpt connections=2"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        char path[256];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/test/%s.pbrt", scenes[i]);
        if (!scene_from_file(t, path, 24, 24, &scene))
            continue;
        struct batches bdpt = render_batches(t, &scene, "bdpt", 4, 8, 12, 12, 71);
        for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++) {
            const char *integrator = set_method(&scene, ways[k]);
            struct batches x = render_batches(t, &scene, integrator, 4, 8, 10, 12, 72);
            double ratio, p = batches_p(&x, &bdpt, &ratio);
            TEST_ACCEPT(t, p, "%s, %s against bdpt: ratio %.4f", scenes[i], ways[k], ratio);
            batches_free(&x);
        }
        batches_free(&bdpt);
        scene_free(&scene);
    }
}

/* --- the weights know what samples are worth ---------------------------------------------------------- */

/* Mean over pixels of the variance between renders with seeds of their own. */
static double variance_of(struct test *t, const struct scene *scene, const char *integrator, long spp)
{
    enum { SEEDS = 6 };
    static float image[SEEDS][WIDTH * HEIGHT * 3];
    double sum = 0;
    for (int k = 0; k < SEEDS; k++) {
        struct film film;
        struct error err;
        struct render_options o = {.integrator = integrator, .seed = (uint64_t)k + 1, .end = spp,
                                   .n_threads = 2, .max_depth = 4};
        film_init(&film, render_crop(scene), scene->width, scene->height);
        CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
        film_develop(&film, 1, image[k]);
        film_free(&film);
    }
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        double mean = 0, square = 0;
        for (int k = 0; k < SEEDS; k++)
            mean += (double)image[k][i] / SEEDS;
        for (int k = 0; k < SEEDS; k++)
            square += sqr((double)image[k][i] - mean) / (SEEDS - 1);
        sum += square / (WIDTH * HEIGHT * 3);
    }
    return sum;
}

/* An object under an even sky: the first bounce finds it best. Were light points alone counted for more than they are,
 * they would take over weight from it, and asbdpt would have more variance than bdpt for as many samples. */
static void test_even_sky(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/features/light-infinite.pbrt", WIDTH, HEIGHT, &scene))
        return;
    double bdpt = variance_of(t, &scene, "bdpt", 64), asbdpt = variance_of(t, &scene, "asbdpt", 64);
    CHECK(t, asbdpt < 0.95 * bdpt, "variance under an even sky: asbdpt %g, bdpt %g", asbdpt, bdpt);
    scene_free(&scene);
}

void test_asbdpt(struct test *t)
{
    test_bias(t);
    test_constant_pool(t);
    test_few_light_paths(t);
    test_one_path(t);
    test_expected_vertices(t);
    test_every_scene(t);
    test_even_sky(t);
}
