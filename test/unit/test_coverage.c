/* test_coverage.c: do intervals of squared errors against a noisy reference hold the truth as often as they say? On
 * pictures of a known expectation, with noise as rare light makes it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "lab/equal.h"
#include "lab/sides.h"
#include "helpers.h"
#include "suites.h"

enum { W = 64, H = 48, VALUES = 3 * W * H, SPP = 16, BATCHES = 4, TRIALS = 40 };

/* Two methods: a sample has light with this probability, and then the more. */
static const double CHANCE[2] = {0.4, 0.1};

/* From .02 to 1, and every ninth pixel beyond white. */
static double expected(int i) { return i / 3 % 9 == 0 ? 2 : 0.02 * pow(50, (double)(i / 3) / (W * H)); }

static void expect(float mean[VALUES])
{
    for (int i = 0; i < VALUES; i++)
        mean[i] = (float)expected(i);
}

static void draw(struct rng *r, int method, int spp, float *out)
{
    for (int i = 0; i < VALUES; i += 3) {
        int hits = 0;
        for (int k = 0; k < spp; k++)
            hits += rng_uniform(r) < CHANCE[method];
        for (int c = 0; c < 3; c++)
            out[i + c] = (float)(expected(i) * hits / (CHANCE[method] * spp));
    }
}

/* A reference by the second method, of two sides as reference_make has them. */
static bool make_reference(struct test *t, struct rng *r, int spp, struct reference *out)
{
    char name[300];
    float pixels[VALUES];
    struct error err = {.text = ""};
    struct side side[2];
    struct provenance from = {"test", "here", 0, 0, NULL};
    for (int s = 0; s < 2; s++) {
        side[s] = (struct side){"b", W, H, batches_new(BATCHES, VALUES, false)};
        for (int k = 0; k < BATCHES; k++) {
            draw(r, 1, spp, pixels);
            for (int i = 0; i < VALUES; i++)
                side[s].pixels.value[VALUES * k + i] = (double)pixels[i];
        }
    }
    snprintf(name, sizeof name, "%s/drawn", test_tmp(t));
    bool ok = CHECK(t, sides_store(name, &side[0], &side[1], &from, &err), "%s", err.text);
    snprintf(name, sizeof name, "%s/drawn.pfm", test_tmp(t));
    ok = ok && CHECK(t, reference_find(name, "", "drawn", out, &err), "%s", err.text);
    for (int s = 0; s < 2; s++)
        batches_free(&side[s].pixels);
    return ok;
}

/* Mean squared errors of both methods against what is expected. */
static void measure_truth(struct rng *r, double truth[2][N_SQUARES])
{
    enum { MANY = 200 };
    float mean[VALUES], x[VALUES];
    double square[N_SQUARES];
    expect(mean);
    for (int n = 0; n < 2 * MANY; n++) {
        draw(r, n % 2, SPP, x);
        compare_squares(x, mean, mean, W, H, square);
        for (int k = 0; k < N_SQUARES; k++)
            truth[n % 2][k] += square[k] / MANY;
    }
}

/* One measurement of the first method over the second against the reference. */
static void measure_once(struct rng *r, struct scene_results *s)
{
    float x[VALUES];
    for (int v = 0; v < 2; v++)
        for (int i = 0; i < s->plan->n_seeds; i++) {
            struct run *run = &s->run[v][i][0];
            run->spp = SPP;
            draw(r, v, SPP, x);
            compare_squares(x, s->reference.pixels, s->reference.pixels, W, H, run->square);
            for (int k = 0; k < N_SQUARES; k++)
                run->square[k] -= s->reference.noise[k];
        }
}

/* Of measurements against references of so many samples at most one in ten has an interval without the truth, whether
 * or not there are numbers; against clean ones there are. What references say of their own noise is true. */
static void check(struct test *t, int seeds, int reference_spp, bool clean, const double ratio[N_SQUARES])
{
    static const struct price price = {0, 1};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 880, (uint64_t)(100 * reference_spp + seeds));
    struct plan p = {.n_seeds = seeds, .n_scenes = 1, .n_steps = 1, .spp = {SPP}, .equal = true, .reference = "given"};
    struct scene_results *s = mem_alloc(1, sizeof *s);
    int told[N_SQUARES] = {0}, wrong[N_SQUARES] = {0};
    double noise = 0, real = 0, square[N_SQUARES];
    float mean[VALUES];
    p.methods.n = p.n_compared = 2;
    s->plan = &p;
    for (int i = 0; i < 2 * seeds; i++)
        s->price[i % 2][i / 2] = price;
    expect(mean);
    for (int n = 0; n < TRIALS && make_reference(t, &r, reference_spp, &s->reference); n++) {
        measure_once(&r, s);
        compare_squares(s->reference.pixels, mean, mean, W, H, square);
        noise += s->reference.noise[SQUARE_MSE8] / TRIALS;
        real += square[SQUARE_MSE8] / TRIALS;
        for (int k = 0; k < N_SQUARES; k++) {
            struct interval i = equal_ratio(s, 0, 1, (enum square)k);
            told[k] += isfinite(i.value);
            wrong[k] += i.low > ratio[k] || i.high < ratio[k];
        }
        reference_free(&s->reference);
    }
    for (int k = 0; k < N_SQUARES; k++)
        CHECK(t, wrong[k] <= TRIALS / 10 && (!clean || told[k] > TRIALS * 9 / 10), "%d seeds, a reference of %d "
              "samples: %d of %d measurements have %s, %d of them a wrong one", seeds,
              2 * BATCHES * reference_spp, told[k], TRIALS, EQUAL_NAMES[k], wrong[k]);
    CHECK(t, noise > real / 1.4 && noise < real * 1.4, "the reference's squared error is %g, not %g", noise, real);
    free(s);
}

void test_coverage(struct test *t)
{
    double truth[2][N_SQUARES] = {{0}}, ratio[N_SQUARES];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 881, 0);
    measure_truth(&r, truth);
    for (int k = 0; k < N_SQUARES; k++)
        ratio[k] = truth[0][k] / truth[1][k];
    check(t, 2, 2, false, ratio); /* as noisy as what is measured */
    check(t, 5, 2, false, ratio);
    check(t, 2, 40, true, ratio);
    check(t, 5, 40, true, ratio);
}
