/* test_alias.c: alias tables hold exactly the mass they should and draw accordingly.
 *
 * The exact test adds up, over all bins, the share each element has in them and compares with the weights. The
 * statistical ones are then about alias_sample: right counts, and a left-over u that is uniform and tells nothing
 * about the index. Tables with a planted fault must be found out.
 */
#include "base/alias.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/cumulative.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "lab/stats.h"
#include "tests.h"

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

/* p-value of n_draws indices against the weights. */
static double draw_p(const struct alias_table *t, const double *weight, int n, int n_draws, struct rng *r)
{
    double *count = mem_alloc((size_t)n, sizeof *count), *expected = mem_alloc((size_t)n, sizeof *expected),
           sum = 0;
    for (int i = 0; i < n; i++)
        sum += weight[i] / t->total;
    for (int i = 0; i < n; i++)
        expected[i] = n_draws * (weight[i] / t->total / sum);
    for (int i = 0; i < n_draws; i++)
        count[alias_sample(t, uniform52(r), NULL, NULL)]++;
    double p = stats_chi2_test(count, expected, (size_t)n);
    free(count);
    free(expected);
    return p;
}

/* p-value of: what is left of u is uniform, and independent of the index (a table of index x left-over cells). */
static double rest_p(const struct alias_table *t, int n_draws,
                     double (*draw)(const struct alias_table *, double, int *), struct rng *r)
{
    enum { CELLS = 16 };
    size_t size = (size_t)t->n * CELLS;
    double *count = mem_alloc(size, sizeof *count), *expected = mem_alloc(size, sizeof *expected);
    for (int i = 0; i < n_draws; i++) {
        int index;
        double rest = draw(t, uniform52(r), &index);
        count[index * CELLS + (int)(rest * CELLS)]++;
    }
    for (size_t i = 0; i < size; i++)
        expected[i] = n_draws * alias_pmf(t, (int)(i / CELLS)) / CELLS;
    double p = stats_chi2_test(count, expected, size);
    free(count);
    free(expected);
    return p;
}

static double rest_of_sample(const struct alias_table *t, double u, int *index)
{
    double rest;
    *index = alias_sample(t, u, NULL, &rest);
    return rest;
}

/* The fault: u handed on as it came. */
static double rest_unchanged(const struct alias_table *t, double u, int *index)
{
    *index = alias_sample(t, u, NULL, NULL);
    return u;
}

enum shape_of_weights { UNIFORM, SKEWED, SINGLE, HOLES, DENORMAL, VAST, RANDOM, N_SHAPES };
static const char *const SHAPE_NAME[] = {"uniform",       "skewed", "single", "zero-containing",
                                         "near-denormal", "huge",   "random"};

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
            double e = mass_error(&table, w, n);
            CHECK(t, e < 1e-12, "%s, n %d: relative mass error %g", SHAPE_NAME[shape], n, e);
            double p = draw_p(&table, w, n, 50000 * test_effort(t), &r);
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

