/* test_frame.c: the judgement of p-values (test.h), with tests that report planted ones. */
#include <math.h>

#include "suites.h"


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
