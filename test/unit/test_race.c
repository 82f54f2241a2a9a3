/* test_race.c: the race for the number of light sub-paths (race.h), and the counts in the weights that follow from
 * numbers and credits. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench.h"
#include "helpers.h"
#include "integrators/loop.h"
#include "integrators/race.h"
#include "lab/stats.h"
#include "lab/verify.h"
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

static bool settle(struct test *t, const struct scene *scene, uint64_t seed, struct settled *out)
{
    struct bench b;
    if (!bench_new(t, scene, "asbdpt", 5, seed, &b))
        return false;
    const struct tables *known = b.prepared.tables;
    *out = (struct settled){.winner = b.prepared.winner, .numbers = b.prepared.numbers, .counts = b.prepared.counts};
    out->learnt = known->pairs.rows > 0;
    memcpy(out->runner, b.prepared.runner, sizeof out->runner);
    bench_free(&b);
    return true;
}

static bool settle_file(struct test *t, const char *path, struct settled *out)
{
    struct scene scene;
    if (!scene_from_file(t, path, 96, 64, &scene))
        return false;
    bool settled = settle(t, &scene, 0, out);
    scene_free(&scene);
    return settled;
}

static void test_where_they_pay(struct test *t)
{
    static const char *const scenes[] = {"scenes/cornell-box.pbrt", "scenes/bathroom.pbrt", "scenes/corridor.pbrt"};
    struct settled s;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (settle_file(t, scenes[i], &s)) {
            double cheaper = s.runner[RUNNER_QUARTER].price / s.runner[RUNNER_ALL].price;
            CHECK(t, s.winner < RUNNER_PATH_TRACER && s.counts.pair[FIRST_HIT] > 0 && s.counts.lens > 0,
                  "%s: a path tracer renders", scenes[i]);
            CHECK(t, cheaper < 0.9, "%s: a quarter of the light sub-paths costs %.3f times as much", scenes[i],
                  cheaper);
        }
}

/* In these rooms light sub-paths help, some only who knows which of them matter where: no first race may end it. */
static void test_where_learning_pays(struct test *t)
{
    static const uint64_t structures[] = {331, 363, 437};
    struct scene scene;
    struct settled s;
    for (size_t i = 0; i < sizeof structures / sizeof structures[0]; i++) {
        const int number = (int)structures[i];
        if (!scene_from_structure(t, structures[i], 96, 72, &scene))
            continue;
        if (settle(t, &scene, 0, &s)) {
            CHECK(t, s.learnt, "structure %d: a path tracer has won before all was learnt", number);
            CHECK(t, i == 2 || s.winner < RUNNER_PATH_TRACER, "structure %d: a path tracer renders", number);
        }
        scene_free(&scene);
    }
}

/* Under an open sky a path tracer is the best runner, or nearly. */
static void test_where_nothing_pays(struct test *t)
{
    static const char *const scenes[] = {"scenes/forest.pbrt", "scenes/sky.pbrt"};
    struct settled s;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        if (settle_file(t, scenes[i], &s)) {
            double best = INFINITY;
            for (int k = RUNNER_PATH_TRACER; k < RUNNERS; k++)
                best = fmin(best, s.runner[k].variance * s.runner[k].price);
            best /= s.runner[s.winner].variance * s.runner[s.winner].price;
            CHECK(t, i > 0 || s.winner >= RUNNER_PATH_TRACER, "%s: %s renders", scenes[i], runner_name(s.winner));
            CHECK(t, best < 1.25, "%s: %s renders, path tracers are %.2f times as bad", scenes[i],
                  runner_name(s.winner), best);
        }
}

/* How often runner k takes what eye vertices of this kind draw (t > 1), or splats, for each time of the first. */
static double how_often(const struct settled *s, int k, enum eye_hit end, bool splats)
{
    const struct numbers *n = &s->runner[k].numbers, *all = &s->runner[RUNNER_ALL].numbers;
    if (n->path_pixels == 0)
        return 0;
    double paths = splats ? (double)all->path_pixels / n->path_pixels : (double)n->draws[end] / all->draws[end];
    return paths / numbers_every(n);
}

/* No runner gives light up: what the first makes each makes at least 1/32 times as often. A path tracer without light
 * sub-paths competes where all is matte alone. */
