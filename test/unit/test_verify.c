/* test_verify.c: `verify` accepts equal methods, rejects different ones, and its p-values are uniform. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/rng.h"
#include "lab/sheet.h"
#include "image/image.h"
#include "lab/compare.h"
#include "lab/stats.h"
#include "helpers.h"
#include "suites.h"

/* Batches of uniform noise around 1, the noise of neighbouring values shared to the degree `share`. */
static struct batches noise(struct rng *r, int n_batches, long n, double share, double shift)
{
    struct batches s = batches_new(n_batches, n, false);
    for (int k = 0; k < n_batches; k++) {
        double common = 0;
        for (long i = 0; i < n; i++) {
            if (i % 12 == 0)
                common = rng_uniform(r) - 0.5;
            s.value[n * k + i] = 1 + shift + share * common + (1 - share) * (rng_uniform(r) - 0.5);
        }
    }
    return s;
}

/* Many comparisons of equal batches: each of the three p-values must be uniform or, by Sidak's bound, too large. */
static void test_level(struct test *t, double share)
{
    enum { TRIALS = 200, BATCHES = 10, VALUES = 20 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 801, 0);
    double mean[TRIALS], uniform[TRIALS], low_smallest = 0, low_uniform = 0;
    for (int i = 0; i < TRIALS; i++) {
        struct batches a = noise(&r, BATCHES, VALUES, share, 0), b = noise(&r, BATCHES, VALUES, share, 0);
        struct verdict v = verify_batches(&a, &b, (uint64_t)i);
        mean[i] = v.mean;
        uniform[i] = v.uniform;
        low_smallest += v.smallest < 0.1;
        low_uniform += v.uniform < 0.1;
        batches_free(&a);
        batches_free(&b);
    }
    TEST_ACCEPT(t, stats_ks_uniform_p(mean, TRIALS), "p-values of equal means, noise shared by %g", share);
    /* The share of p-values below 0.1 may not exceed 0.1. */
    double z_smallest = (low_smallest / TRIALS - 0.1) / sqrt(0.09 / TRIALS);
    double z_uniform = (low_uniform / TRIALS - 0.1) / sqrt(0.09 / TRIALS);
    TEST_ACCEPT(t, z_smallest > 0 ? stats_normal_p(z_smallest) : 1, "%g of the smallest p-values are below 0.1",
                low_smallest / TRIALS);
    TEST_ACCEPT(t, z_uniform > 0 ? stats_normal_p(z_uniform) : 1, "%g of the uniformity's p-values are below 0.1",
                low_uniform / TRIALS);
    if (share == 0)
        TEST_ACCEPT(t, stats_ks_uniform_p(uniform, TRIALS), "p-values of uniformity itself, independent noise");
}

/* The bars that are shown are of the p-values that are tested. A tile near each has ten times its noise, so these are
 * larger than even ones, and as many as expected; those of different expectations are not. */
static void test_bars(struct test *t)
{
    enum { TRIALS = 50, BATCHES = 10, SIDE = 4, VALUES = 3 * SIDE * SIDE };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 809, 0);
    double bar[2][VERIFY_BARS] = {{0}}, expected[2][VERIFY_BARS] = {{0}}, even[VERIFY_BARS];
    for (int i = 0; i < 2 * TRIALS; i++) {
        struct batches side[2];
        for (int j = 0; j < 2; j++) {
            side[j] = noise(&r, BATCHES, VALUES, 0, 0);
            side[j].across = SIDE;
            for (long k = 0; k < BATCHES * VALUES; k++)
                side[j].value[k] = side[j].value[k] * (k % VALUES / 3 % 5 == 0 ? 10 : 1) + (i % 2 == 1 ? j : 0);
        }
        struct verdict v = verify_batches(&side[0], &side[1], (uint64_t)i);
        for (int k = 0; k < VERIFY_BARS; k++) {
            bar[i % 2][k] += v.bar[k];
            expected[i % 2][k] += v.expected[k];
        }
        batches_free(&side[0]);
        batches_free(&side[1]);
    }
    for (int k = 0; k < VERIFY_BARS; k++)
        even[k] = (double)TRIALS * VALUES / VERIFY_BARS;
    TEST_ACCEPT(t, stats_chi2_test(bar[0], expected[0], VERIFY_BARS), "the bars that are shown");
    TEST_REJECT(t, stats_chi2_test(bar[0], even, VERIFY_BARS), "bars of p-values that allow for rare samples: even");
    TEST_REJECT(t, stats_chi2_test(bar[1], expected[1], VERIFY_BARS), "bars of means that differ");
}

