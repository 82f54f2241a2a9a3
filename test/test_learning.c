/* test_learning.c: the contract of learning (learn.h): a budget that no number of samples changes, an end at any time,
 * grids where vertices are, and a value that survives as bytes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "helpers.h"
#include "image/zlib.h"
#include "learning/learn.h"
#include "learning/learnt_file.h"
#include "render/render.h"
#include "tests.h"

static const struct wish ALL = {.importance = true, .guide = true, .pairs = true, .eye_cells = 8, .light_cells = 16,
                                .levels = REGION_LEVELS, .delta = 0.1, .emission = 0.2};

/* Who watches: how much was traced, and when to say stop. */
struct watcher {
    double traced, patience;
};

static bool watch(void *context, double traced)
{
    struct watcher *w = context;
    w->traced = traced;
    return traced < w->patience;
}

static struct learnt *learn_scene(const struct scene *scene, struct watcher *w, int n_threads)
{
    struct learnt *l = mem_alloc(1, sizeof *l);
    struct render_job job = {.scene = scene, .film_rect = render_crop(scene), .seed = 3, .eye_seed = 3, .max_depth = 4,
                             .n_threads = n_threads, .rr_threshold = 0.5, .spatial_lights = true, .watch = watch,
                             .watch_context = w};
    learn(&job, &ALL, l);
    return l;
}

static void drop(struct learnt *l)
{
    learnt_free(l);
    free(l);
}

/* --- the value as bytes ------------------------------------------------------------------------------- */

static void seal(struct bytes *b)
{
    uint32_t crc = checksum_crc32(0, b->data, b->n - 4);
    for (int i = 0; i < 4; i++)
        b->data[b->n - 4 + (size_t)i] = (uint8_t)(crc >> 8 * i);
}

/* The guide's sums rise to 1, or nearly. */
static bool guide_is_whole(const struct learnt *l)
{
    for (int i = 0; l->guided && i < l->guide.n; i++)
        for (int k = 0, n = l->guide.columns.n; k < n; k++)
            if (!(l->guide.before[i * (n + 1) + k + 1] >= l->guide.before[i * (n + 1) + k]))
                return false;
    return true;
}

/* Bytes that are damaged, with a check sum that is not: refused, or tables that can be used without harm (which
 * sanitizers see). */
static void test_damage(struct test *t, const struct scene *scene, const struct bytes *good)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 7, 0);
    int refused = 0;
    enum { TRIES = 300 };
    for (int i = 0; i < TRIES; i++) {
        struct bytes bad = {mem_alloc(good->n, 1), good->n, good->n};
        struct learnt l = {.guided = false};
        struct error err;
        memcpy(bad.data, good->data, good->n);
        size_t at = 40 + rng_below(&r, (uint32_t)(i % 2 == 0 ? 600 : good->n - 50));
        bad.data[at] = (uint8_t)rng_below(&r, 256);
        if (i % 5 == 0)
            bad.n -= 8 * (1 + rng_below(&r, 100));
        seal(&bad);
        bool ok = learnt_read(&l, &scene->lights, 5, &bad, "x", &err);
        refused += !ok;
        CHECK(t, !ok || guide_is_whole(&l), "damage at byte %lu gives a table that leads beyond its end",
              (unsigned long)at);
        for (int k = 0; ok && k < 20; k++) {
            int e, y;
            double pmf;
            vec3 p = vec(rng_uniform(&r), rng_uniform(&r), rng_uniform(&r));
            l.model.locate(&l, p, vec(0, 0, 1), &e, &y);
            double rho = 1, u[2] = {rng_uniform(&r), rng_uniform(&r)};
            bool aims = l.model.choose_emission == NULL ||
                        (l.model.choose_emission(&l, &scene->lights, rng_uniform(&r), u, &rho) <
                             scene->lights.n_cells && rho > 0 && rho < 1e6);
            bool fine = aims && (l.model.connect == NULL || l.model.connect(&l, y, e) >= 0) &&
                        (l.model.choose_light == NULL ||
                         l.model.choose_light(&l, &scene->lights, e, rng_uniform(&r), &pmf) < scene->lights.n_cells);
            CHECK(t, fine, "damage at byte %lu gives a table of no use", (unsigned long)at);
        }
        learnt_free(&l);
        free(bad.data);
    }
    CHECK(t, refused > TRIES / 5, "only %d of %d damaged files are refused", refused, TRIES);
}

