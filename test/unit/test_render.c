/* test_render.c: whole renders: radiance in closed form, tiles, blocks, stopping, crop windows, borders. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lab/methods.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "agree.h"
#include "helpers.h"
#include "suites.h"

/* --- known on paper (test_scenes.c has more) ------------------------------------------------------------- */

/* A scene in which all methods see the same in every pixel, to the last digits. */
static void all_see(struct test *t, const char *text, rgb expected)
{
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++) {
        struct batches b = render_batches(t, &scene, set_method(&scene, method_name(*m)), 4, 8, 1, 8, 12);
        rgb seen = {b.value[0], b.value[1], b.value[2]};
        CHECK(t, fabs(seen.r - expected.r) + fabs(seen.g - expected.g) + fabs(seen.b - expected.b) < 1e-6,
              "%s sees %g %g %g, not %g", method_name(*m), seen.r, seen.g, seen.b, expected.r);
        batches_free(&b);
    }
    scene_free(&scene);
}

/* No shapes at all: every ray sees the sky. */
static const char EMPTY[] = "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
                            "WorldBegin LightSource \"infinite\" \"rgb L\" [.25 .5 .75] WorldEnd\n";

/* Of films and tiles of any size every pixel belongs to one tile, and each finds it where it has put it. */
static void test_tiling(struct test *t)
{
    enum { ROUNDS = 200, SIDE = 40 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 11, 0);
    for (int round = 0; round < ROUNDS; round++) {
        int x0 = (int)(9 * rng_uniform(&r)), y0 = (int)(9 * rng_uniform(&r));
        int width = 1 + (int)(SIDE * rng_uniform(&r)), height = 1 + (int)(SIDE * rng_uniform(&r));
        struct pixel_rect film = {x0, y0, x0 + width, y0 + height};
        struct pass_size size = {1, 1 + (int)(9 * rng_uniform(&r)), 1 + (int)(7 * rng_uniform(&r))};
        struct tiling tiling = tiling_of(film, &size);
        int seen[SIDE * SIDE] = {0}, wrong = 0;
        for (int64_t k = 0; k < tiling_count(&tiling); k++) {
            struct tile_pixels p = tiling_pixels(&tiling, k);
            for (int i = 0, x, y; pixels_get(p, i, &x, &y); i++) {
                wrong += pixels_cell(p, x, y) != i;
                if (x >= film.x0 && x < film.x1 && y >= film.y0 && y < film.y1)
                    seen[(y - y0) * width + x - x0]++;
            }
        }
        for (size_t i = 0; i < rect_pixels(film); i++)
            wrong += seen[i] != 1;
        CHECK(t, wrong == 0, "%d x %d pixels from %d,%d, tiles of %d, %d together: %d are wrong", width, height,
              x0, y0, size.tile, size.spread, wrong);
    }
}

