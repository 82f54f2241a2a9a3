/* test_vcm.c: vertex connection and merging: with a radius of nearly nothing it is bdpt, and in even light its radius
 * adds no bias. The second holds if all weights of a path add up to 1. Elsewhere the bias falls with the radius. */
#include <math.h>

#include "lab/compare.h"
#include "helpers.h"
#include "tests.h"

enum { SIDE = 16, DEPTH = 5 };

static void picture(struct test *t, struct scene *scene, const char *way, long spp, float out[SIDE * SIDE * 3])
{
    struct render_options o = {.integrator = set_method(scene, way), .end = spp, .max_depth = DEPTH, .n_threads = 2,
                               .seed = test_seed(t)};
    render_pixels(t, scene, &o, out);
}

/* The same random numbers: without merges it is bdpt, and the larger the radius the farther from it. */
static void test_limit(struct test *t)
{
    static const char *const ways[] = {"vcm radius=1e-7", "vcm radius=.01 alpha=1", "vcm radius=.6 alpha=1"};
    float bdpt[SIDE * SIDE * 3], vcm[SIDE * SIDE * 3];
    double off[3];
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", SIDE, SIDE, &scene))
        return;
    picture(t, &scene, "bdpt", 16, bdpt);
    for (int i = 0; i < 3; i++) {
        picture(t, &scene, ways[i], 16, vcm);
        off[i] = compare_pixels(vcm, bdpt, SIDE * SIDE * 3).mean_ratio - 1;
    }
    CHECK(t, fabs(off[0]) < 1e-6, "a radius of nothing changes the picture by %g", off[0]);
    CHECK(t, fabs(off[1]) < 0.01 && fabs(off[2]) > 0.03, "biases of %g and %g", off[1], off[2]);
    scene_free(&scene);
}

/* Inside a sphere that shines all around every point receives the same: merging moves nothing. */
static void test_even(struct test *t)
{
    static const char text[] =
        "LookAt 0 0 0 0 0 1 0 1 0\nCamera \"perspective\" \"float fov\" 60\nFilm \"image\" \"integer xresolution\" 16\n"
        "\"integer yresolution\" 16\nPixelFilter \"box\"\nWorldBegin\nMaterial \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nReverseOrientation\nShape \"sphere\" \"float radius\" 1\n"
        "WorldEnd\n";
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    const char *vcm = set_method(&scene, "vcm radius=.05 alpha=1");
    struct batches merged = render_batches(t, &scene, vcm, DEPTH, 16, 12, 16, 72);
    double received = 2 - pow(0.5, DEPTH); /* 1 + 1/2 + ... */
    TEST_ACCEPT(t, mean_p(&merged, received), "in a sphere that shines vcm has %.5f of the light",
                batches_mean(&merged, NULL) / received);
    batches_scale(&merged, 1.02);
    TEST_REJECT(t, mean_p(&merged, received), "times 1.02");
    batches_free(&merged);
    scene_free(&scene);
}

void test_vcm(struct test *t)
{
    test_limit(t);
    test_even(t);
}
