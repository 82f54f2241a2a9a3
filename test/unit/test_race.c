/* test_race.c: the race for the number of light sub-paths (race.h), and the counts in the weights that follow from
 * numbers and credits. */
#include <math.h>
#include <stdio.h>

#include "bench.h"
#include "helpers.h"
#include "suites.h"

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
struct settled {
    struct numbers numbers;
    struct counts counts; /* not the tables, which go */
    bool learnt;          /* is anything known but lights? */
    bool complete;        /* does each runner make every path that the method can make? */
    double path_tracer;   /* variance times price of the best path tracer, over the winner's; 0: there was no race */
};

static bool settle(struct test *t, const struct scene *scene, struct settled *out)
{
    struct bench b;
    if (!bench_new(t, scene, "asbdpt", 5, 0, &b))
        return false;
    const struct tables *known = b.prepared.tables;
    bool learnt = known->use != NULL || known->pairs.rows > 0 || known->emission.rows > 0;
    bool complete = true;
    double best = 0;
    for (const struct runner *k = b.prepared.runner; k < b.prepared.runner + b.prepared.n_runners; k++) {
        complete &= k->numbers.path_pixels > 0 && k->numbers.draws[FIRST_HIT] > 0 && k->numbers.draws[LATER_HIT] > 0;
        if (k->numbers.path_pixels == 0 && (best == 0 || k->variance * k->price < best))
            best = k->variance * k->price;
    }
    const struct runner *winner = &b.prepared.runner[b.prepared.winner];
    *out = (struct settled){b.prepared.numbers, b.prepared.counts, learnt, complete,
                            best > 0 ? best / (winner->variance * winner->price) : 0};
    bench_free(&b);
    return true;
}

static bool settle_file(struct test *t, const char *path, struct settled *out)
{
    struct scene scene;
    if (!scene_from_file(t, path, 96, 64, &scene))
        return false;
    bool settled = settle(t, &scene, out);
    scene_free(&scene);
    return settled;
}

static void test_where_they_pay(struct test *t)
{
    static const char *const scenes[] = {"scenes/cornell-box.pbrt", "scenes/bathroom.pbrt", "scenes/corridor.pbrt"};
    struct settled s;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (settle_file(t, scenes[i], &s))
            CHECK(t, s.numbers.path_pixels > 0 && s.counts.pair[FIRST_HIT] > 0 && s.counts.lens > 0,
                  "%s has no light sub-paths", scenes[i]);
}

/* Under an open sky a path tracer is the best runner, or nearly. */
static void test_where_nothing_pays(struct test *t)
{
    static const char *const scenes[] = {"scenes/forest.pbrt", "scenes/sky.pbrt"};
    struct settled s;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (settle_file(t, scenes[i], &s))
            CHECK(t, s.path_tracer < 1.25, "%s: %d pixels for a light sub-path, a path tracer is %.2f times as bad",
                  scenes[i], s.numbers.path_pixels, s.path_tracer);
}

/* Paths that only light sub-paths find keep these alive, whatever was measured; else a path tracer, which keeps no
 * table but that of direct light, is enough here. */
static void test_where_nothing_else_does(struct test *t)
{
    static const char *const materials[] = {"matte", "mirror", "glass", "uber"};
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        char text[2048];
        struct scene scene;
        struct settled s;
        snprintf(text, sizeof text, FLOOR, materials[i]);
        if (!scene_from_text(t, text, &scene))
            continue;
        if (settle(t, &scene, &s)) {
            CHECK(t, (s.numbers.path_pixels > 0) == (i > 0), "a point light beside %s: %d", materials[i],
                  s.numbers.path_pixels);
            CHECK(t, s.complete == (i > 0), "a point light beside %s: a runner lacks paths", materials[i]);
            CHECK(t, i > 0 || (!s.learnt && s.numbers.draws[FIRST_HIT] == 0 && s.counts.lens == 0 &&
                               s.counts.pair[FIRST_HIT] == 0 && s.counts.pair[LATER_HIT] == 0 &&
                               s.counts.hit[LATER_HIT] == 1 && s.counts.direct[FIRST_HIT] == 1),
                  "a path tracer knows, or counts, more than it uses");
        }
        scene_free(&scene);
    }
}

/* Without the check there are light sub-paths everywhere. */
static void test_wish(struct test *t)
{
    char text[2048];
    struct scene scene;
    struct settled s;
    snprintf(text, sizeof text, FLOOR, "matte");
    if (!scene_from_text(t, text, &scene))
        return;
    settings_set(&scene.settings, "race", "off", "test");
    settings_set(&scene.settings, "pathpixels", "5", "test");
    if (settle(t, &scene, &s))
        CHECK(t, s.numbers.path_pixels == 5 && s.counts.lens == 32 * 32 / 5.0 && s.counts.pair[LATER_HIT] > 0,
              "%d pixels for a light sub-path, counted as %g", s.numbers.path_pixels, s.counts.lens);
    scene_free(&scene);
}

/* Runners that the first predicts, by being the first themselves: price is a matter of numbers alone, and variance,
 * which both have measured by a few samples, is about what it was said to be. */
