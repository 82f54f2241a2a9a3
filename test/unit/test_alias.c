/* test_alias.c: an alias table holds exactly the mass of every element, and its draws have these probabilities.
 *
 * The exact test adds up, over all bins, the share each element has in them and compares with the weights. The
 * statistical ones are then about alias_sample: right counts. What it leaves of u makes points of maps, whose densities
 * test_light_sent.c has.
 */
#include "base/alias.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/rng.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "suites.h"

/* 52 random bits: with the 32 of rng_uniform a table of a million bins would leave 12 for the choice within. */
static double uniform52(struct rng *r)
{
    double high = rng_u32(r) >> 6, low = rng_u32(r) >> 6;
    return (high * 67108864 + low) / 4503599627370496.0;
}

/* The largest error of an element's mass, relative to the larger of its own mass and 1/n. */
static double mass_error(const struct alias_table *t, const double *weight, int n)
{
    double *mass = mem_alloc((size_t)n, sizeof *mass), largest = 0, sum = 0, worst = 0;
    for (int i = 0; i < n; i++) {
        mass[i] += t->bin[i].threshold / n;
        mass[t->bin[i].alias] += (1 - t->bin[i].threshold) / n;
        largest = fmax(largest, weight[i]);
    }
    long double total = 0;
    for (int i = 0; i < n; i++)
        total += weight[i] / largest;
    for (int i = 0; i < n; i++) {
        double q = weight[i] / largest / (double)total;
        worst = most_of(worst, fabs(mass[i] - q) / fmax(q, 1.0 / n));
        worst = most_of(worst, fabs(alias_pmf(t, i) - q) / fmax(q, 1.0 / n));
        if (weight[i] == 0 && (mass[i] != 0 || alias_pmf(t, i) != 0))
            worst = 1;
        sum += alias_pmf(t, i);
    }
    free(mass);
    return most_of(worst, fabs(sum - 1) / n);
}

/* Bins that say of their other element what is not so: its probability; that it is their own, or none, while they are
 * not full, or that they are more than full. */
static int wrong_bins(const struct alias_table *t, bool probability)
{
    int wrong = 0;
    for (int i = 0; i < t->n; i++) {
        const struct alias_bin *b = &t->bin[i];
        bool other = b->alias < (uint32_t)t->n && b->alias != (uint32_t)i;
        if (!(b->threshold >= 0 && b->threshold <= 1))
            wrong += !probability;
        else if (b->threshold < 1)
            wrong += probability ? other && b->alias_pmf != alias_pmf(t, (int)b->alias) : !other;
    }
    return wrong;
}

/* p-value of n_draws indices against the table's probabilities; NaN if a draw tells another one. */
static double draw_p(const struct alias_table *t, int n, int n_draws, struct rng *r)
{
    double *count = mem_alloc((size_t)n, sizeof *count), *expected = mem_alloc((size_t)n, sizeof *expected), pmf;
    bool told = true;
    for (int i = 0; i < n; i++)
        expected[i] = n_draws * alias_pmf(t, i);
    for (int k = 0; k < n_draws; k++) {
        int i = alias_sample(t, uniform52(r), &pmf, NULL);
        told = told && pmf == alias_pmf(t, i);
        count[i]++;
    }
    double p = told ? stats_chi2_test(count, expected, (size_t)n) : NAN;
    free(count);
    free(expected);
    return p;
}

enum shape_of_weights { UNIFORM, SKEWED, SINGLE, HOLES, DENORMAL, VAST, NEARLY, RANDOM, N_SHAPES };
static const char *const SHAPE_NAME[] = {"uniform",       "skewed", "single", "zero-containing",
                                         "near-denormal", "huge",   "nearly uniform", "random"};

static void make_weights(enum shape_of_weights shape, double *w, int n, struct rng *r)
{
    for (int i = 0; i < n; i++) {
        double u = rng_uniform(r);
        switch (shape) {
        case UNIFORM: w[i] = 0.1; break;
        case SKEWED: w[i] = exp(-0.3 * (i % 60)); break;
        case SINGLE: w[i] = i == n / 2 ? 7e-9 : 0; break;
        case HOLES: w[i] = rng_below(r, 2) ? 1 + u : 0; break;
        case DENORMAL: w[i] = 4.9406564584124654e-324 * (1 + rng_below(r, 5)); break;
        case VAST: w[i] = 1e300 * (1 + u); break;
        case NEARLY: w[i] = 1 + 1e-7 * u; break;
        case RANDOM: w[i] = u * u; break;
        case N_SHAPES: break;
        }
    }
}

static void every_shape(struct test *t)
{
    static const int SIZES[] = {1, 2, 3, 7, 64, 1000};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 2, 0);
    struct alias_table table = {0};
    double w[1000];
    for (int shape = 0; shape < N_SHAPES; shape++)
        for (int s = 0; s < 6; s++) {
            int n = SIZES[s];
            make_weights((enum shape_of_weights)shape, w, n, &r);
            w[n - 1] += shape == HOLES; /* not all of them zero */
            if (!CHECK(t, alias_build(&table, w, n), "%s, n %d: builds", SHAPE_NAME[shape], n))
                continue;
            int alone = wrong_bins(&table, false), told = wrong_bins(&table, true);
            CHECK(t, alone == 0, "%s, n %d: %d bins have a threshold above 1, or one below and no other item as alias",
                  SHAPE_NAME[shape], n, alone);
            CHECK(t, told == 0, "%s, n %d: %d bins have an alias_pmf that is not their alias' probability",
                  SHAPE_NAME[shape], n, told);
            if (alone > 0)
                continue;
            double e = mass_error(&table, w, n);
            CHECK(t, e < 1e-12, "%s, n %d: relative mass error %g", SHAPE_NAME[shape], n, e);
            double p = draw_p(&table, n, 20000 * test_effort(t), &r);
            int choices = 0;
            for (int i = 0; i < n; i++)
                choices += w[i] > 0;
            if (choices > 1)
                TEST_ACCEPT(t, p, "draws, %s, n %d", SHAPE_NAME[shape], n);
            else
                CHECK(t, p != 0, "draws, %s, n %d: one that cannot be", SHAPE_NAME[shape], n);
        }
    alias_free(&table);
}