/* However the picture is cut into tiles, and these are interleaved: every sample of every pixel sees the sky once. */
static void test_tiles(struct test *t)
{
    static const int sizes[][2] = {{161, 90}, {33, 130}, {300, 7}, {1, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (const struct method *const *m = method_rows; *m != NULL; m++) {
            struct render_job o = {.end = 2, .n_threads = 2};
            struct scene scene;
            struct film film;
            long wrong = 0;
            if (method_is_chain(*m) || !scene_from_text(t, EMPTY, &scene))
                continue;
            scene.width = sizes[i][0];
            scene.height = sizes[i][1];
            o.integrator = set_row(&scene, method_name(*m));
            render_film(t, &scene, &o, &film);
            for (size_t k = 0; k < rect_pixels(film.rect) * 3; k += 3)
                wrong += !(fabs(film_value(&film, k) - 2 * .25) < 1e-6);
            CHECK(t, wrong == 0, "%s: %ld of %d x %d pixels have more than their samples, or less", o.integrator,
                  wrong, scene.width, scene.height);
            film_free(&film);
            scene_free(&scene);
        }
}

/* The first tiles lie all over the film: among any 16 that follow each other each quarter has 3 to 5. */
static void test_order(struct test *t)
{
    const struct pass_size size = {.tile = 16, .spread = 1};
    const struct tiling tiling = tiling_of((struct pixel_rect){0, 0, 320, 192}, &size);
    for (int first = 0; first < tiling_count(&tiling); first += 16) {
        int n[4] = {0, 0, 0, 0};
        for (int i = first; i < first + 16 && i < tiling_count(&tiling); i++)
            n[tiling_pixels(&tiling, i).rect.y0 / 48]++;
        CHECK(t, first + 16 > tiling_count(&tiling) || (n[0] > 2 && n[1] > 2 && n[2] > 2 && n[3] > 2),
              "tiles from %d on: %d, %d, %d and %d in the quarters of the film", first, n[0], n[1], n[2], n[3]);
    }
}

/* What pixels of one tile share forms no pattern: in two cells beside or below each other tiles have the same place as
 * often as chance has it, which is once, on average, with the variance 1. */
static void test_pattern(struct test *t)
{
    enum { CELL = 4, CELLS = 96, SIDE = CELL * CELLS };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 12, 0);
    int x0 = (int)rng_below(&r, 1 << 20), y0 = (int)rng_below(&r, 1 << 20), place[CELLS][CELLS];
    double same[2] = {0, 0}, n = CELLS * (CELLS - 1);
    for (int k = 0; k < CELL * CELL; k++) {
        struct tile_pixels p = {{x0, y0, x0 + SIDE, y0 + SIDE}, CELL, CELL, k % CELL, k / CELL};
        for (int i = 0, x, y; pixels_get(p, i, &x, &y); i++)
            place[i / CELLS][i % CELLS] = (y - y0) % CELL * CELL + (x - x0) % CELL;
        for (int i = 0; i < CELLS; i++)
            for (int j = 0; j + 1 < CELLS; j++) {
                same[0] += place[i][j] == place[i][j + 1];
                same[1] += place[j][i] == place[j + 1][i];
            }
    }
    for (int below = 0; below < 2; below++) {
        const char *where = below ? "below" : "beside";
        TEST_ACCEPT(t, stats_normal_p((same[below] - n) / sqrt(n)), "a tile's places in cells %s each other", where);
        TEST_REJECT(t, stats_normal_p((1.1 * same[below] - n) / sqrt(n)), "10 %% more of them are the same, %s", where);
    }
}

/* Lamps on one side of a wall, the camera on the other: no strategy may see through it. The floor ends before the wall,
 * since what merges vertices would merge those of both sides. */
static const char WALL[] =
    "LookAt 0 2 -4  0 .5 -1  0 1 0 Camera \"perspective\" \"float fov\" 60\n"
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
    "WorldBegin LightSource \"point\" \"point from\" [0 2 2] Material \"matte\"\n"
    QUAD("-5 0 -5  5 0 -5  5 0 -1  -5 0 -1") QUAD("-5 0 1  5 0 1  5 0 5  -5 0 5")
    QUAD("-9 -9 0  9 -9 0  9 9 0  -9 9 0")
    "AreaLightSource \"diffuse\" Translate 1 2 2 Shape \"sphere\" WorldEnd\n";

/* --- blocks ------------------------------------------------------------------------------------------ */

/* The length of blocks says how often a render is at the end of one; it does not change the picture. */
struct ends {
    const struct film *film;
    long n;
};

static void count_end(void *context, double learnt, double done)
{
    struct ends *e = context;
    (void)learnt;
    e->n += done > 0 && e->film->passes == 0;
}

static void blocks(struct test *t, const char *integrator, int size, int spp, int longest)
{
    struct scene scene;
    struct film film[2];
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", size, size, &scene))
        return;
    for (int i = 0; i < 2; i++) {
        struct ends ends = {&film[i], 0};
        struct render_job o = {.integrator = method_of(&scene, integrator), .end = spp,
                                   .block = i == 1 ? 1 : longest,
                                   .n_threads = 2, .progress = count_end, .context = &ends};
        render_film(t, &scene, &o, &film[i]);
        CHECK(t, ends.n == (i == 1 ? spp : 1), "block %d: %ld ends", o.block, ends.n);
    }
    CHECK(t, films_equal(&film[0], &film[1]), "%s: the length of blocks changes the picture", integrator);
    film_free(&film[0]);
    film_free(&film[1]);
    scene_free(&scene);
}

static void test_blocks(struct test *t)
{
    blocks(t, "bdpt", 20, 6, 0);  /* four tiles */
    blocks(t, "lt", 20, 600, 600); /* the first tile holds more splats than wait for the end of its pass */
}

/* --- stopping ---------------------------------------------------------------------------------------- */

/* Says stop from the question number `most` on, or as soon as the film has splats. */
struct stopper {
    const struct film *film;
    long asked, most;
};

static enum cancel stop_at(void *context)
{
    struct stopper *s = context;
    return ++s->asked >= s->most ? CANCEL_NOW : CANCEL_NOT;
}

static enum cancel stop_at_splats(void *context)
{
    struct stopper *s = context;
    s->asked++;
    return film_value(s->film, 3 * (8 * 16 + 8) + 1) > 0 ? CANCEL_NOW : CANCEL_NOT;
}

/* Every method asks before each sample, and stops when told to; the pass it was in is left out. */
static void test_stop(struct test *t)
{
    struct scene scene;
    struct film film;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 32, 32, &scene))
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++) {
        struct stopper s = {&film, 0, 100};
        const char *way = method_name(*m);
        struct render_job o = {.integrator = set_row(&scene, way), .end = 32, .block = 32, .n_threads = 1,
                                   .max_depth = 3, .cancel = stop_at, .context = &s};
        render_film(t, &scene, &o, &film);
        CHECK(t, s.asked >= s.most && s.asked < s.most + 4 * LONGEST_BLOCK && film.iterations == 0 &&
                     (film.passes == 0 || method_is_chain(*m)), /* some chains are complete before */
              "%s: told to stop at question %ld of %ld; %ld samples", way, s.most, s.asked, film.iterations);
        film_free(&film);
    }
    scene_free(&scene);
}