/* A shift of one value, of all values a little, and of a spread of values up and down: each of the three sees one. */
static void test_power(struct test *t)
{
    enum { BATCHES = 16, VALUES = 120 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 802, 0);
    for (int kind = 0; kind < 3; kind++) {
        struct batches a = noise(&r, BATCHES, VALUES, 0, 0), b = noise(&r, BATCHES, VALUES, 0, kind == 1 ? 0.15 : 0);
        for (int k = 0; k < BATCHES; k++)
            for (long i = 0; i < VALUES; i++) {
                if (kind == 0 && i == 77)
                    b.value[VALUES * k + i] += 1.5;
                if (kind == 2)
                    b.value[VALUES * k + i] += i % 2 == 0 ? 0.25 : -0.25;
            }
        struct verdict v = verify_batches(&a, &b, 1);
        static const char *const what[] = {"one value", "all values", "values up and down"};
        TEST_REJECT(t, v.p, "%s shifted", what[kind]);
        TEST_REJECT(t, kind == 0 ? v.smallest : kind == 1 ? v.mean : v.uniform, "%s shifted, the test made for it",
                    what[kind]);
        CHECK(t, kind != 0 || v.where == 77, "the worst value is %ld, not 77", v.where);
        batches_free(&a);
        batches_free(&b);
    }
}

enum { RARE_SIDE = 8, RARE_BATCHES = 12, RARE_PIXELS = 16 * RARE_SIDE * RARE_SIDE };

/* Batches of 32x32 pixels, a tile being 4x4, darker to the right. From left to right a pixel's light comes, with
 * growing share, as rare samples: of mean size 1 over `chance`, in that share of pixels. Beyond the middle there is
 * only that.
 *   scale  of one tile of the left half */
static struct batches rare(struct rng *r, int n_batches, double chance, double scale)
{
    struct batches b = batches_new(n_batches, 3L * RARE_PIXELS, false);
    for (int k = 0; k < n_batches; k++)
        for (int i = 0; i < RARE_PIXELS; i++) {
            int x = i % (4 * RARE_SIDE), y = i / (4 * RARE_SIDE);
            double share = fmin(1, x / (2.0 * RARE_SIDE)), light = pow(0.6, x / 2.0);
            double v = (1 - share) * (0.9 + 0.2 * rng_uniform(r)) +
                       (rng_uniform(r) < chance ? share / chance : 0) * rng_uniform(r) * 2;
            if (x / 4 == 1 && y / 4 == 4)
                v *= scale;
            for (int c = 0; c < 3; c++)
                b.value[b.n * k + 3 * i + c] = light * v;
        }
    struct batches tiles = batches_tiles(&b, 4 * RARE_SIDE, 4 * RARE_SIDE, 4);
    batches_free(&b);
    return tiles;
}

/* Two sides of one expectation, of which one has rare samples, half of a sample in a tile at least: one in a hundred
 * may DIFFER at the level .001, where Welch's test alone has a quarter of them. With twice the batches a tile that is
 * half as bright again, or black, is found. */
static void test_rare(struct test *t)
{
    enum { TRIALS = 80, FAULTS = 10 };
    static const double chance[4] = {0.1, 0.03, 0.01, 0.003};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 804, 0);
    int differ = 0, welch = 0, found[2] = {0, 0};
    for (int i = 0; i < TRIALS; i++) {
        struct batches a = rare(&r, RARE_BATCHES, 0.5, 1), b = rare(&r, RARE_BATCHES, chance[i % 4], 1);
        differ += verify_batches(&a, &b, (uint64_t)i).p < 0.001;
        welch += batches_smallest_p(&a, &b) < 0.001;
        batches_free(&b);
        batches_free(&a);
    }
    for (int i = 0; i < FAULTS; i++) {
        struct batches a = rare(&r, 2 * RARE_BATCHES, 0.5, 1);
        for (int kind = 0; kind < 2; kind++) {
            struct batches b = rare(&r, 2 * RARE_BATCHES, 0.5, kind == 0 ? 1.5 : 0);
            found[kind] += verify_batches(&a, &b, (uint64_t)i).p < 0.001;
            batches_free(&b);
        }
        batches_free(&a);
    }
    CHECK(t, differ <= 1 && welch > TRIALS / 4, "equal but for rare samples: %d of %d DIFFER, %d by Welch's test alone",
          differ, TRIALS, welch);
    CHECK(t, found[0] == FAULTS && found[1] == FAULTS, "of %d faults %d and %d are found", FAULTS, found[0], found[1]);
}

