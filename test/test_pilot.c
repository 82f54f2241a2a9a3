/* test_pilot.c: what is chosen before a render: light sub-paths where they pay, and where nothing else finds the light;
 * credits for what hardly varies. */
#include <math.h>
#include <stdio.h>

#include "helpers.h"
#include "integrators/method.h"
#include "learning/plan.h"
#include "render/render.h"
#include "tests.h"

/* A floor that a point light shines on, the eye above it; something small of the given material out of sight. */
static const char FLOOR[] = "LookAt 0 0 4  0 0 0  0 1 0\n"
                            "Camera \"perspective\" \"float fov\" 40\n"
                            "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
                            "WorldBegin\n"
                            "LightSource \"point\" \"point from\" [1 2 3] \"rgb I\" [20 20 20]\n"
                            "Material \"matte\"\n"
                            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
                            "  \"point P\" [-9 -9 0  9 -9 0  9 9 0  -9 9 0]\n"
                            "Material \"%s\"\n"
                            "Translate 0 8 1\n"
                            "Shape \"sphere\" \"float radius\" 0.05\n"
                            "WorldEnd\n";

/* What asbdpt has settled for the scene and its settings. */
static bool settle(struct test *t, const struct scene *scene, struct frozen *out)
{
    struct render_options o = {.integrator = "asbdpt", .max_depth = 5, .n_threads = 2, .seed = test_seed(t)};
    struct render_job job = {.scene = NULL};
    struct preparation prepared;
    struct error err;
    if (!CHECK(t, render_prepare(scene, &o, render_crop(scene), &job, &prepared, &err), "%s", err.text))
        return false;
    *out = *(const struct frozen *)prepared.state; /* but what counts.model points to */
    method_release(&prepared);
    return true;
}

static void test_where_they_pay(struct test *t)
{
    static const char *const scenes[] = {"scenes/cornell-box.pbrt", "scenes/bathroom.pbrt", "scenes/corridor.pbrt"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        struct scene scene;
        struct frozen f;
        if (!scene_from_file(t, scenes[i], 48, 32, &scene))
            continue;
        if (settle(t, &scene, &f))
            CHECK(t, f.path_pixels > 0 && f.counts.connect[LATER_HIT] > 0 && f.counts.splat > 0,
                  "%s has no light sub-paths", scenes[i]);
        scene_free(&scene);
    }
}

/* Under an open sky nothing is learnt, and a path tracer renders. */
static void test_where_nothing_pays(struct test *t)
{
    static const char *const scenes[] = {"scenes/forest.pbrt", "scenes/sky.pbrt"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        struct scene scene;
        struct frozen f;
        if (!scene_from_file(t, scenes[i], 48, 32, &scene))
            continue;
        if (settle(t, &scene, &f))
            CHECK(t, f.tables.eye.n == 0 && f.path_pixels == 0 && f.counts.splat == 0 &&
                         f.counts.connect[FIRST_HIT] == 0 && f.counts.connect[LATER_HIT] == 0,
                  "%s: %d regions, %d pixels for a light sub-path", scenes[i], f.tables.eye.n, f.path_pixels);
        scene_free(&scene);
    }
}

/* Paths that only light sub-paths find keep these alive, whatever was measured. */
static void test_where_nothing_else_does(struct test *t)
{
    static const char *const materials[] = {"matte", "mirror", "glass", "uber"};
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        char text[2048];
        struct scene scene;
        struct frozen f;
        snprintf(text, sizeof text, FLOOR, materials[i]);
        if (!scene_from_text(t, text, &scene))
            continue;
        if (settle(t, &scene, &f)) {
            CHECK(t, (f.path_pixels > 0) == (i > 0), "a point light beside %s: %d", materials[i], f.path_pixels);
            double delta = f.counts.delta[FIRST_HIT];
            CHECK(t, i == 0 || delta >= 16, "a point light's samples count for %g", delta);
        }
        scene_free(&scene);
    }
}