static void test_predictions(struct test *t)
{
    static const char *const scenes[] = {"scenes/bathroom.pbrt", "scenes/forest.pbrt"};
    static const char *const runners[] = {"asbdpt", "asbdpt pathpixels=4", "asbdpt pathpixels=4 connections=1 later=0"};
    for (int i = 0; i < 6; i++) {
        static struct runner said[3];
        struct scene scene;
        struct bench b;
        if (!scene_from_file(t, scenes[i / 3], 192, 128, &scene))
            continue;
        if (bench_new(t, &scene, set_method(&scene, runners[i % 3]), 5, 0, &b)) {
            struct runner own = b.prepared.runner[0];
            for (int k = 0; k < 3 && i % 3 == 0; k++)
                said[k] = b.prepared.runner[k];
            CHECK(t, said[1].price < 0.9 * said[0].price, "%s: a quarter of the light sub-paths costs %.3f times as much",
                  scenes[i / 3], said[1].price / said[0].price);
            double variance = own.variance / said[i % 3].variance, price = own.price / said[i % 3].price;
            CHECK(t, fabs(price - 1) < 0.02, "%s, %s: %.3f times the price", scenes[i / 3], said[i % 3].name, price);
            CHECK(t, variance > 0.6 && variance < 1.7, "%s, %s: %.2f times the variance", scenes[i / 3],
                  said[i % 3].name, variance);
            bench_free(&b);
        }
        scene_free(&scene);
    }
}

/* The edge of a lamp is noise in the image, but the same for all runners: of a lamp alone none is predicted. */
static void test_lamp_alone(struct test *t)
{
    static const char LAMP[] = "LookAt 0 0 4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40\n"
                               "Film \"image\" \"integer xresolution\" 160 \"integer yresolution\" 160 WorldBegin\n"
                               "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Material \"matte\" \"rgb Kd\" [0 0 0] "
                               QUAD("-1 -.7 0  1 -.8 0  .9 .7 0  -.8 1 0") "WorldEnd\n";
    struct scene scene;
    struct bench b;
    if (!scene_from_text(t, LAMP, &scene) || !bench_new(t, &scene, set_method(&scene, "asbdpt"), 5, 0, &b))
        return;
    CHECK(t, b.prepared.n_runners == MAX_RUNNERS, "%d runners", b.prepared.n_runners);
    for (int i = 0; i < b.prepared.n_runners; i++)
        CHECK(t, b.prepared.runner[i].variance < 1e-20, "%s: a variance of %g", b.prepared.runner[i].name,
              b.prepared.runner[i].variance);
    bench_free(&b);
    scene_free(&scene);
}

/* Of a point light on two walls direct light has little variance, however much more of it a runner has to make. */
static void test_even_light(struct test *t)
{
    static const char WALLS[] = "LookAt 0 0 4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40\n"
                                "Film \"image\" \"integer xresolution\" 160 \"integer yresolution\" 160 WorldBegin\n"
                                "LightSource \"point\" \"point from\" [1 2 3] \"rgb I\" [20 20 20]\n"
                                "Material \"matte\" \"rgb Kd\" [.8 .8 .8] "
                                QUAD("-9 -9 0  9 -9 0  9 9 0  -9 9 0") QUAD("-3 -9 0  -3 -9 9  -3 9 9  -3 9 0")
                                "WorldEnd\n";
    struct scene scene;
    struct bench b[2];
    if (!scene_from_text(t, WALLS, &scene) ||
        !bench_new(t, &scene, set_method(&scene, "asbdpt"), 5, 0, &b[0]) ||
        !bench_new(t, &scene, set_method(&scene, "asbdpt pathpixels=4"), 5, 0, &b[1]))
        return;
    double said = b[0].prepared.runner[1].variance, own = b[1].prepared.runner[0].variance;
    CHECK(t, own > 0.45 * said && own < 1.5 * said, "a quarter of light sub-paths: variance %g, said to be %g", own,
          said);
    bench_free(&b[0]);
    bench_free(&b[1]);
    scene_free(&scene);
}

/* counts_of: exact. */
static void test_counts(struct test *t)
{
    const struct numbers n = {.path_pixels = 4, .draws = {3, 1}, .light_points = 2};
    const struct counts c = counts_of(n, 5, 2, 100, &NO_TABLES);
    CHECK(t, c.hit[FIRST_HIT] == 5 && c.direct[FIRST_HIT] == 10, "first hit");
    CHECK(t, c.hit[LATER_HIT] == 1 && c.direct[LATER_HIT] == 1, "later");
    CHECK(t, c.pair[FIRST_HIT] == 6 && c.pair[LATER_HIT] == 2 && c.lens == 25, "light sub-paths");
    const struct numbers path_tracer = {.draws = {3, 1}, .light_points = 1};
    const struct counts pt = counts_of(path_tracer, 1, 1, 100, &NO_TABLES);
    CHECK(t, pt.pair[FIRST_HIT] == 0 && pt.lens == 0 && pt.hit[LATER_HIT] == 1, "a path tracer");
    const struct counts lt = counts_of((struct numbers){.path_pixels = 1}, 5, 1, 100, &NO_TABLES);
    CHECK(t, lt.hit[FIRST_HIT] == 0 && lt.direct[LATER_HIT] == 0 && lt.lens == 100, "a light tracer");
}

void test_race(struct test *t)
{
    test_counts(t);
    test_where_they_pay(t);
    test_where_nothing_pays(t);
    test_where_nothing_else_does(t);
    test_wish(t);
    test_predictions(t);
    test_lamp_alone(t);
    test_even_light(t);
}
