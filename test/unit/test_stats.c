/* test_stats.c: the functions of statistics against published tables and closed forms. Tables: critical values of
 * chi-square, Student's t and Kolmogorov-Smirnov as printed in any statistics book [Abramowitz & Stegun 1964] [Massey
 * 1951]. */
#include <math.h>

#include "base/number.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "suites.h"

static bool near(double a, double b, double relative) { return fabs(a - b) <= relative * fabs(b); }

static void special_functions(struct test *t)
{
    for (double x = 0.01; x < 200; x *= 1.7) {
        CHECK(t, near(stats_gamma_q(1, x), exp(-x), 1e-12), "Q(1,%g) = %.15g", x, stats_gamma_q(1, x));
        CHECK(t, near(stats_gamma_q(0.5, x), erfc(sqrt(x)), 1e-11), "Q(1/2,%g) = %.15g", x, stats_gamma_q(0.5, x));
        CHECK(t, near(stats_gamma_q(3, x), exp(-x) * (1 + x + x * x / 2), 1e-11), "Q(3,%g)", x);
    }
    CHECK(t, stats_gamma_q(2, 0) == 1 && stats_gamma_q(2, INFINITY) == 0, "ends of Q");
    for (double x = 0.05; x < 1; x += 0.1) {
        CHECK(t, near(stats_beta_i(1, 1, x), x, 1e-13), "I_%g(1,1)", x);
        CHECK(t, near(stats_beta_i(2, 3, x), x * x * (6 - 8 * x + 3 * x * x), 1e-12), "I_%g(2,3)", x);
        CHECK(t, near(stats_beta_i(0.5, 0.5, x), 2 / acos(-1.0) * asin(sqrt(x)), 1e-12), "I_%g(1/2,1/2)", x);
        CHECK(t, near(stats_beta_i(7, 40, x), 1 - stats_beta_i(40, 7, 1 - x), 1e-9), "I_%g(7,40): symmetry", x);
    }
}

static void published_tables(struct test *t)
{
    static const struct {
        double p, dof, x;
    } CHI2[] = {
        {0.05, 1, 3.841459},  {0.01, 1, 6.634897},   {0.05, 10, 18.30704},   {0.001, 10, 29.58830},
        {0.95, 10, 3.940299}, {0.05, 100, 124.3421}, {0.001, 100, 149.4493}, {0.005, 50, 79.48998},
    };
    for (size_t i = 0; i < sizeof CHI2 / sizeof CHI2[0]; i++)
        CHECK(t, near(stats_chi2_p(CHI2[i].x, CHI2[i].dof), CHI2[i].p, 1e-5), "chi-square %g, dof %g: %.8g",
              CHI2[i].x, CHI2[i].dof, stats_chi2_p(CHI2[i].x, CHI2[i].dof));
    static const struct {
        double p, dof, x;
    } STUDENT[] = {
        {0.05, 1, 12.7062},   {0.05, 10, 2.228139},  {0.01, 10, 3.169273},
        {0.001, 5, 6.868827}, {0.05, 120, 1.979930}, {0.1, 30, 1.697261},
    };
    for (size_t i = 0; i < sizeof STUDENT / sizeof STUDENT[0]; i++)
        CHECK(t, near(stats_student_p(STUDENT[i].x, STUDENT[i].dof), STUDENT[i].p, 1e-5), "t %g, dof %g: %.8g",
              STUDENT[i].x, STUDENT[i].dof, stats_student_p(STUDENT[i].x, STUDENT[i].dof));
    CHECK(t, near(stats_fisher_p(3.708265, 3, 10), 0.05, 1e-5) && near(stats_fisher_p(4.102685, 5, 20), 0.01, 1e-5) &&
          near(stats_fisher_p(sqr(2.228139), 1, 10), 0.05, 1e-5) && stats_fisher_p(INFINITY, 3, 10) == 0, "Fisher");
    CHECK(t, near(stats_normal_p(1.959963985), 0.05, 1e-8), "normal 1.96");
    CHECK(t, near(stats_normal_p(-3.290526731), 0.001, 1e-8), "normal -3.29");
    CHECK(t, near(stats_student_p(1.96, 1e9), stats_normal_p(1.96), 1e-6), "t tends to the normal");
    /* Far out: a million degrees of freedom, close to a normal deviate of 3 (Wilson & Hilferty). */
    double n = 1e6, w = 1 - 2 / (9 * n) + 3 * sqrt(2 / (9 * n));
    CHECK(t, near(stats_chi2_p(n * w * w * w, n), 0.5 * stats_normal_p(3), 1e-3), "chi-square, 10^6 dof: %g",
          stats_chi2_p(n * w * w * w, n));
}