/* A picture with its standard errors against batches. */
static void test_errors(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 803, 0);
    struct batches a = noise(&r, 16, 300, 0, 0), b = batches_new(1, 300, true);
    for (int far = 0; far < 2; far++) {
        for (long i = 0; i < b.n; i++) {
            double u = 0;
            for (int k = 0; k < 12; k++) /* nearly normal, variance 1 */
                u += rng_uniform(&r) - 0.5;
            b.error[i] = 0.05;
            b.value[i] = 1 + 0.05 * u * (far ? 4 : 1); /* four times the error it claims */
        }
        double p = verify_batches(&a, &b, 2).p;
        if (far)
            TEST_REJECT(t, p, "batches against a picture that understates its errors");
        else
            TEST_ACCEPT(t, p, "batches against a picture with standard errors");
    }
    batches_free(&a);
    batches_free(&b);
}

/* A single NaN on one side, or the same on both, is a difference; so is an infinity, and so is nothing at all. What is
 * exact and equal agrees, but has shown nothing to those who ask for a test. */
static void test_no_numbers(struct test *t)
{
    enum { VALUES = 12 };
    for (int with_error = 0; with_error < 2; with_error++)
        for (int kind = 0; kind < 6; kind++) { /* a NaN here, there, on both sides; in the errors; an infinity; none */
            struct batches a = batches_new(with_error ? 1 : 4, VALUES, with_error), b;
            for (long i = 0; i < VALUES * a.n_batches; i++)
                a.value[i] = 1 + (with_error ? 0 : 0.01 * (double)(i % 5));
            b = batches_tiles(&a, 2, 2, 1);
            if (kind == 0 || kind == 2)
                a.value[7] = NAN;
            if (kind == 1 || kind == 2)
                b.value[7] = NAN;
            if (kind == 3 && with_error)
                a.error[7] = NAN;
            if (kind == 4)
                a.value[7] = b.value[7] = INFINITY;
            double p = verify_batches(&a, &b, 1).p, smallest = batches_smallest_p(&a, &b);
            bool agrees = kind == 5 || (kind == 3 && !with_error);
            CHECK(t, agrees ? p >= 0.001 : !(p >= 0.001), "verdict %d, kind %d: p is %g", with_error, kind, p);
            CHECK(t, agrees && !with_error ? smallest >= 0.001 : !(smallest >= 0.001 || smallest < 0.001),
                  "smallest %d, kind %d: p is %g", with_error, kind, smallest);
            batches_free(&a);
            batches_free(&b);
        }
    struct batches none = batches_new(4, 0, false);
    CHECK(t, !(verify_batches(&none, &none, 1).p >= 0.001), "nothing agrees with nothing");
    batches_free(&none);
}

static void test_tiles(struct test *t)
{
    struct batches s = batches_new(1, 5 * 3 * 3, true);
    for (long i = 0; i < s.n; i++) {
        s.value[i] = (double)(i / 3 % 5) + 10 * (double)(i % 3);
        s.error[i] = 2;
    }
    struct batches tiles = batches_tiles(&s, 5, 3, 2);
    CHECK(t, tiles.n == 3 * 2 * 3, "5x3 pixels make %ld values of 2x2 tiles", tiles.n);
    CHECK(t, fabs(tiles.value[3 * 1 + 2] - 22.5) < 1e-12, "mean of a tile is %g", tiles.value[5]);
    CHECK(t, fabs(tiles.value[3 * 2] - 4) < 1e-12, "mean of a cut tile is %g", tiles.value[6]);
    CHECK(t, fabs(tiles.error[0] - 1) < 1e-12, "error of the mean of 4 values of error 2 is %g", tiles.error[0]);
    double error;
    CHECK(t, fabs(batches_mean(&s, &error) - 12) < 1e-12, "mean of everything");
    CHECK(t, fabs(error - 3 * sqrt(15 * 4.0) / 45) < 1e-12, "error of the mean, dependent channels: %g", error);
    batches_free(&s);
    batches_free(&tiles);
}

