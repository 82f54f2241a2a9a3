/* test.h: the frame of the test suite.
 *
 * A suite is a function test_NAME(struct test *t) of this folder; suites.awk finds it. It calls CHECK for facts that
 * must hold exactly, and reports p-values of statistical hypotheses with TEST_ACCEPT (the hypothesis is true) or
 * TEST_REJECT (it is planted to be false, the companion that must fail). Seeds are fixed, so a fault that shows once
 * shows always; each p is judged by itself, however many others there are:
 *
 *     planted to be false     p must be below 1e-4
 *     true                    p of 1e-4 or more passes, one below 1e-7 fails; one between them is doubtful
 *
 * A test with doubtful hypotheses, and no failures, is called again with another seed and an effort of 10: it takes ten
 * times the samples (or as many others, if what it expects of them is no more exact). What the doubtful ones come to
 * then counts alone; all of them together are judged at 0.001, shared by Sidak's formula. So n true hypotheses fail in
 * fewer than n (1e-4 * 0.001 + 1e-7) of all seeds. NaN always fails.
 */
#ifndef ASBDPT_TEST_H
#define ASBDPT_TEST_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

struct test; /* running state */

struct test_entry {
    const char *name;
    void (*run)(struct test *t);
    bool slow; /* only with --slow or by name */
    const char *what; /* it tests */
};

struct test_setting {
    uint64_t seed;
    bool once;  /* what is doubtful fails */
    bool first; /* with once: the program ends at the first failure, with status 1 */
    bool show;  /* every p is printed */
    uint64_t first_scene, end_scene; /* of random scenes; both 0: each test's own */
    const char *tmp;                 /* a directory for temporary files; no trailing slash */
    FILE *out;                       /* where failures are written, and in the last line "N passed, N failed" */
};

/* test_run: run n tests; returns how many failed. */
int test_run(const struct test_entry *entry, int n, const struct test_setting *setting);

bool test_check(struct test *t, const char *file, int line, bool ok, const char *format, ...);
void test_hypothesis(struct test *t, const char *file, int line, bool must_hold, double p, const char *format, ...);

/* The suite's seed: fixed by default, changed with `build/test --seed N` to measure the false-alarm rate. */
uint64_t test_seed(const struct test *t);

/* Which random scenes the user wants, [first, end). False if he has not said; both stay as they are then. */
bool test_range(const struct test *t, uint64_t *first, uint64_t *end);
/* What the number of samples is to be multiplied by: 1, or 10 when doubtful hypotheses are tested again. */
int test_effort(const struct test *t);

/* A directory for temporary files, removed at the end; no trailing slash. */
const char *test_tmp(const struct test *t);

/* CHECK(t, condition, format, ...): a fact. Continues after a failure; returns the condition. */
#define CHECK(t, ...) test_check((t), __FILE__, __LINE__, __VA_ARGS__)
/* TEST_ACCEPT(t, p, format, ...): a true hypothesis; fails when p is too small. */
#define TEST_ACCEPT(t, ...) test_hypothesis((t), __FILE__, __LINE__, true, __VA_ARGS__)
/* TEST_REJECT(t, p, format, ...): a planted falsehood; fails when p is NOT small. */
#define TEST_REJECT(t, ...) test_hypothesis((t), __FILE__, __LINE__, false, __VA_ARGS__)

#endif