/* A changed bit is seen by the check sum; bytes that end elsewhere than the lessons are none, whatever it says. */
static void test_ends(struct test *t, const struct scene *scene, const struct bytes *good)
{
    static const int more[] = {0, 8, -8};
    for (int i = 0; i < 3; i++) {
        size_t n = good->n + (size_t)more[i];
        struct bytes bad = {mem_alloc(good->n + 8, 1), n, good->n + 8};
        struct learnt l = {.guided = false};
        struct error err;
        memcpy(bad.data, good->data, n < good->n ? n : good->n);
        if (i == 0)
            bad.data[n - 40] ^= 1;
        else
            seal(&bad);
        CHECK(t, !learnt_read(&l, &scene->lights, 5, &bad, "x", &err), "%d bytes more, or a changed bit, are taken",
              more[i]);
        learnt_free(&l);
        free(bad.data);
    }
}

/* Tables of emission that somebody has made: a bin that is never drawn, and probabilities of more than 1 in all. */
static void test_made_up(struct test *t, const struct scene *scene, struct learnt *l)
{
    static const double made_up[] = {0, 0.5, 1e300};
    CHECK(t, l->aimed, "emission was not learnt");
    for (int i = 0; i < 3; i++) {
        struct bytes bytes = {NULL, 0, 0};
        struct learnt again = {.guided = false};
        struct error err;
        double kept = l->emission.q[9];
        l->emission.q[9] = made_up[i];
        learnt_write(l, 5, &bytes);
        CHECK(t, !learnt_read(&again, &scene->lights, 5, &bytes, "x", &err), "%g for a bin is taken", made_up[i]);
        l->emission.q[9] = kept;
        learnt_free(&again);
        free(bytes.data);
    }
}

static void test_bytes(struct test *t, const struct scene *scene, const struct learnt *l)
{
    struct bytes one = {NULL, 0, 0}, two = {NULL, 0, 0};
    struct learnt again = {.guided = false}, other = {.guided = false};
    struct error err = {""};
    learnt_write(l, 5, &one);
    if (CHECK(t, learnt_read(&again, &scene->lights, 5, &one, "x", &err), "%s", err.text)) {
        learnt_write(&again, 5, &two);
        CHECK(t, one.n == two.n && memcmp(one.data, two.data, one.n) == 0, "what was read is not what was written");
    }
    CHECK(t, !learnt_read(&other, &scene->lights, 6, &one, "x", &err), "read for another picture");
    learnt_free(&again);
    learnt_free(&other);
    test_ends(t, scene, &one);
    test_damage(t, scene, &one);
    free(one.data);
    free(two.data);
}

/* --- budget, threads, end ----------------------------------------------------------------------------- */

static void test_budget(struct test *t)
{
    struct scene small, large;
    if (!scene_from_file(t, "scenes/many-lights.pbrt", 24, 16, &small) ||
        !scene_from_file(t, "scenes/many-lights.pbrt", 96, 64, &large))
        return;
    struct watcher w[4] = {{0, INFINITY}, {0, INFINITY}, {0, INFINITY}, {0, 300}};
    struct learnt *l[4] = {learn_scene(&small, &w[0], 1), learn_scene(&small, &w[1], 3), learn_scene(&large, &w[2], 2),
                           learn_scene(&large, &w[3], 2)};
    struct bytes bytes[2] = {{NULL, 0, 0}, {NULL, 0, 0}};
    CHECK(t, w[0].traced > 1000 && w[0].traced < 8000, "%g sub-paths for a small picture", w[0].traced);
    CHECK(t, w[2].traced > 4 * w[0].traced && w[2].traced < 16 * w[0].traced,
          "%g sub-paths for 16 times as many pixels",
          w[2].traced);
    CHECK(t, w[3].traced < 1000 && l[3]->eye.n >= 1, "it goes on when told to stop: %g sub-paths", w[3].traced);
    learnt_write(l[0], 5, &bytes[0]);
    learnt_write(l[1], 5, &bytes[1]);
    CHECK(t, bytes[0].n == bytes[1].n && memcmp(bytes[0].data, bytes[1].data, bytes[0].n) == 0,
          "what is learnt depends on the number of threads");
    CHECK(t, l[0]->guided && l[0]->paired, "nothing was learnt");
    test_bytes(t, &small, l[0]);
    test_made_up(t, &small, l[0]);
    for (int i = 0; i < 4; i++)
        drop(l[i]);
    free(bytes[0].data);
    free(bytes[1].data);
    scene_free(&small);
    scene_free(&large);
}

