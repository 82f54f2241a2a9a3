/* test_film.c: filters (normalisation, sampling against density), film sums. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "base/rng.h"
#include "base/vec.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "transport/sample.h"
#include "helpers.h"
#include "suites.h"


static const char *const NAMES[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};
enum { N_FILTERS = 5 };

static double integral(const struct filter *f)
{
    enum { N = 800 };
    double sum = 0, hx = 2 * f->radius[0] / N, hy = 2 * f->radius[1] / N;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++)
            sum += filter_eval(f, -f->radius[0] + (i + 0.5) * hx, -f->radius[1] + (j + 0.5) * hy) * hx * hy;
    return sum;
}

/* Signed weights of samples, summed per cell, against the filter's integral over the cell: a z-test per cell. The
 * planted fault samples with one radius 3 % too large. */
static double sampling_p(const struct filter *f, struct rng *r, double stretch)
{
    enum { CELLS = 12, N = 200000, SUB = 40 };
    double sum[CELLS] = {0}, square[CELLS] = {0}, smallest = 1;
    double width = 2 * f->radius[0] / CELLS;
    for (int i = 0; i < N; i++) {
        double x, y, w = filter_sample(f, rng_uniform(r), rng_uniform(r), &x, &y);
        int cell = (int)((x * stretch + f->radius[0]) / width);
        cell = cell < 0 ? 0 : cell >= CELLS ? CELLS - 1 : cell;
        sum[cell] += w;
        square[cell] += w * w;
    }
    for (int c = 0; c < CELLS; c++) {
        double expected = 0; /* of one sample: the integral over the cell, all y */
        for (int i = 0; i < SUB; i++)
            for (int j = 0; j < 20 * SUB; j++)
                expected += filter_eval(f, -f->radius[0] + (c + (i + 0.5) / SUB) * width,
                                        -f->radius[1] + (j + 0.5) * 2 * f->radius[1] / (20 * SUB)) *
                            width / SUB * 2 * f->radius[1] / (20 * SUB);
        double mean = sum[c] / N, variance = (square[c] / N - mean * mean) / N;
        smallest = least_of(smallest, stats_normal_p((mean - expected) / sqrt(variance)));
    }
    return 1 - pow(1 - smallest, CELLS);
}

static void test_filters(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 2, 0);
    for (int i = 0; i < N_FILTERS; i++) {
        struct filter f;
        CHECK(t, filter_default(NAMES[i], &f), "%s is unknown", NAMES[i]);
        f.radius[1] *= 1.5;
        filter_prepare(&f);
        double one = integral(&f);
        CHECK(t, fabs(one - 1) < 2e-4, "%s integrates to %g", NAMES[i], one);
        CHECK(t, filter_cycle(&f) == (i < 3 ? 1 : FILTER_CYCLE), "%s: a cycle of %d", NAMES[i], filter_cycle(&f));
        TEST_ACCEPT(t, sampling_p(&f, &r, 1), "samples of the %s filter", NAMES[i]);
        TEST_REJECT(t, sampling_p(&f, &r, 1.03), "samples of the %s filter stretched by 3 %%", NAMES[i]);
    }
    struct filter f;
    CHECK(t, !filter_default("tent", &f), "a filter that does not exist was found");
    filter_default("mitchell", &f);
    f.B = 1; /* the cubic B-spline */
    f.C = 0;
    filter_prepare(&f);
    CHECK(t, filter_cycle(&f) == 1, "a spline that touches 0 has a cycle");
}

/* The sum over a new film's pixels of what a tile's splats bring; how many pixels are not black. */
static double spread(struct tile *tile, int *pixels)
{
    struct film film;
    double sum = 0;
    film_init(&film, tile->film_rect, tile->film_rect.x1, tile->film_rect.y1);
    film_take_splats(&film, tile);
    *pixels = 0;
    for (size_t i = 0; i < (size_t)(rect_width(film.rect) * rect_height(film.rect)); i++) {
        sum += film_value(&film, 3 * i + 1);
        *pixels += film_value(&film, 3 * i + 1) != 0;
    }
    film_free(&film);
    return sum;
}

