/* test_sampler.c: the low-discrepancy part of a stream: exactly one point per stratum, uniform and independent over
 * pixels; the rest: plain random numbers. */
#include <string.h>

#include "base/sampler.h"
#include "base/stats.h"
#include "tests.h"

enum { N = 64 };

/* The first N iterations of a pair put one point into every elementary interval of area 1/N: 64x1, 32x2, ..., 1x64. */
static bool is_net(uint64_t seed, uint64_t pixel, int pair, bool planted)
{
    for (int columns = 1; columns <= N; columns *= 2) {
        int rows = N / columns, count[N];
        memset(count, 0, sizeof count);
        for (int i = 0; i < N; i++) {
            struct sampler s = sampler_start(seed, RNG_EYE, pixel, (uint64_t)(planted ? i * 3 : i));
            for (int skip = 0; skip < 2 * pair; skip++)
                sampler_next(&s);
            double x = sampler_next(&s), y = sampler_next(&s);
            count[(int)(x * columns) * rows + (int)(y * rows)]++;
        }
        for (int i = 0; i < N; i++)
            if (count[i] != 1)
                return false;
    }
    return true;
}

/* Cells of (number a, number b) over many pixels at one iteration. */
static double joint_p(uint64_t seed, int a, int b, uint64_t iteration)
{
    enum { SIDE = 8, PIXELS = 40000 };
    double observed[SIDE * SIDE] = {0}, expected[SIDE * SIDE];
    for (int i = 0; i < PIXELS; i++) {
        struct sampler s = sampler_start(seed, RNG_LIGHT, (uint64_t)i, iteration);
        double u[12];
        for (int k = 0; k < 12; k++)
            u[k] = sampler_next(&s);
        observed[(int)(u[a] * SIDE) * SIDE + (int)(u[b] * SIDE)]++;
    }
    for (int i = 0; i < SIDE * SIDE; i++)
        expected[i] = (double)PIXELS / (SIDE * SIDE);
    return stats_chi2_test(observed, expected, SIDE * SIDE);
}

void test_sampler(struct test *t)
{
    uint64_t seed = test_seed(t);
    for (uint64_t pixel = 0; pixel < 20; pixel++)
        for (int pair = 0; pair < SAMPLER_DIMENSIONS / 2; pair++)
            CHECK(t, is_net(seed, pixel, pair, false), "pixel %d, pair %d: not one point per stratum",
                  (int)pixel, pair);
    CHECK(t, !is_net(seed, 1, 0, true), "a sequence with holes passes for a net");
    for (int a = 0; a < 8; a++)
        for (int b = a + 1; b < 8; b++)
            TEST_ACCEPT(t, joint_p(seed, a, b, 5), "numbers %d and %d over pixels", a, b);
    TEST_REJECT(t, joint_p(seed, 3, 3, 5), "a number against itself");
}