/* What the user asks for is done, where the pilot would have none of it, too. */
static void test_wishes(struct test *t)
{
    static const struct {
        const char *name, *value;
    } wishes[] = {{"connections", "3"}, {"pathpixels", "5"}};
    for (int i = 0; i < 2; i++) {
        char text[2048];
        struct scene scene;
        struct frozen f;
        snprintf(text, sizeof text, FLOOR, "matte");
        if (!scene_from_text(t, text, &scene))
            continue;
        settings_set(&scene.settings, wishes[i].name, wishes[i].value, "test");
        if (settle(t, &scene, &f))
            CHECK(t, f.counts.splat > 0 && f.counts.connect[FIRST_HIT] > 0 && f.counts.connect[LATER_HIT] > 0 &&
                         (i == 0 ? f.path_pixels > 0 : f.path_pixels == 5),
                  "%s=%s leaves %g splats, %d pixels for a light sub-path", wishes[i].name, wishes[i].value,
                  f.counts.splat, f.path_pixels);
        scene_free(&scene);
    }
}

/* The light of an even sky has hardly any variance, and counts for many samples; that of a bathroom comes by chance. */
static void test_credit(struct test *t)
{
    static const char *const scenes[] = {"scenes/features/light-infinite.pbrt", "scenes/bathroom.pbrt"};
    for (int i = 0; i < 2; i++) {
        struct scene scene;
        struct frozen f;
        if (!scene_from_file(t, scenes[i], 32, 32, &scene))
            continue;
        settings_set(&scene.settings, "pathpixels", "4", "test"); /* or a path tracer would do */
        if (settle(t, &scene, &f)) {
            double credit = f.counts.hit[FIRST_HIT];
            CHECK(t, (credit > 4) == (i == 0) && fabs(f.counts.direct[FIRST_HIT] / f.lights / credit - 1) < 1e-12,
                  "%s: s = 0 counts for %g, each of %d samples of s = 1 for %g", scenes[i], credit, f.lights,
                  f.counts.direct[FIRST_HIT] / f.lights);
        }
        scene_free(&scene);
    }
}

/* --- plans --------------------------------------------------------------------------------------------- */

/* Pure functions: what noise of one pixel leads to which numbers, none being 0 or beyond its bounds. */
static void test_plans(struct test *t)
{
    const struct costs costs = {10, {1, 4, 1, 8}}; /* rays */
    static const struct {
        const char *name;
        struct noise noise; /* total, given_eye, blocks, tail, {draws at the first hit, later, light points} */
        double n[N_KINDS];
        bool pay;
    } cases[] = {
        {"nothing measured", {0, 0, 0, 0, {0, 0, 0}}, {3, 1, 2, 1}, false},
        /* n = usual^(1/3) best^(2/3), best = sqrt(b tried / cost * 10 / A), A = 1 */
        {"all alike", {2, 1, 0.25, 0, {0.25, 0.25, 0.25}}, {3.1072, 1.3572, 2.7144, 0.4275}, false},
        {"draws alone", {2, 1, 0, 0, {1, 0, 0}}, {4.9324, 0.125, 1, 0.2321}, false},
        {"blocks share noise", {2, 1, 4, 0, {0, 0, 0}}, {0.25, 0.125, 1, 1}, false},
        {"fireflies else", {2, 1, 0.25, 50, {0.25, 0.25, 0.25}}, {3.1072, 1.3572, 2.7144, 0.4275}, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct plan p = plan_numbers(&costs, &cases[i].noise);
        for (int k = 0; k < N_KINDS; k++)
            CHECK(t, fabs(p.n[k] / cases[i].n[k] - 1) < 1e-3, "%s: %g of kind %d, not %g", cases[i].name, p.n[k], k,
                  cases[i].n[k]);
        CHECK(t, plan_paths_pay(&costs, &cases[i].noise, &p) == cases[i].pay, "%s: light sub-paths %s", cases[i].name,
              cases[i].pay ? "do not pay" : "pay");
    }
}

void test_pilot(struct test *t)
{
    test_plans(t);
    test_where_they_pay(t);
    test_where_nothing_pays(t);
    test_where_nothing_else_does(t);
    test_wishes(t);
    test_credit(t);
}
