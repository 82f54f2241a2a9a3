/* test_probe.c: the check whether light sub-paths are useful (probe.h), and the counts in the weights that follow from
 * numbers and credits. */
#include <stdio.h>

#include "bench.h"
#include "helpers.h"
#include "tests.h"

/* A floor that a point light shines on, the eye above it; something small of the given material out of sight. */
static const char FLOOR[] = "LookAt 0 0 4  0 0 0  0 1 0\n"
                            "Camera \"perspective\" \"float fov\" 40\n"
                            "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
                            "WorldBegin\n"
                            "LightSource \"point\" \"point from\" [1 2 3] \"rgb I\" [20 20 20]\n"
                            "Material \"matte\" " QUAD("-9 -9 0  9 -9 0  9 9 0  -9 9 0")
                            "Material \"%s\"\n"
                            "Translate 0 8 1\n"
                            "Shape \"sphere\" \"float radius\" 0.05\n"
                            "WorldEnd\n";

/* What asbdpt has settled for the scene and its settings. */
static bool settle(struct test *t, const struct scene *scene, struct frozen *out)
{
    struct bench b;
    if (!bench_new(t, scene, "asbdpt", 5, 0, &b))
        return false;
    *out = *bench_frozen(&b); /* not the tables, which go */
    bench_free(&b);
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
            CHECK(t, f.numbers.path_pixels > 0 && f.counts.connect[LATER_HIT] > 0 && f.counts.splat > 0,
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
            CHECK(t, f.tables.eye.n == 0 && f.numbers.path_pixels == 0 && f.counts.splat == 0 &&
                         f.counts.connect[FIRST_HIT] == 0 && f.counts.connect[LATER_HIT] == 0,
                  "%s: %d regions, %d pixels for a light sub-path", scenes[i], f.tables.eye.n, f.numbers.path_pixels);
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
        if (settle(t, &scene, &f))
            CHECK(t, (f.numbers.path_pixels > 0) == (i > 0), "a point light beside %s: %d", materials[i],
                  f.numbers.path_pixels);
        scene_free(&scene);
    }
}

/* Without the check there are light sub-paths everywhere. */
static void test_wish(struct test *t)
{
    char text[2048];
    struct scene scene;
    struct frozen f;
    snprintf(text, sizeof text, FLOOR, "matte");
    if (!scene_from_text(t, text, &scene))
        return;
    settings_set(&scene.settings, "probe", "off", "test");
    settings_set(&scene.settings, "pathpixels", "5", "test");
    if (settle(t, &scene, &f))
        CHECK(t, f.numbers.path_pixels == 5 && f.counts.splat == 32 * 32 / 5.0 && f.counts.connect[LATER_HIT] > 0,
              "%d pixels for a light sub-path, counted as %g", f.numbers.path_pixels, f.counts.splat);
    scene_free(&scene);
}

/* counts_of: exact. */
static void test_counts(struct test *t)
{
    const struct numbers n = {.path_pixels = 4, .draws = {3, 1}, .light_points = 2, .path_tracing = true};
    const struct mis_counts c = counts_of(n, (struct credits){5, 2}, 100);
    CHECK(t, c.hit[FIRST_HIT] == 5 && c.direct[FIRST_HIT] == 10, "first hit");
    CHECK(t, c.hit[LATER_HIT] == 1 && c.direct[LATER_HIT] == 1, "later");
    CHECK(t, c.connect[FIRST_HIT] == 6 && c.connect[LATER_HIT] == 2 && c.splat == 25, "light sub-paths");
    const struct numbers path_tracer = {.draws = {3, 1}, .light_points = 1, .path_tracing = true};
    const struct mis_counts pt = counts_of(path_tracer, NO_CREDITS, 100);
    CHECK(t, pt.connect[FIRST_HIT] == 0 && pt.splat == 0 && pt.hit[LATER_HIT] == 1, "a path tracer");
    const struct mis_counts lt = counts_of((struct numbers){.path_pixels = 1}, NO_CREDITS, 100);
    CHECK(t, lt.hit[FIRST_HIT] == 0 && lt.direct[LATER_HIT] == 0 && lt.splat == 100, "a light tracer");
}

void test_probe(struct test *t)
{
    test_counts(t);
    test_where_they_pay(t);
    test_where_nothing_pays(t);
    test_where_nothing_else_does(t);
    test_wish(t);
}