/* But a pass some of whose splats are in the film already goes on to its end. */
static void test_stop_late(struct test *t)
{
    struct scene scene;
    struct film film;
    struct stopper s = {&film, 0, 0};
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 16, 16, &scene))
        return;
    struct render_job o = {.integrator = method_named("lt"), .end = 600, .block = 600, .n_threads = 1,
                               .max_depth = 5,
                               .cancel = stop_at_splats, .context = &s};
    render_film(t, &scene, &o, &film);
    CHECK(t, s.asked < 16 * 16 * 600 && film.iterations == 600, "%ld questions, %ld samples", s.asked,
          film.iterations);
    film_free(&film);
    scene_free(&scene);
}

/* --- filters with negative lobes --------------------------------------------------------------------- */

/* The largest difference of a pixel from 1, of a sky of 1. */
static double sky_error(struct test *t, const char *filter, struct render_job o, long *samples)
{
    struct scene scene;
    struct film film;
    float pixels[12 * 9 * 3];
    double most = 0;
    if (!scene_from_format(t, &scene, "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 9\n"
                           "PixelFilter \"%s\" WorldBegin LightSource \"infinite\" WorldEnd\n", filter))
        return INFINITY;
    o.integrator = method_named("pt");
    render_film(t, &scene, &o, &film);
    film_develop(&film, 1, pixels);
    for (int i = 0; i < 12 * 9 * 3; i++)
        most = fmax(most, fabs((double)pixels[i] - 1));
    *samples = film.iterations;
    film_free(&film);
    scene_free(&scene);
    return most;
}

static void note(void *context, double learnt, double done)
{
    bool *begun = context;
    (void)learnt;
    *begun |= done > 0;
}

static enum cancel stop_when_begun(void *context)
{
    const bool *begun = context;
    return *begun ? CANCEL_NOW : CANCEL_NOT;
}

/* The weights of four samples add up to 4, in a render that is stopped, too, but not those of half a cycle. */
static void test_negative_lobes(struct test *t)
{
    static const char *const FILTERS[] = {"mitchell", "sinc"};
    for (int i = 0; i < 2; i++) {
        bool begun = false;
        struct render_job o = {.end = 4};
        struct render_job stopped = {.end = 16, .max_depth = 1000, .progress = note,
                                     .cancel = stop_when_begun, .context = &begun, .n_threads = 1};
        long n;
        for (; o.end <= 64; o.end *= 4)
            CHECK(t, sky_error(t, FILTERS[i], o, &n) < 0.05, "%s, %ld samples: a sky of 1 is not 1", FILTERS[i], n);
        CHECK(t, sky_error(t, FILTERS[i], stopped, &n) < 0.05 && n < 16, "%s, stopped at %ld", FILTERS[i], n);
        o.end = 6;
        CHECK(t, sky_error(t, FILTERS[i], o, &n) > 0.1, "%s: any number of samples is one of whole cycles", FILTERS[i]);
    }
}

/* --- Russian roulette -------------------------------------------------------------------------------- */