static void count_full(void *context, struct tile *tile)
{
    int *calls = context;
    ++*calls;
    tile->n_splats = 0;
}

/* A splat is one, however many pixels it covers, and a tile that is full is emptied before an iteration is added. */
static void test_memory(struct test *t)
{
    struct pixel_rect all = {0, 0, 64, 64}, one = {0, 0, 1, 1};
    struct filter f = filter_of("gaussian");
    struct tile tile = {.sum = NULL};
    int calls = 0;
    f.radius[0] = f.radius[1] = 32;
    filter_prepare(&f);
    tile_start(&tile, pixels_all(one), all, &f);
    tile.full = count_full;
    tile.context = &calls;
    for (int i = 0; i < 5 * TILE_FULL / 2; i++) {
        CHECK(t, tile_add_splat(&tile, 32, 32, rgb_grey(1)), "a splat is left out");
        tile_add(&tile, 0, 0, rgb_black());
    }
    CHECK(t, calls == 2 && tile.n_splats == TILE_FULL / 2, "emptied %d times, %d splats are left", calls,
          (int)tile.n_splats);
    CHECK(t, tile.splat_capacity * sizeof *tile.splat <= 16 << 20, "%d splats of memory", (int)tile.splat_capacity);
    tile_free(&tile);
}

/* A splat of value 1 spread over the film, summed: 1 inside, less at the edges; a box puts it in exactly one pixel. */
static void test_splats(struct test *t)
{
    struct pixel_rect all = {0, 0, 20, 12};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 3, 0);
    for (int i = 0; i < N_FILTERS; i++) {
        struct filter f = filter_of(NAMES[i]);
        struct tile tile = {.sum = NULL};
        double total = 0;
        int pixels;
        for (int k = 0; k < 2000; k++) {
            tile_start(&tile, pixels_all(all), all, &f);
            tile_add_splat(&tile, 6 + 8 * rng_uniform(&r), 5 + 2 * rng_uniform(&r), rgb_grey(1));
            total += spread(&tile, &pixels);
            CHECK(t, f.kind != FILTER_BOX || pixels == 1, "a box splat fell on %d pixels", pixels);
        }
        /* Averaged over positions, the sum over pixels is the filter's integral. */
        CHECK(t, fabs(total / 2000 - 1) < 0.02, "%s: a splat of 1 sums to %g", NAMES[i], total / 2000);
        tile_start(&tile, pixels_all(all), all, &f);
        tile_add_splat(&tile, 20, 5, rgb_grey(1));
        tile_add_splat(&tile, -1e30, 5, rgb_grey(1));
        tile_add_splat(&tile, 1e30, 1e30, rgb_grey(1));
        spread(&tile, &pixels);
        CHECK(t, f.kind != FILTER_BOX || pixels == 0, "a splat beyond the film was kept");
        tile_add_splat(&tile, 5, 5, rgb_grey(NAN));
        CHECK(t, tile.nonfinite == 1, "a NaN splat was not counted");
        tile_free(&tile);
    }
}

/* One of the four tiles of a picture of 8x8 pixels, some iterations. Every iteration brings a pixel 3 by its eye
 * sub-path, and 2 by splats, a quarter of them from each tile. */
static void even_tile(struct tile *tile, int number, int iterations, const struct filter *box)
{
    struct pixel_rect all = {0, 0, 8, 8}, rect = {4 * (number % 2), 4 * (number / 2), 0, 0};
    rect.x1 = rect.x0 + 4;
    rect.y1 = rect.y0 + 4;
    tile_start(tile, pixels_all(rect), all, box);
    for (int i = 0; i < iterations; i++) {
        for (int y = rect.y0; y < rect.y1; y++)
            for (int x = rect.x0; x < rect.x1; x++)
                tile_add(tile, x, y, rgb_grey(3));
        for (int p = 0; p < 64; p++)
            tile_add_splat(tile, p % 8 + 0.5, p / 8 + 0.5, rgb_grey(0.5));
    }
}