static void test_nothing_is_given_up(struct test *t)
{
    static const char *const materials[] = {"matte", "mirror", "glass", "uber", "disney", "plastic", "metal",
                                            "substrate", "translucent",
        "matte\" MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"float g\" -.9 Material \"matte"};
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++) {
        char text[2048];
        struct scene scene;
        struct settled s;
        snprintf(text, sizeof text, FLOOR, materials[i]);
        if (!scene_from_text(t, text, &scene))
            continue;
        bool settled = settle(t, &scene, 0, &s);
        for (int k = 0; settled && k < RUNNERS; k++) {
            double least = fmin(how_often(&s, k, FIRST_HIT, true),
                                fmin(how_often(&s, k, FIRST_HIT, false), how_often(&s, k, LATER_HIT, false)));
            bool without = i == 0 && k >= RUNNER_PATH_TRACER;
            CHECK(t, without ? least == 0 : least >= 1.0 / 32, "a point light beside %s: %s makes some paths %g times "
                  "as often as the first runner", materials[i], runner_name(k), least);
        }
        CHECK(t, s.runner[RUNNER_QUARTER].numbers.path_pixels == 4, "a quarter is none");
        if (i == 0)
            CHECK(t, s.winner >= RUNNER_PATH_TRACER && !s.learnt && s.counts.lens == 0 &&
                  s.counts.pair[FIRST_HIT] == 0 && s.counts.pair[LATER_HIT] == 0 && s.counts.s0[LATER_HIT] == 1,
                  "a path tracer knows, or counts, more than it uses");
        scene_free(&scene);
    }
}

/* A path tracer meets this beam in next to no sample. What one misses must not count as certain. */
static void test_beam(struct test *t)
{
    struct scene scene;
    struct settled s;
    if (!scene_from_file(t, "scenes/test/beam.pbrt", 0, 0, &scene))
        return;
    for (int seed = 0; seed < 8 && settle(t, &scene, (uint64_t)seed, &s); seed++)
        CHECK(t, s.winner < RUNNER_PATH_TRACER && s.counts.lens > 0, "seed %d: %s renders a beam that it cannot find",
              seed, runner_name(s.winner));
    scene_free(&scene);
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
    if (settle(t, &scene, 0, &s))
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
        CHECK(t, b.prepared.runner[i].variance < 1e-20, "%s: a variance of %g", runner_name(i),
              b.prepared.runner[i].variance);
    bench_free(&b);
    scene_free(&scene);
}

/* Of every 16 iterations of a tile one has light sub-paths, each as often, in another order in every tile. */
static void test_turns(struct test *t)
{
    enum { EVERY = 16, BLOCKS = 400, TILES = 2 };
    struct scene scene;
    struct bench b;
    double count[EVERY] = {0}, even[EVERY];
    int same = 0, last[TILES] = {0, 0};
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 32, 32, &scene))
        return;
    if (bench_new(t, &scene, set_method(&scene, "asbdpt race=off"), 5, 0, &b)) {
        struct tile_pass pass = bench_pass(&b, 0, 1);
        b.prepared.numbers.every = EVERY;
        for (long i = 0; i < BLOCKS * EVERY; i++)
            for (int tile = 0; tile < TILES; tile++) {
                pass.tile->pixel[0][0] = tile;
                bool turn = loop_turn(&b.prepared, &pass, i);
                count[i % EVERY] += turn;
                last[tile] = turn ? (int)(i % EVERY) : last[tile];
                if (i % EVERY == EVERY - 1 && tile == TILES - 1)
                    same += last[0] == last[1];
            }
        double all = 0;
        for (int i = 0; i < EVERY; i++) {
            all += count[i];
            even[i] = (double)TILES * BLOCKS / EVERY;
        }
        CHECK(t, all == TILES * BLOCKS, "%g turns of %d", all, TILES * BLOCKS);
        CHECK(t, same < BLOCKS / 4, "two tiles have the same turn in %d of %d blocks", same, BLOCKS);
        TEST_ACCEPT(t, stats_chi2_test(count, even, EVERY), "turns");
        bench_free(&b);
    }
    scene_free(&scene);
}

