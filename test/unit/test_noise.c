/* test_noise.c: the noise computed from two halves of the samples, against known noise and against errors relative to
 * a reference. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/rng.h"
#include "helpers.h"
#include "render/noise_estimate.h"
#include "suites.h"

/* Pixels of uniform numbers and splats, some 20 deviations of the estimate's own error apart from a noise that lacks
 * either. */
static void test_known(struct test *t)
{
    enum { SIDE = 64, ITERATIONS = 8, SPLATS = SIDE * SIDE / 4 };
    struct pixel_rect all = {0, 0, SIDE, SIDE};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 61, 0);
    struct filter box = filter_of("box");
    struct tile tile = {.splat = NULL};
    struct film film;
    film_init(&film, all, SIDE, SIDE);
    CHECK(t, !noise_measure(&film, 1), "a film without halves has an estimate");
    film_keep_halves(&film);
    film.run = 2;
    for (int i = 0; i < ITERATIONS; i++) {
        bool whole = i > 0 && i % 4 == 0;
        CHECK(t, noise_measure(&film, 1) == whole, "an estimate at %d iterations", i);
        tile_start(&tile, pixels_all(all), all, &box);
        tile.first_half = i / 2 % 2 == 0;
        for (int p = 0; p < SIDE * SIDE; p++)
            tile_add(&tile, p % SIDE, p / SIDE, rgb_make(rng_uniform(&r), rng_uniform(&r), rng_uniform(&r)));
        for (int k = 0; k < SPLATS; k++)
            tile_add_splat(&tile, SIDE * rng_uniform(&r), SIDE * rng_uniform(&r), rgb_make(1, 0, 0));
        film_merge_tile(&film, &tile);
        film.iterations++;
    }
    /* Variances of one iteration: 1/12 of each uniform number, 1/4 of the splats' count in one channel of three. */
    double variance = (1.0 / 12 + 0.25 / 3) / ITERATIONS, mean = 0.5 + 0.25 / 3;
    for (double scale = 1; scale < 3; scale++) {
        const struct noise_estimate *e = &film.noise[NOISE_RELATIVE];
        double expected = sqrt(variance * sqr(scale) / (sqr(mean * scale) + 0.01));
        CHECK(t, noise_measure(&film, scale), "no estimate");
        CHECK(t, fabs(e->value - expected) < 4 * e->error, "noise %g +- %g, not %g",
              e->value, e->error, expected);
        CHECK(t, fabs(expected * sqrt(0.5) - expected) > 10 * e->error && e->error > 0, "its error is %g", e->error);
    }
    film.passes = 1;
    CHECK(t, !noise_measure(&film, 1), "an estimate within a block");
    tile_free(&tile);
    film_free(&film);
}

/* --- against references -------------------------------------------------------------------------------- */

static double level(double x) { return 255 * srgb_encode(clamp(x, 0, 1)); }

/* The mean squares that noise_estimate.h defines, of a picture beside its reference, whose own error is taken off. */
static void measure(const float *picture, const struct side *ref, double out[N_NOISE_SCALES])
{
    const double *mean = ref->pixels.value, *off = ref->pixels.error;
    int w = ref->width, h = ref->height;
    double n = 3.0 * w * h;
    out[NOISE_RELATIVE] = out[NOISE_8_BIT] = 0;
    for (int b = 0; b < 16; b++) {
        double sum = 0, error = 0, count = 0;
        for (int y = b / 4 * h / 4; y < (b / 4 + 1) * h / 4; y++)
            for (int x = 3 * (b % 4 * w / 4); x < 3 * ((b % 4 + 1) * w / 4); x++, count++) {
                int i = 3 * w * y + x;
                sum += mean[i];
                error += sqr((double)picture[i] - mean[i]) - sqr(off[i]);
                out[NOISE_8_BIT] += (sqr(level((double)picture[i]) - level(mean[i])) -
                                     sqr(level(mean[i] + off[i]) - level(mean[i]))) / n;
            }
        out[NOISE_RELATIVE] += error / (sqr(sum / count) + 0.01) / n;
    }
}

/* The noise that is told by the noise that there is lies between LOW and HIGH; the mean of four pictures, whose noise
 * is half as large, does not have what was told. */