/* Each integrator has its own default threshold, whatever parameters of other integrators are set; the user's wins. */
static void test_roulette_defaults(struct test *t)
{
    static const struct {
        const char *way, *as, *other; /* of the same picture as with `as`, of another than with `other` */
    } cases[] = {{"pt select=bins", " rrthreshold=0.5", " rrthreshold=0"},
                 {"bdpt select=bins", " rrthreshold=0.5", " rrthreshold=0"},
                 {"asbdpt select=vertices", " rrthreshold=0.5", " rrthreshold=0"},
                 {"asbdpt select=bins", " rrthreshold=0", " rrthreshold=0.5"}};
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/mirror-glass.pbrt", 24, 24, &scene))
        return;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct render_job o = {.end = 4, .max_depth = 4};
        char as[128], other[128];
        snprintf(as, sizeof as, "%s%s", cases[i].way, cases[i].as);
        snprintf(other, sizeof other, "%s%s", cases[i].way, cases[i].other);
        CHECK(t, same_picture(t, &scene, cases[i].way, as, o) && !same_picture(t, &scene, cases[i].way, other, o),
              "%s: not as with%s", cases[i].way, cases[i].as);
    }
    scene_free(&scene);
}

/* --- crop -------------------------------------------------------------------------------------------- */

/* Means of the lower right quarter, once cut out of the full frame, once rendered as a crop window. */
static void test_crop(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", 24, 24, &scene))
        return;
    static const char *const methods[] = {"bdpt", "lt"};
    for (int m = 0; m < 2; m++) {
        int spp = m == 0 ? 8 : 16;
        struct batches full = render_batches(t, &scene, methods[m], 3, spp, 12, 12, 31);
        scene.crop[0] = scene.crop[2] = 0.5;
        struct batches part = render_batches(t, &scene, methods[m], 3, 2 * spp, 12, 12, 33);
        scene.crop[0] = scene.crop[2] = 0;
        for (int i = 0; i < full.n_batches; i++) /* keep only the last of the 2x2 tiles of the full frame */
            memcpy(&full.value[3 * i], &full.value[12 * i + 9], 3 * sizeof *full.value);
        full.n = 3;
        check_agree(t, &part, &full, false, 0, "a crop window against the full frame, %s", methods[m]);
        batches_free(&full);
    }
    scene_free(&scene);
}

/* --- the border of the film --------------------------------------------------------------------------- */

/* A wall that a spot light shines on, far beyond the film. */
static const char BORDER[] =
    "LookAt 0 0 -3  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 60 PixelFilter \"gaussian\"\n"
    "Film \"image\" \"integer xresolution\" 6 \"integer yresolution\" 6 WorldBegin\n"
    "LightSource \"spot\" \"point from\" [0.1 0.2 -3] \"point to\" [0.1 0.2 0] \"float coneangle\" 50\n"
    "Material \"matte\" " QUAD("-9 -9 0  9 -9 0  9 9 0  -9 9 0") "WorldEnd\n";

/* The outermost pixels of one side of the film: every k-th, and how many are left out before. */
static struct batches side_of(const struct batches *all, int first, int step)
{
    struct batches out = batches_new(all->n_batches, 1, false);
    int side = (int)(sqrt((double)all->n / 3) + 0.5);
    for (int b = 0; b < all->n_batches; b++)
        for (int i = 0; i < side; i++)
            out.value[b] += all->value[b * all->n + 3 * (first + i * step)] / side;
    return out;
}

/* A filter wider than a pixel collects what arrives beside the film. The path tracer draws its rays there, light
 * sub-paths are projected there. */
static void test_border(struct test *t)
{
    enum { SIZE = 6 };
    static const struct {
        const char *name;
        int first, step;
    } SIDES[] = {{"left", 0, SIZE}, {"right", SIZE - 1, SIZE}, {"upper", 0, 1}, {"lower", SIZE * (SIZE - 1), 1}};
    struct scene scene;
    if (!scene_from_text(t, BORDER, &scene))
        return;
    struct batches pt = render_batches(t, &scene, "pt", 1, 64, 16, 1, 35);
    struct batches lt = render_batches(t, &scene, "lt", 1, 512, 16, 1, 36);
    for (size_t i = 0; i < sizeof SIDES / sizeof SIDES[0]; i++) {
        struct batches a = side_of(&lt, SIDES[i].first, SIDES[i].step);
        struct batches b = side_of(&pt, SIDES[i].first, SIDES[i].step);
        check_agree(t, &a, &b, false, -0.02, "lt against pt, %s border of the film", SIDES[i].name);
        batches_free(&b);
    }
    batches_free(&pt);
    batches_free(&lt);
    scene_free(&scene);
}

void test_render(struct test *t)
{
    all_see(t, EMPTY, rgb_make(.25, .5, .75));
    all_see(t, WALL, rgb_black());
    test_tiling(t);
    test_tiles(t);
    test_order(t);
    test_pattern(t);
    test_blocks(t);
    test_stop(t);
    test_stop_late(t);
    test_negative_lobes(t);
    test_roulette_defaults(t);
    test_crop(t);
    test_border(t);
}