static void tests_of_hypotheses(struct test *t)
{
    /* Mendel's peas [Mendel 1866]: 315 108 101 32 against 9:3:3:1, chi-square 0.470, p = 0.925. */
    double peas[4] = {315, 108, 101, 32}, ratio[4] = {9, 3, 3, 1};
    for (int i = 0; i < 4; i++)
        ratio[i] *= 556.0 / 16;
    double p = stats_chi2_test(peas, ratio, 4);
    CHECK(t, fabs(p - 0.9254) < 1e-4, "Mendel's peas: %g", p);
    double three[3] = {10, 0, 1}, expect[3] = {10, 1, 0};
    CHECK(t, stats_chi2_test(three, expect, 3) == 0, "a count where none can be");
    double few[3] = {1, 2, 1}, small[3] = {2, 1, 1};
    CHECK(t, isnan(stats_chi2_test(few, small, 3)), "too few counts to say anything");
    double pool[4] = {20, 3, 2, 1}, cells[4] = {20, 2, 2, 2}; /* three small cells become one of 6 */
    CHECK(t, near(stats_chi2_test(pool, cells, 4), 1, 1e-12), "pooling hides the small cells' differences");

    p = stats_welch_p(20.8, 7.9, 15, 23.0, 3.8, 15);
    CHECK(t, fabs(p - 0.020) < 0.002, "Welch, equal counts: %g", p);
    CHECK(t, near(stats_welch_p(3, 4, 50, 4, 4, 50), stats_student_p(2.5, 98), 1e-12), "Welch, equal variances");
    CHECK(t, near(stats_welch_p(3e-150, 4e-300, 50, 4e-150, 4e-300, 50), stats_student_p(2.5, 98), 1e-12),
          "Welch, tiny variances");
    CHECK(t, stats_welch_p(1, 0, 5, 1, 0, 5) == 1 && stats_welch_p(1, 0, 5, 2, 0, 5) == 0, "no variance");

    /* Critical values of D at 0.05: n = 10: 0.40925, n = 20: 0.29408, n = 50: 0.18845; 0.01: n = 20: 0.35241. */
    static const struct {
        double d, p;
        int n;
    } KS[] = {{0.40925, 0.05, 10}, {0.29408, 0.05, 20}, {0.18845, 0.05, 50}, {0.35241, 0.01, 20}};
    for (size_t k = 0; k < 4; k++) {
        double x[50];
        for (int i = 0; i < KS[k].n; i++) /* all numbers at or above their rank, the largest distance being d */
            x[i] = fmin(1, (double)i / KS[k].n + KS[k].d);
        p = stats_ks_uniform_p(x, (size_t)KS[k].n);
        CHECK(t, near(p, KS[k].p, 0.02), "Kolmogorov-Smirnov, n %d, D %g: %g", KS[k].n, KS[k].d, p);
    }
    CHECK(t, near(stats_sidak(0.05, 0.5), 1 - sqrt(0.95), 1e-12), "Sidak of two");
    CHECK(t, near(stats_sidak(0.001, 1e-6), 1.0005e-9, 1e-4), "Sidak of a million keeps its digits");
}

/* A NaN agrees with nothing and differs from nothing, and no more does an empty set. */
static void no_numbers(struct test *t)
{
    double one[3] = {10, NAN, 10}, two[3] = {10, 10, 10}, stray[3] = {10, 10, NAN}, none[3] = {10, 10, 0};
    CHECK(t, isnan(stats_normal_p(NAN)) && isnan(stats_chi2_p(NAN, 3)), "one-sided and two");
    CHECK(t, isnan(stats_student_p(NAN, 5)) && isnan(stats_student_p(2, NAN)), "Student");
    CHECK(t, isnan(stats_chi2_test(one, two, 3)) && isnan(stats_chi2_test(two, one, 3)), "chi-square");
    CHECK(t, isnan(stats_chi2_test(stray, none, 3)) && isnan(stats_chi2_test(two, two, 0)), "chi-square of nothing");
    for (int variance = 0; variance < 2; variance++)
        CHECK(t, isnan(stats_welch_p(NAN, variance, 5, 1, variance, 5)) &&
                     isnan(stats_welch_p(INFINITY, variance, 5, INFINITY, variance, 5)) &&
                     isnan(stats_welch_p(1, NAN, 5, 1, variance, 5)), "Welch, variance %d", variance);
    for (int place = 0; place < 3; place++) {
        double x[3] = {0.2, 0.5, 0.8};
        x[place] = NAN;
        CHECK(t, isnan(stats_ks_distance(x, 3)) && isnan(stats_ks_uniform_p(x, 3)), "Kolmogorov-Smirnov, %d", place);
    }
    CHECK(t, isnan(stats_ks_uniform_p(one, 0)) && isnan(stats_kolmogorov_p(NAN)) && isnan(stats_sidak(NAN, 3)), "none");
    CHECK(t, isnan(least_of(NAN, 1)) && isnan(least_of(1, NAN)) && least_of(1, 2) == 1 && least_of(2, 1) == 1, "least");
    CHECK(t, isnan(most_of(NAN, 1)) && isnan(most_of(1, NAN)) && most_of(1, 2) == 2 && most_of(2, 1) == 2, "most");
}