static void a_million(struct test *t)
{
    enum { N = 1000000 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 3, 0);
    double *w = mem_alloc(N, sizeof *w);
    struct alias_table table = {0};
    /* The rounding errors of all thresholds end up in the last bin: n times that of one number. */
    static const enum shape_of_weights SHAPES[] = {UNIFORM, HOLES, RANDOM};
    for (int k = 0; k < 4; k++) {
        if (k < 3)
            make_weights(SHAPES[k], w, N, &r);
        else
            w[77] = 2e6; /* one element that fills most bins */
        alias_build(&table, w, N);
        double e = mass_error(&table, w, N);
        CHECK(t, e < N * DBL_EPSILON, "a million weights, case %d: relative mass error %g", k, e);
    }
    /* Too many cells for their counts: compare blocks of a thousand elements. */
    double count[1000] = {0}, expected[1000] = {0};
    w[77] = 0.5;
    alias_build(&table, w, N);
    for (int i = 0; i < N; i++)
        expected[i / 1000] += N * alias_pmf(&table, i);
    for (int i = 0; i < N; i++)
        count[alias_sample(&table, uniform52(&r), NULL, NULL) / 1000]++;
    TEST_ACCEPT(t, stats_chi2_test(count, expected, 1000), "a million weights, blocks of a thousand");
    free(w);
    alias_free(&table);
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

/* Visiting every bin once: the expected number of visits of i is n q_i, whatever the permutation. */
static void one_visit_per_bin(struct test *t)
{
    enum { N = 40, ROUNDS = 2000 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 4, 0);
    double w[N], sum[N] = {0}, square[N] = {0};
    struct alias_table table = {0};
    make_weights(SKEWED, w, N, &r);
    alias_build(&table, w, N);
    for (int round = 0; round < ROUNDS; round++) {
        double visits[N] = {0};
        for (int bin = 0; bin < N; bin++) {
            double pmf;
            int i = alias_sample_bin(&table, bin, rng_uniform(&r), &pmf, NULL);
            CHECK(t, pmf == alias_pmf(&table, i), "pmf of a bin's element");
            visits[i]++;
        }
        for (int i = 0; i < N; i++) {
            sum[i] += visits[i];
            square[i] += visits[i] * visits[i];
        }
    }
    for (int fault = 0; fault < 2; fault++) {
        double z2 = 0;
        int dof = 0;
        for (int i = 0; i < N; i++) {
            double mean = sum[i] / ROUNDS, var = square[i] / ROUNDS - mean * mean;
            double expected = N * alias_pmf(&table, fault ? (i + 1) % N : i);
            if (mean > 5.0 / ROUNDS && var > 0) {
                z2 += (mean - expected) * (mean - expected) / (var / ROUNDS);
                dof++;
            } else if (var == 0) {
                CHECK(t, fault || fabs(mean - expected) < 0.01, "element %d: %g visits of %g", i, mean, expected);
            }
        }
        if (fault == 0)
            TEST_ACCEPT(t, stats_chi2_p(z2, dof), "visits of stratified bins");
        else
            TEST_REJECT(t, stats_chi2_p(z2, dof), "visits of stratified bins, probabilities shifted by one");
    }
    alias_free(&table);
}

static void what_is_left_of_u(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 5, 0);
    double w[12];
    struct alias_table table = {0};
    for (int shape = 0; shape < N_SHAPES; shape++) {
        make_weights((enum shape_of_weights)shape, w, 12, &r);
        w[3] += shape == HOLES;
        alias_build(&table, w, 12);
        double p = rest_p(&table, 60000 * test_effort(t), rest_of_sample, &r);
        TEST_ACCEPT(t, p, "left-over u, %s", SHAPE_NAME[shape]);
    }
    TEST_REJECT(t, rest_p(&table, 60000, rest_unchanged, &r), "u handed on unchanged");
    alias_free(&table);
}

/* Tables spoilt in the ways such code goes wrong. */
static void planted_faults(struct test *t)
{
    enum { N = 12, DRAWS = 60000 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 6, 0);
    double w[N];
    struct alias_table table = {0};
    for (int fault = 0; fault < 4; fault++) {
        for (int i = 0; i < N; i++)
            w[i] = 1 + i;
        alias_build(&table, w, N);
        const char *name = "";
        switch (fault) {
        case 0:
            name = "alias of a bin set to the bin itself";
            table.bin[0].alias = 0;
            break;
        case 1:
            name = "own and alias exchanged";
            for (int i = 0; i < N; i++)
                table.bin[i].threshold = 1 - table.bin[i].threshold;
            break;
        case 2:
            name = "a leftover without threshold";
            for (int i = 0; i < N; i++)
                if (table.bin[i].threshold == 1) {
                    table.bin[i].threshold = 0;
                    table.bin[i].alias = 0;
                }
            break;
        case 3:
            name = "last threshold not normalised";
            table.bin[0].threshold *= N;
            break;
        }
        CHECK(t, mass_error(&table, w, N) > 1e-3, "mass test: %s", name);
        TEST_REJECT(t, draw_p(&table, w, N, DRAWS, &r), "draws: %s", name);
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
    a_million(t);
    what_is_refused(t);
    ends_of_u(t);
    one_visit_per_bin(t);
    what_is_left_of_u(t);
    planted_faults(t);
}