/* What is stored is the mean of both sides, each weighted by the other's variance, with its standard error; one side a
 * picture whose errors are known. */
static void test_store(struct test *t)
{
    char name[256], path[280];
    struct error err = {.text = ""};
    struct side a = {"a", 2, 1, batches_new(2, 6, false)}, b = {"b", 2, 1, batches_new(1, 6, true)}, stored = {0};
    for (int i = 0; i < 6; i++) {
        a.pixels.value[i] = 1 + i; /* 1 + i +- 1: the mean's variance is 1 */
        a.pixels.value[6 + i] = 3 + i;
        b.pixels.value[i] = 6 + i;
        b.pixels.error[i] = 2;
    }
    struct verdict v = verify_batches(&a.pixels, &b.pixels, 1);
    struct provenance from = {"a note", "a scene", 77, 5, &v};
    snprintf(name, sizeof name, "%s/stored", test_tmp(t));
    snprintf(path, sizeof path, "%s.pfm", name);
    bool ok = CHECK(t, sides_store(name, &a, &b, &from, &err), "%s", err.text) &&
              read_reference(t, path, &stored);
    for (int i = 0; ok && i < 6; i++) /* weights 4/5 and 1/5 */
        CHECK(t, fabs(stored.pixels.value[i] - 2.8 - i) < 1e-6 && fabs(stored.pixels.error[i] - sqrt(0.8)) < 1e-6,
              "value %d is stored as %g +- %g", i, stored.pixels.value[i], stored.pixels.error[i]);
    batches_free(&stored.pixels);
    for (int i = 0; i < 6; i++) { /* no noise on either side */
        a.pixels.value[i] = a.pixels.value[6 + i] = b.pixels.value[i] = i;
        b.pixels.error[i] = 0;
    }
    ok = CHECK(t, sides_store(name, &a, &b, &from, &err), "%s", err.text) &&
         read_reference(t, path, &stored);
    for (int i = 0; ok && i < 6; i++)
        CHECK(t, stored.pixels.value[i] == i && stored.pixels.error[i] == 0, "value %d without noise is stored as %g",
              i, stored.pixels.value[i]);
    batches_free(&a.pixels);
    batches_free(&b.pixels);
    batches_free(&stored.pixels);
}

/* The figures of `compare` for differences chosen by hand. */
static void test_compare(struct test *t)
{
    const float r[4] = {0, 1, 0.5f, 0.25f}, x[4] = {0, 1, 0.75f, 0.5f};
    struct difference d = compare_pixels(x, r, 4);
    double e8[2] = {srgb_byte(0.75) - srgb_byte(0.5), srgb_byte(0.5) - srgb_byte(0.25)};
    CHECK(t, fabs(d.rmse - sqrt(2 * 0.0625 / 4)) < 1e-12, "rmse is %g", d.rmse);
    CHECK(t, fabs(d.rmse8 - sqrt((e8[0] * e8[0] + e8[1] * e8[1]) / 4)) < 1e-12, "rmse8 is %g", d.rmse8);
    CHECK(t, fabs(d.relmse - (0.0625 / 0.26 + 0.0625 / 0.0725) / 4) < 1e-12, "relmse is %g", d.relmse);
    CHECK(t, fabs(d.mean_ratio - 2.25 / 1.75) < 1e-12, "mean_ratio is %g", d.mean_ratio);
    const float broken[2] = {NAN, 1}, whole[2] = {1, 1};
    d = compare_pixels(broken, whole, 2);
    CHECK(t, d.nonfinite == 1 && d.rmse == 0, "a NaN is counted %ld times and changes rmse to %g", d.nonfinite, d.rmse);
    CHECK(t, isinf(d.psnr) && d.psnr > 0, "psnr of equal values is %g", d.psnr);
    d = compare_pixels(broken, whole, 1);
    CHECK(t, isinf(d.rmse) && isinf(d.rmse8) && isinf(d.relmse) && d.psnr < 0, "nothing to compare: rmse %g", d.rmse);
    CHECK(t, isnan(d.mean_ratio), "nothing to compare: the ratio of the means is %g", d.mean_ratio);
    const float black = 0, white = 1;
    d = compare_pixels(&black, &white, 1);
    CHECK(t, d.rmse8 == 255 && d.psnr == 0, "psnr of black for white is %g", d.psnr);
    const float hundred[100] = {0}, one_off[100] = {1}; /* rmse8 is 255 / 10 */
    d = compare_pixels(one_off, hundred, 100);
    CHECK(t, fabs(d.psnr - 20) < 1e-12, "psnr of one in a hundred is %g", d.psnr);
}