/* The light sub-paths of turn n are those that iteration n would have had. */
static void test_streams_of_turns(struct test *t)
{
    struct scene scene;
    struct bench b;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 8, 8, &scene))
        return;
    if (bench_new(t, &scene, set_method(&scene, "asbdpt race=off"), 5, 0, &b)) {
        struct tile_pass pass = bench_pass(&b, 0, 1);
        const struct pool *pool = &b.work->pool;
        loop_fill(&b.prepared, &pass, 3);
        int n = pool->n;
        vec3 p = pool_path(pool, 5)[0].p, last = pool_path(pool, n - 1)[0].p;
        b.prepared.numbers.every = 16;
        long turn = 3 * 16;
        while (!loop_turn(&b.prepared, &pass, turn))
            turn++;
        loop_fill(&b.prepared, &pass, turn ^ 1);
        CHECK(t, turn < 4 * 16 && pool->n == 0, "%d light sub-paths out of turn", pool->n);
        loop_fill(&b.prepared, &pass, turn);
        CHECK(t, pool->n == n && length(sub(p, pool_path(pool, 5)[0].p)) == 0 &&
              length(sub(last, pool_path(pool, n - 1)[0].p)) == 0, "the fourth turn of 16 is no fourth point");
        bench_free(&b);
    }
    scene_free(&scene);
}

/* Light that a path tracer misses, or nearly: of the sun on a bent strip of mirror, and of a small lamp in a glass
 * ball, by day. */
static const char SUN_ON_MIRROR[] =
    "LookAt 0 4 -4  0 0 .6  0 1 0 Camera \"perspective\" \"float fov\" 36\n"
    "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24 PixelFilter \"box\" WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [.2 .2 .2]\n"
    "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [0 1 -1.4] \"point to\" [0 0 0]\n"
    "Material \"matte\" \"rgb Kd\" [.6 .6 .6] " QUAD("-20 0 -20  20 0 -20  20 0 20  -20 0 20")
    "Material \"mirror\" Translate 0 0 .3 Rotate -90 1 0 0\n"
    "Shape \"cylinder\" \"float radius\" 1.5 \"float zmin\" 0 \"float zmax\" .6 \"float phimax\" 180 WorldEnd\n";
static const char LAMP_IN_GLASS[] =
    "LookAt 4 3 0  2 0 0  0 1 0 Camera \"perspective\" \"float fov\" 30\n"
    "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24 PixelFilter \"box\" WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [.05 .05 .05]\n"
    "Material \"matte\" \"rgb Kd\" [.6 .6 .6] " QUAD("-20 0 -20  20 0 -20  20 0 20  -20 0 20")
    "TransformBegin Translate 0 .8 0 Material \"glass\" Shape \"sphere\" \"float radius\" .4\n"
    "AreaLightSource \"diffuse\" \"rgb L\" [4e5 4e5 4e5] Shape \"sphere\" \"float radius\" .001\n"
    "TransformEnd WorldEnd\n";

/* The default and each runner show what is there without a race. A path tracer alone does not. A batch of a path tracer
 * has a whole turn of light sub-paths. */
static void test_expectations(struct test *t, int spp)
{
    enum { BATCHES = 16, TILE = 24, WAYS = RUNNERS + 2 };
    static const char *const scenes[] = {SUN_ON_MIRROR, LAMP_IN_GLASS}, *const names[] = {"the sun", "the lamp"};
    for (int i = 0; i < 2; i++) {
        struct scene scene;
        struct batches right;
        if (!scene_from_text(t, scenes[i], &scene))
            return;
        right = render_batches(t, &scene, set_method(&scene, "asbdpt race=off"), 5, spp, BATCHES, TILE, 1);
        for (int k = 0; k < WAYS; k++) {
            char way[64] = "pt";
            if (k <= RUNNERS)
                snprintf(way, sizeof way, "asbdpt race=%s", k < RUNNERS ? runner_name(k) : "on");
            const char *name = set_method(&scene, way);
            int samples = k < RUNNER_PATH_TRACER || k > RUNNERS ? spp : 8 * spp;
            struct batches x = render_batches(t, &scene, name, 5, samples, BATCHES, TILE, (uint64_t)k + 2);
            double p = verify_batches(&x, &right, 1).p, ratio = batches_mean(&x, NULL) / batches_mean(&right, NULL);
            if (k > RUNNERS)
                TEST_REJECT(t, p, "%s, %s: %.4f of the light", names[i], way, ratio);
            else
                TEST_ACCEPT(t, p, "%s, %s: %.4f of the light", names[i], way, ratio);
            batches_free(&x);
        }
        batches_free(&right);
        scene_free(&scene);
    }
}