/* A film that has so many tiles, one after the other, in blocks of one sample and two in turn. */
static void add_tiles(struct film *film, int tiles)
{
    struct filter box = filter_of("box");
    struct tile tile = {.sum = NULL};
    for (int i = 0; i < tiles; i++) {
        film->block.iterations = 1 + i / 4 % 2;
        even_tile(&tile, i % 4, (int)film->block.iterations, &box);
        film_merge_tile(film, &tile);
        if (i % 4 == 3)
            film_end_block(film);
    }
    tile_free(&tile);
}

/* A picture in the middle of a block: what it has is not too bright where samples are in, nor too dark elsewhere. So it
 * is of several that ended in the middle of one. */
static void test_unfinished(struct test *t)
{
    struct pixel_rect all = {0, 0, 8, 8};
    for (int first = 0; first < 12; first++)
        for (int second = 0; second < 12; second++) {
            struct film film;
            float out[8 * 8 * 3];
            int in = (first > second ? first : second);
            film_init(&film, all, 8, 8);
            add_tiles(&film, first);
            if (second > 0)
                film_settle(&film);
            add_tiles(&film, second);
            film_develop(&film, 2, out);
            for (int i = 0; i < 8 * 8 * 3; i++) {
                int column = i / 3 % 8, row = i / 24, number = row / 4 * 2 + column / 4;
                float expected = number < in ? 2 * 5 : 0;
                CHECK(t, fabsf(out[i] - expected) < 1e-5f, "%d and %d tiles: %g at %d,%d, not %g", first, second,
                      (double)out[i], column, row, (double)expected);
            }
            film_free(&film);
        }
}

/* What no float holds is left out and counted, or cut and counted; a raster point that is no number covers nothing. */
static void test_overflow(struct test *t)
{
    struct pixel_rect all = {0, 0, 4, 4};
    struct filter f = filter_of("gaussian");
    struct tile tile = {.sum = NULL};
    struct film film;
    int pixels_met;
    film_init(&film, all, 4, 4);
    tile_start(&tile, pixels_all(all), all, &f);
    tile_add(&tile, 0, 0, rgb_grey(1e39));
    tile_add(&tile, 1, 0, rgb_grey(NAN));
    tile_add_splat(&tile, 2, 2, rgb_grey(-1e39));
    CHECK(t, tile.nonfinite == 3 && tile.n_splats == 0, "%ld of 3 contributions were left out", tile.nonfinite);
    tile_add_splat(&tile, NAN, 2, rgb_grey(1));
    tile_add_splat(&tile, 2, INFINITY, rgb_grey(1));
    spread(&tile, &pixels_met);
    CHECK(t, pixels_met == 0, "a splat that is nowhere fell on %d pixels", pixels_met);
    tile_add(&tile, 2, 0, rgb_make(3e38, 1, -3e38));
    film_merge_tile(&film, &tile);
    film.iterations = 1;
    float pixels[4 * 4 * 3];
    CHECK(t, film_develop(&film, 1, pixels) == 0 && film.nonfinite == 3, "nothing to cut");
    CHECK(t, film_develop(&film, 10, pixels) == 2, "two values to cut");
    CHECK(t, pixels[6] == FLT_MAX && pixels[7] == 10 && pixels[8] == -FLT_MAX, "cut to %g", (double)pixels[6]);
    tile_free(&tile);
    film_free(&film);
}

/* --- exact sums -------------------------------------------------------------------------------------- */

static bool same_sum(const struct exact_sum *a, const struct exact_sum *b)
{
    return a->top == b->top && memcmp(a->digit, b->digit, sizeof a->digit) == 0;
}

/* Terms of all sizes and signs, the largest anywhere among them: any order and any parts give the same digits, and the
 * value is the sum but for 2^-48 of the largest term each. Sums of doubles, the companion, depend on the order. */