static void test_told(struct test *t, const struct scene *scene, const struct side *ref, const char *integrator)
{
    enum { SPP = 64, SEEDS = 4 };
    const double LOW = 0.85, HIGH = 1.7;
    double told[N_NOISE_SCALES] = {0, 0}, is[N_NOISE_SCALES] = {0, 0}, error[N_NOISE_SCALES];
    size_t n = 3 * (size_t)ref->width * (size_t)ref->height;
    float *picture = mem_alloc(n, sizeof *picture), *mean = mem_alloc(n, sizeof *mean);
    for (int seed = 0; seed < SEEDS; seed++) {
        struct render_job o = {.integrator = method_of(scene, integrator), .seed = test_seed(t) + (uint64_t)seed,
                                   .end = SPP,
                                   .n_threads = os_cores()};
        struct film film;
        struct error err = {.text = ""};
        film_init(&film, render_crop(scene), scene->width, scene->height);
        film_keep_halves(&film);
        CHECK(t, render_by(scene, &o, &film, &err) && film.iterations == SPP, "%s", err.text);
        film_develop(&film, scene->film_scale, picture);
        for (size_t i = 0; i < n; i++)
            mean[i] += picture[i] / SEEDS;
        measure(picture, ref, error);
        for (int s = 0; s < N_NOISE_SCALES; s++) {
            is[s] += error[s] / SEEDS;
            told[s] += sqr(film.noise[s].value) / SEEDS;
        }
        film_free(&film);
    }
    measure(mean, ref, error);
    for (int s = 0; s < N_NOISE_SCALES; s++) {
        double ratio = sqrt(told[s] / is[s]), fewer = sqrt(told[s] / error[s]);
        CHECK(t, ratio > LOW && ratio < HIGH, "%s, scale %d: the noise told is %g of the noise", integrator, s, ratio);
        CHECK(t, fewer > HIGH, "%s, scale %d: so it is with four times the samples, %g", integrator, s, fewer);
    }
    free(picture);
    free(mean);
}

static void test_pictures_told(struct test *t, const char *const *methods)
{
    struct scene scene;
    struct side ref = {0};
    if (!read_reference(t, "ref/cornell-box.pfm", &ref) ||
        !scene_from_file(t, "scenes/cornell-box.pbrt", ref.width, ref.height, &scene))
        return;
    for (; *methods != NULL; methods++)
        test_told(t, &scene, &ref, *methods);
    scene_free(&scene);
    batches_free(&ref.pixels);
}

/* --- a render that ends by it -------------------------------------------------------------------------- */

/* It ends at the same sample for any number of threads, and its film is that of so many samples. */
static void test_end(struct test *t, const char *way, long runs)
{
    struct scene scene;
    struct film film[3];
    struct error err = {.text = ""};
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 24, 20, &scene))
        return;
    struct render_job o = {.integrator = set_row(&scene, way), .seed = 3, .end = 1024};
    for (int i = 0; i < 3; i++) {
        film_init(&film[i], render_crop(&scene), scene.width, scene.height);
        if (i < 2)
            film_keep_halves(&film[i]);
        o.n_threads = 1 + 2 * i;
        o.noise[NOISE_8_BIT] = i < 2 ? 5 : 0;
        o.end = i < 2 ? 1024 : film[0].iterations;
        CHECK(t, render_by(&scene, &o, &film[i], &err), "%s", err.text);
    }
    CHECK(t, film[0].noise[NOISE_8_BIT].value < 5 && film[0].iterations < 1024 && film[0].iterations % runs == 0,
          "%s: noise %g at %ld samples", way, film[0].noise[NOISE_8_BIT].value, film[0].iterations);
    for (int i = 1; i < 3; i++)
        CHECK(t, film[i].iterations == film[0].iterations && films_equal(&film[i], &film[0]), "%s: film %d", way, i);
    CHECK(t, film[1].noise[NOISE_RELATIVE].value == film[0].noise[NOISE_RELATIVE].value, "%s: the estimate", way);
    for (int i = 0; i < 3; i++)
        film_free(&film[i]);
    scene_free(&scene);
}

/* Halves are the same however samples are cut into blocks: a picture of this size has some of less than a run. */
static void test_blocks(struct test *t)
{
    struct scene scene;
    struct film film[2];
    struct error err = {.text = ""};
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 75, 75, &scene))
        return;
    struct render_job o = {.integrator = method_named("pt"), .end = 64, .max_depth = 1, .n_threads = 2};
    for (int i = 0; i < 2; i++) {
        film_init(&film[i], render_crop(&scene), scene.width, scene.height);
        film_keep_halves(&film[i]);
        o.block = i;
        CHECK(t, render_by(&scene, &o, &film[i], &err), "%s", err.text);
    }
    size_t differ = 0, n = 3 * rect_pixels(film[0].rect);
    for (size_t i = 0; i < n; i++)
        differ += exact_value(&film[0].half[i]) != exact_value(&film[1].half[i]);
    CHECK(t, differ == 0, "%d of the first half's sums depend on the blocks", (int)differ);
    for (int i = 0; i < 2; i++)
        film_free(&film[i]);
    scene_free(&scene);
}

void test_noise_long(struct test *t)
{
    static const char *const ways[] = {"pt", "lt", "asbdpt", NULL};
    test_pictures_told(t, ways);
}

void test_noise(struct test *t)
{
    static const char *const ways[] = {"bdpt", NULL};
    test_blocks(t);
    test_known(t);
    test_pictures_told(t, ways);
    test_end(t, "bdpt", 64);
    test_end(t, "asbdpt select=bins restart=24", 96);
    CHECK(t, noise_run(1) == 32 && noise_run(24) == 48 && noise_run(INT_MAX) == INT_MAX, "runs");
}