/* The parameter names the runner that it says. */
static void test_names(struct test *t)
{
    static const char *const pairs[][2] = {{"asbdpt race=all", "asbdpt race=off"},
                                           {"asbdpt race=quarter", "asbdpt race=off pathpixels=4"}};
    const struct render_job o = {.end = 2, .n_threads = 1, .max_depth = 4};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 16, 16, &scene))
        return;
    for (int i = 0; i < 2; i++)
        CHECK(t, same_picture(t, &scene, pairs[i][0], pairs[i][1], o), "%s is not %s", pairs[i][0], pairs[i][1]);
    scene_free(&scene);
}

/* race_winner: the least product wins, but of path tracers only if it is less than three quarters of the others'. */
static void test_winner(struct test *t)
{
    static const struct {
        double variance[RUNNERS];
        int winner;
    } cases[] = {{{5, 4, 6, 7}, RUNNER_QUARTER}, {{4, 5, 6, 7}, RUNNER_ALL}, {{5, 5, 4, 5}, RUNNER_ALL},
                 {{5, 5, 3.8, 3.7}, RUNNER_ONE_POINT}, {{5, 5, 3.8, 3.8}, RUNNER_ALL},
                 {{1e30, 1e30, 4, 1e30}, RUNNER_PATH_TRACER}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct runner runner[RUNNERS];
        for (int k = 0; k < RUNNERS; k++)
            runner[k] = (struct runner){.variance = cases[i].variance[k] / (k + 1), .price = k + 1};
        CHECK(t, race_winner(runner) == cases[i].winner, "case %d: %s wins", (int)i, runner_name(race_winner(runner)));
    }
}

/* counts_of: exact. */
static void test_counts(struct test *t)
{
    const double twice[] = {2, 2};
    const struct numbers n = {.path_pixels = 4, .draws = {3, 1}, .light_points = 2};
    const struct counts c = counts_of(n, 5, twice, 0, 100, &NO_TABLES);
    CHECK(t, c.s0[FIRST_HIT] == 5 && c.s1[FIRST_HIT] == 10, "first hit");
    CHECK(t, c.s0[LATER_HIT] == 1 && c.s1[LATER_HIT] == 1, "later");
    CHECK(t, c.pair[FIRST_HIT] == 6 && c.pair[LATER_HIT] == 2 && c.lens == 25, "light sub-paths");
    const struct numbers path_tracer = {.draws = {3, 1}, .light_points = 1};
    const struct counts pt = counts_of(path_tracer, 1, twice, 0, 100, &NO_TABLES);
    CHECK(t, pt.pair[FIRST_HIT] == 0 && pt.lens == 0 && pt.s0[LATER_HIT] == 1, "a path tracer");
    const struct counts lt = counts_of((struct numbers){.path_pixels = 1}, 5, twice, 0, 100, &NO_TABLES);
    struct numbers rare = n;
    rare.every = 8;
    const struct counts r = counts_of(rare, 5, twice, 0, 100, &NO_TABLES);
    CHECK(t, r.pair[FIRST_HIT] == 6.0 / 8 && r.pair[LATER_HIT] == 2.0 / 8 && r.lens == 25.0 / 8 &&
          r.s1[LATER_HIT] == 1, "light sub-paths in one of 8 iterations");
    CHECK(t, lt.s0[FIRST_HIT] == 0 && lt.s1[LATER_HIT] == 0 && lt.lens == 100, "a light tracer");
}

void test_race(struct test *t)
{
    test_counts(t);
    test_winner(t);
    test_where_they_pay(t);
    test_where_learning_pays(t);
    test_where_nothing_pays(t);
    test_nothing_is_given_up(t);
    test_beam(t);
    test_wish(t);
    test_lamp_alone(t);
    test_names(t);
    test_turns(t);
    test_streams_of_turns(t);
    test_expectations(t, 8);
}

void test_race_long(struct test *t) { test_expectations(t, 64); }