static void test_exact_order(struct test *t)
{
    enum { TERMS = 300, ROUNDS = 200 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 5, 0);
    int moved = 0;
    for (int round = 0; round < ROUNDS; round++) {
        double term[TERMS], plain[2] = {0, 0}, largest = 0, spread = 60.0 * (round % 4);
        long double sum = 0;
        struct exact_sum forward = {{0}, 0}, backward = {{0}, 0}, part[3] = {{{0}, 0}};
        for (int i = 0; i < TERMS; i++) {
            term[i] = ldexp(rng_uniform(&r) - 0.25, (int)(spread * (rng_uniform(&r) - 0.5)));
            largest = fmax(largest, fabs(term[i]));
            sum += (long double)term[i];
            plain[0] += term[i];
            exact_add(&forward, term[i]);
            exact_add(&part[i < 100 ? 0 : i < 110 ? 1 : 2], term[i]);
        }
        for (int i = TERMS - 1; i >= 0; i--) {
            plain[1] += term[i];
            exact_add(&backward, term[i]);
        }
        moved += plain[0] != plain[1];
        CHECK(t, same_sum(&forward, &backward), "round %d: the order of the terms is seen", round);
        CHECK(t, exact_join(&part[2], &part[0]) && exact_join(&part[2], &part[1]) && same_sum(&forward, &part[2]),
              "round %d: parts are not the whole", round);
        double error = fabs((double)((long double)exact_value(&forward) - sum));
        CHECK(t, error <= largest * TERMS * 0x1p-48, "round %d: the sum is wrong by %g of its largest term", round,
              error / largest);
    }
    CHECK(t, moved > ROUNDS / 2, "sums of doubles depend on the order in %d of %d rounds only", moved, ROUNDS);
}

static void test_exact_range(struct test *t)
{
    static const double TERMS[] = {1, -1, 0.1, 3.4028234663852886e38, 1e-30, 1.4e-45, 0x1p-168, 0x1.fffffffffffffp143};
    for (size_t i = 0; i < sizeof TERMS / sizeof TERMS[0]; i++) {
        struct exact_sum s = {{0}, 0};
        exact_add(&s, TERMS[i]);
        CHECK(t, fabs(exact_value(&s) - TERMS[i]) <= fabs(TERMS[i]) * 0x1p-48, "%g alone is %g", TERMS[i],
              exact_value(&s));
    }
    struct exact_sum s = {{0}, 0}, empty = {{0}, 0}, full = {{INT64_MAX, 0, 0}, 7}, before = full;
    exact_add(&s, NAN);
    exact_add(&s, INFINITY);
    exact_add(&s, -0x1p144);
    exact_add(&s, 1e-300);
    CHECK(t, same_sum(&s, &empty) && exact_value(&s) == 0, "what is no term leaves a sum empty");
    exact_add(&s, 1);
    CHECK(t, !exact_join(&full, &s) && same_sum(&full, &before), "an overflow is refused and leaves the sum as it was");
    full.digit[0] = INT64_MIN;
    exact_add(&empty, -1);
    CHECK(t, !exact_join(&full, &empty) && exact_join(&full, &s), "an overflow below is refused");
}

/* A connection that fits no float is left out, and counted; what else the sample has brought stays. */
static void test_one_lost(struct test *t)
{
    static const double BAD[] = {NAN, INFINITY, -INFINITY, 1e200};
    struct pixel_rect one = {0, 0, 1, 1};
    const struct vertex z = {.kind = VERTEX_SURFACE};
    for (int i = 0; i < 8; i++) {
        struct filter box = filter_of("box");
        struct tile tile = {.sum = NULL};
        tile_start(&tile, pixels_all(one), one, &box);
        const struct tile_pass pass = {.tile = &tile};
        struct sample sample = {.pass = &pass, .filter_weight = 1};
        for (int k = 0; k < 3; k++) {
            double x = k == 1 ? BAD[i / 2] : 1;
            struct connection c = {.value = rgb_grey(i % 2 ? 1 : x), .weight = i % 2 ? x : 1};
            sample_add(&sample, (struct joined){.s = 1, .t = 2, .z = &z, .c = &c, .pmf = 1, .scale = 1});
        }
        sample_end(&sample);
        CHECK(t, tile.nonfinite == 1 && exact_value(&tile.sum[0]) == 2, "%g: %ld lost, %g left", BAD[i / 2],
              tile.nonfinite, exact_value(&tile.sum[0]));
        tile_free(&tile);
    }
}

void test_film(struct test *t)
{
    test_one_lost(t);
    test_filters(t);
    test_splats(t);
    test_memory(t);
    test_unfinished(t);
    test_overflow(t);
    test_exact_order(t);
    test_exact_range(t);
}