/* The relative squared error of means over blocks. */
static double error_of_blocks(const float *x, const float *r, int width, int height)
{
    double square[N_SQUARES];
    compare_squares(x, r, r, width, height, square);
    return square[SQUARE_BLOCKS];
}

/* Of two errors of the same size the one that alternates is no error of means over blocks, the one that does not is. */
static void test_blocks(struct test *t)
{
    enum { W = 19, H = 10, N = 3 * W * H };
    float r[N], noise[N], shared[N];
    for (int i = 0; i < N; i++) {
        r[i] = 1;
        noise[i] = (i / 3 / W + i / 3 % W) % 2 == 0 ? 1.5f : 0.5f;
        shared[i] = i / 3 / W < 8 && i / 3 % W < 16 ? 1.5f : 9; /* beyond the last whole block nothing counts */
    }
    double none = error_of_blocks(noise, r, W, H), all = error_of_blocks(shared, r, W, H);
    CHECK(t, none < 1e-12 && fabs(all - 0.25 / 1.01) < 1e-6, "errors of blocks: %g and %g", none, all);
    CHECK(t, fabs(error_of_blocks(noise, r, 1, 5) - 0.25 / 1.01) < 1e-6, "of one column: blocks of a pixel");
}

/* Errors of pixels, what percentile they have, and their colours. */
static void test_heatmap(struct test *t)
{
    enum { N = 101 };
    float x[3 * N] = {0}, r[3 * N] = {0}, error[N], map[3 * N], stop[3];
    for (int i = 0; i < N; i++)
        x[3 * i + 1] = (float)(i * sqrt(3)); /* the error of pixel i is i */
    compare_errors(x, r, N, error);
    for (int i = 0; i < N; i++)
        CHECK(t, fabs((double)error[i] - i) < 1e-4, "error of pixel %d is %g", i, (double)error[i]);
    for (int percent = 1; percent <= 100; percent += 9) {
        double p = picture_percentile(error, N, percent); /* N errors 0, 1 ... : rank ceil(1.01 percent) */
        CHECK(t, fabs(p - (ceil(1.01 * percent) - 1)) < 1e-4, "percentile %d is %g", percent, p);
    }
    for (int percent = 1; percent <= 100; percent++) {
        double p = picture_percentile(error, 100, percent);
        CHECK(t, fabs(p - (percent - 1)) < 1e-4, "percentile %d of a hundred errors 0, 1 ... 99 is %g", percent, p);
    }
    compare_heatmap(error, N, 50, map);
    for (int i = 0; i < N; i += 25) {
        viridis(i / 50.0, stop);
        for (int c = 0; c < 3; c++)
            CHECK(t, fabs((double)map[3 * i + c] - (double)stop[c]) < 1e-5, "colour of pixel %d", i);
    }
    x[3 * 100] = NAN; /* is shown as the largest, and does not set the scale */
    compare_errors(x, r, N, error);
    double largest = picture_percentile(error, N, 100);
    CHECK(t, isinf((double)error[100]) && fabs(largest - 99) < 1e-4, "largest: %g, for NaN %g", largest,
          (double)error[100]);
    compare_heatmap(error, N, 98, map);
    CHECK(t, memcmp(&map[300], &map[297], 3 * sizeof *map) == 0, "a NaN has not the brightest colour");
    compare_heatmap(error, 1, 0, map);
    viridis(0, stop);
    CHECK(t, memcmp(map, stop, sizeof stop) == 0, "without any error all is dark");
    CHECK(t, picture_percentile(error + 100, 1, 99) == 0, "percentile where nothing is finite");
}

void test_verify(struct test *t)
{
    test_tiles(t);
    test_store(t);
    test_compare(t);
    test_blocks(t);
    test_heatmap(t);
    test_level(t, 0);
    test_level(t, 0.5);
    test_bars(t);
    test_power(t);
    test_rare(t);
    test_errors(t);
    test_no_numbers(t);
}
