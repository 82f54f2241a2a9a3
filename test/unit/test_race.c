/* test_race.c: the race for the number of light sub-paths (race.h), and the counts in the weights that follow from
 * numbers and credits. */
#include <math.h>
#include <stdio.h>
#include <string.h>

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
    struct runner runner[RUNNERS];
    int winner;
    struct numbers numbers;
    struct counts counts; /* not the tables, which go */
    bool learnt;          /* is anything known but lights? */
};

static bool settle(struct test *t, const struct scene *scene, struct settled *out)
{
    struct bench b;
    if (!bench_new(t, scene, "asbdpt", 5, 0, &b))
        return false;
    const struct tables *known = b.prepared.tables;
    *out = (struct settled){.winner = b.prepared.winner, .numbers = b.prepared.numbers, .counts = b.prepared.counts};
    out->learnt = known->pairs.rows > 0 || known->emission.rows > 0;
    memcpy(out->runner, b.prepared.runner, sizeof out->runner);
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

/* Under an open sky a path tracer wins before anything is learnt about light sub-paths. */
static void test_where_nothing_pays(struct test *t)
{
    static const char *const scenes[] = {"scenes/forest.pbrt", "scenes/sky.pbrt"};
    struct settled s;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (settle_file(t, scenes[i], &s))
            CHECK(t, s.winner == RUNNER_PATH_TRACER && !s.learnt && !(s.runner[RUNNER_ALL].price > 0),
                  "%s: %s renders, %s", scenes[i], RACES[RACE_RUNNERS + s.winner], s.learnt ? "learnt" : "not learnt");
}

/* How often runner k takes what eye vertices of this kind draw (t > 1), or splats, for each time of the first. */
static double how_often(const struct settled *s, int k, enum eye_end end, bool splats)
{
    const struct numbers *n = &s->runner[k].numbers, *all = &s->runner[RUNNER_ALL].numbers;
    if (n->path_pixels == 0)
        return 0;
    double paths = splats ? (double)all->path_pixels / n->path_pixels : (double)n->draws[end] / all->draws[end];
    return paths / numbers_every(n, end);
}

/* No runner gives light up: what the first makes each makes at least 1/32 times as often. A path tracer without light
 * sub-paths competes where all is matte alone. */
static void test_nothing_is_given_up(struct test *t)
{
    static const char *const materials[] = {"matte", "mirror", "glass", "uber", "disney", "plastic", "metal",
                                            "substrate", "translucent"};
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        char text[2048];
        struct scene scene;
        struct settled s;
        snprintf(text, sizeof text, FLOOR, materials[i]);
        if (!scene_from_text(t, text, &scene))
            continue;
        for (int k = 0; k < RUNNERS && settle(t, &scene, &s); k++) {
            double least = fmin(how_often(&s, k, FIRST_HIT, true),
                                fmin(how_often(&s, k, FIRST_HIT, false), how_often(&s, k, LATER_HIT, false)));
            bool without = i == 0 && k == RUNNER_PATH_TRACER;
            CHECK(t, without ? least == 0 : least >= 1.0 / 32, "a point light beside %s: %s makes some paths %g times "
                  "as often as the first runner", materials[i], RACES[RACE_RUNNERS + k], least);
        }
        if (i == 0)
            CHECK(t, s.winner == RUNNER_PATH_TRACER && !s.learnt && s.counts.lens == 0 &&
                  s.counts.pair[FIRST_HIT] == 0 && s.counts.pair[LATER_HIT] == 0 && s.counts.hit[LATER_HIT] == 1,
                  "a path tracer knows, or counts, more than it uses");
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
    for (int i = 0; i < RUNNERS; i++)
        CHECK(t, b.prepared.runner[i].variance < 1e-20, "%s: a variance of %g", RACES[RACE_RUNNERS + i],
              b.prepared.runner[i].variance);
    bench_free(&b);
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
    struct numbers rare = n;
    rare.every[FIRST_HIT] = rare.every[LATER_HIT] = 8;
    const struct counts r = counts_of(rare, 5, 2, 100, &NO_TABLES);
    CHECK(t, r.pair[FIRST_HIT] == 6.0 / 8 && r.pair[LATER_HIT] == 2.0 / 8 && r.lens == 25.0 / 8 &&
          r.direct[LATER_HIT] == 1, "light sub-paths in one of 8 iterations");
    CHECK(t, lt.hit[FIRST_HIT] == 0 && lt.direct[LATER_HIT] == 0 && lt.lens == 100, "a light tracer");
}

void test_race(struct test *t)
{
    test_counts(t);
    test_where_they_pay(t);
    test_where_nothing_pays(t);
    test_nothing_is_given_up(t);
    test_wish(t);
    test_lamp_alone(t);
}