/* A picture of one pixel is looked at, too, and one of a million no longer than one of 32768. */
static void test_bounds(struct test *t)
{
    static const int sides[] = {1, 182, 1024};
    double traced[3];
    for (int i = 0; i < 3; i++) {
        struct scene scene;
        struct watcher w = {0, INFINITY};
        if (!scene_from_text(t, "Camera \"perspective\" WorldBegin LightSource \"point\" WorldEnd", &scene))
            return;
        scene.width = scene.height = sides[i];
        camera_prepare(&scene.camera, sides[i], sides[i]);
        drop(learn_scene(&scene, &w, 2));
        traced[i] = w.traced;
        scene_free(&scene);
    }
    CHECK(t, traced[0] > 4000 && traced[2] == traced[1], "%g sub-paths for one pixel, %g for 182^2, %g for 1024^2",
          traced[0], traced[1], traced[2]);
}

/* A render whose time is over while it learns has a picture of one block all the same. */
static bool impatient(void *context, double done)
{
    double *asked_first = context;
    *asked_first = *asked_first < 0 ? done : *asked_first;
    return false;
}

static void test_early_end(struct test *t)
{
    struct scene scene;
    struct film film;
    struct error err = {""};
    double asked_first = -1; /* at what share of all work */
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 48, 32, &scene)) /* two tiles */
        return;
    struct render_options o = {.integrator = "asbdpt", .end = 1000000, .n_threads = 2, .max_depth = 4,
                               .progress = impatient, .progress_context = &asked_first};
    film_init(&film, render_crop(&scene), 48, 32);
    CHECK(t, render_scene(&scene, &o, &film, &err), "%s", err.text);
    CHECK(t, film.iterations > 0 && film.iterations <= LONGEST_BLOCK && film_value(&film, 3 * (16 * 48 + 24)) > 0,
          "%ld samples of a render that was stopped at once", film.iterations);
    CHECK(t, asked_first >= 0 && asked_first * 1e6 * 48 * 32 < 1000, "asked first after %g of the work", asked_first);
    film_free(&film);
    scene_free(&scene);
}

/* --- grids -------------------------------------------------------------------------------------------- */

/* One triangle far away moves no region, be it black or seen by few. */
static void test_far_triangle(struct test *t)
{
    static const char scene_text[] =
        "LookAt 0 1 -3.4  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 40 WorldBegin\n"
        "Material \"matte\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
        "  \"point P\" [-2 0 -2  2 0 -2  2 0 2  -2 0 2]\n"
        "Shape \"sphere\" AttributeBegin AreaLightSource \"diffuse\" Translate 0 3 0 Shape \"disk\" AttributeEnd\n"
        "%s WorldEnd";
    static const char *const far[] = {
        "", "Material \"matte\" \"rgb Kd\" [0 0 0] Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
            "\"point P\" [1000 0 0  1001 0 0  1000 0 1]",
        "Material \"matte\" Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
            "\"point P\" [0 200 1000  50 200 1000  0 250 1000]"};
    enum { WAYS = sizeof far / sizeof far[0] };
    int regions[WAYS][2];
    for (int i = 0; i < WAYS; i++) {
        char text[1024];
        struct scene scene;
        struct watcher w = {0, INFINITY};
        snprintf(text, sizeof text, scene_text, far[i]);
        if (!scene_from_text(t, text, &scene))
            return;
        scene.width = scene.height = 32;
        camera_prepare(&scene.camera, 32, 32);
        struct learnt *l = learn_scene(&scene, &w, 2);
        regions[i][0] = l->eye.n;
        regions[i][1] = l->light.n;
        drop(l);
        scene_free(&scene);
    }
    CHECK(t, regions[0][0] > 20 && regions[0][1] > 50, "%d and %d regions", regions[0][0], regions[0][1]);
    for (int i = 1; i < WAYS; i++)
        CHECK(t, regions[i][0] > 0.8 * regions[0][0] && regions[i][1] > 0.8 * regions[0][1],
              "a far triangle leaves %d and %d regions of %d and %d", regions[i][0], regions[i][1], regions[0][0],
              regions[0][1]);
}

void test_learning(struct test *t)
{
    test_budget(t);
    test_bounds(t);
    test_early_end(t);
    test_far_triangle(t);
}