void test_stats(struct test *t)
{
    special_functions(t);
    published_tables(t);
    tests_of_hypotheses(t);
    no_numbers(t);
}

/* --- the suite frame ------------------------------------------------------------------------------------------ */

static void report(struct test *t, bool must_hold, double first, double second)
{
    test_hypothesis(t, "planted", 1, must_hold, test_effort(t) == 1 ? first : second, "p");
}

static void fair(struct test *t)
{
    for (int i = 0; i < 2000; i++) /* their number does not matter */
        TEST_ACCEPT(t, 1e-4 + i, "p");
    TEST_REJECT(t, 0.99e-4, "p");
}

static void unlucky(struct test *t) { report(t, true, 0.9e-4, 0.002); }
static void faint(struct test *t) { report(t, true, 1e-6, 0.0009); }
static void certain(struct test *t) { report(t, true, 0.9e-7, 0.5); }
static void not_found(struct test *t) { report(t, false, 1.1e-4, 0); }
static void nan_at_first(struct test *t) { report(t, true, NAN, 0.5); }
static void nan_again(struct test *t) { report(t, true, 1e-5, NAN); }
static void nan_not_found(struct test *t) { report(t, false, NAN, 0); }
static void wrong_fact(struct test *t) { CHECK(t, false, "planted"); }

static void wrong_fact_again(struct test *t)
{
    report(t, true, 1e-5, 0.5);
    CHECK(t, test_effort(t) == 1, "planted");
}

/* 0.0006 is not too small for one of two. */
static void two(struct test *t)
{
    report(t, true, 1e-5, 0.0006);
    report(t, true, 1e-5, 0.7);
}

/* What was not doubtful is not judged again. */
static void beside(struct test *t)
{
    report(t, true, 1e-5, 0.5);
    report(t, true, 0.5, 1e-5);
    report(t, false, 1e-5, 0.5);
}

static void one_is_missing(struct test *t)
{
    report(t, true, 1e-5, 0.5);
    if (test_effort(t) == 1)
        TEST_ACCEPT(t, 0.5, "p");
}

static void same_seed(struct test *t)
{
    static uint64_t seed;
    CHECK(t, test_effort(t) == 1 || test_seed(t) != seed, "planted");
    seed = test_seed(t);
    report(t, true, 1e-5, 0.5);
}

/* frame: the judgement of p-values (test.h), with tests that report planted ones. */
void test_frame(struct test *t)
{
    static const struct {
        struct test_entry entry;
        bool passes;
    } cases[] = {
        {{"fair", fair, false, ""}, true},
        {{"unlucky", unlucky, false, ""}, true},
        {{"faint", faint, false, ""}, false},
        {{"certain", certain, false, ""}, false},
        {{"not found", not_found, false, ""}, false},
        {{"NaN at first", nan_at_first, false, ""}, false},
        {{"NaN again", nan_again, false, ""}, false},
        {{"NaN not found", nan_not_found, false, ""}, false},
        {{"wrong fact", wrong_fact, false, ""}, false},
        {{"wrong fact again", wrong_fact_again, false, ""}, false},
        {{"two", two, false, ""}, true},
        {{"beside", beside, false, ""}, true},
        {{"one is missing", one_is_missing, false, ""}, false},
        {{"same seed", same_seed, false, ""}, true},
    };
    enum { N = sizeof cases / sizeof cases[0] };
    struct test_entry all[N];
    int wrong = 0;
    char path[400];
    snprintf(path, sizeof path, "%s/said", test_tmp(t));
    FILE *out = fopen(path, "w");
    if (!CHECK(t, out != NULL, "no temporary file"))
        return;
    const struct test_setting setting = {.seed = test_seed(t), .tmp = test_tmp(t), .out = out};
    for (int i = 0; i < N; i++) {
        all[i] = cases[i].entry;
        wrong += !cases[i].passes;
        int failed = test_run(&all[i], 1, &setting);
        CHECK(t, failed == !cases[i].passes, "%s: %d failed", all[i].name, failed);
    }
    wrong--; /* what is faint alone is not among so many */
    CHECK(t, test_run(all, N, &setting) == wrong, "all together: not %d of them failed", wrong);
    fclose(out);
}