/* A wrong threshold is found out by both tests. */
static void planted_fault(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 6, 0);
    double w[12];
    struct alias_table table = {0};
    make_weights(UNIFORM, w, 12, &r);
    w[3] = 0.5;
    alias_build(&table, w, 12);
    table.bin[0].threshold *= 0.6;
    CHECK(t, mass_error(&table, w, 12) > 1e-3, "mass test of a wrong table");
    TEST_REJECT(t, draw_p(&table, 12, 60000, &r), "draws of a wrong table");
    alias_free(&table);
}

static void a_million(struct test *t)
{
    enum { N = 1000000 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 3, 0);
    double *w = mem_alloc(N, sizeof *w);
    struct alias_table table = {0};
    /* The rounding errors of all thresholds end up in the last bin: n times that of one number. */
    static const enum shape_of_weights SHAPES[] = {UNIFORM, HOLES, RANDOM, RANDOM};
    for (int k = 0; k < 4; k++) {
        make_weights(SHAPES[k], w, N, &r);
        w[77] = k == 3 ? 2e6 : w[77]; /* one element that fills most bins */
        alias_build(&table, w, N);
        double e = mass_error(&table, w, N);
        CHECK(t, e < N * DBL_EPSILON, "a million weights, case %d: relative mass error %g", k, e);
    }
    free(w);
    alias_free(&table);
}

/* CPU seconds, the least of five times, that a table of n weights takes. */
static double seconds_of(int n, const double *w)
{
    struct alias_table table = {0};
    double least = INFINITY;
    for (int k = 0; k < 5; k++) {
        double start = os_cpu_seconds();
        alias_build(&table, w, n);
        least = fmin(least, os_cpu_seconds() - start);
    }
    alias_free(&table);
    return least;
}

/* In proportion to n; a tenth of a millisecond is too short to be measured. */
void test_growth_long(struct test *t)
{
    enum { FEW = 4000, MANY = 8 * FEW };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 7, 0);
    double *w = mem_alloc(MANY, sizeof *w);
    make_weights(RANDOM, w, MANY, &r);
    double few = seconds_of(FEW, w), many = seconds_of(MANY, w);
    free(w);
    CHECK(t, many < 24 * fmax(few, 1e-4), "slow: a table of %d items takes %g ms, one of %d takes %g ms, %.0f "
          "times that, not 8 times", FEW, 1e3 * few, MANY, 1e3 * many, many / few);
}

static void what_is_refused(struct test *t)
{
    struct alias_table table = {0};
    double zero[3] = {0, 0, 0}, negative[3] = {1, -1e-9, 1}, nan[2] = {1, NAN}, inf[2] = {INFINITY, 1},
           one[1] = {3};
    CHECK(t, !alias_build(&table, zero, 3) && table.n == 0, "no mass");
    CHECK(t, alias_pmf(&table, 0) == 0, "an empty table has no probabilities");
    CHECK(t, alias_build(&table, one, 1) && table.n == 1 && table.total == 3, "one element");
    CHECK(t, !alias_build(&table, negative, 3) && table.n == 0, "a negative weight");
    CHECK(t, !alias_build(&table, nan, 2) && !alias_build(&table, inf, 2), "weights that are no numbers");
    CHECK(t, !alias_build(&table, zero, 0), "no elements");
    alias_free(&table);
    alias_free(&table); /* twice is harmless */
}

/* The ends of the interval, at which rounding could step outside the table or return u = 1. */
static void ends_of_u(struct test *t)
{
    double w[49];
    struct alias_table table = {0};
    for (int i = 0; i < 49; i++)
        w[i] = i % 5;
    alias_build(&table, w, 49);
    const double last = 1 - 1.0 / 9007199254740992.0;
    for (int i = 0; i <= 49; i++) {
        double u[3] = {i / 49.0, nextafter(i / 49.0, 0), nextafter(i / 49.0, 1)};
        for (int k = 0; k < 3; k++) {
            double pmf, rest;
            int index = alias_sample(&table, fmin(u[k], last), &pmf, &rest);
            CHECK(t, index >= 0 && index < 49 && w[index] > 0 && pmf > 0 && rest >= 0 && rest < 1,
                  "u = %.17g: index %d, pmf %g, rest %.17g", u[k], index, pmf, rest);
        }
    }
    alias_free(&table);
}

/* The last sum that is not above the target, also where it is met exactly and where elements of weight 0 stand. */
static void cumulative_sums(struct test *t)
{
    static const double before[] = {0, 0, 1, 1, 1, 2.5, 4, 4};
    for (int n = 1; n <= 8; n++)
        for (double target = -0.5; target <= 5; target += 0.5) {
            int last = 0;
            for (int i = 0; i < n; i++)
                last = before[i] <= target ? i : last;
            CHECK(t, cumulative_find(before, n, target) == last, "of %d sums %d is drawn at %g, not %d", n,
                  cumulative_find(before, n, target), target, last);
        }
}

void test_alias(struct test *t)
{
    cumulative_sums(t);
    every_shape(t);
    planted_fault(t);
    a_million(t);
    what_is_refused(t);
    ends_of_u(t);
}
