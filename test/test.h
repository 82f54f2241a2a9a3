/* test.h: the frame of the test suite.
 *
 * A test is a function in the table of test/main.c. It calls CHECK for facts that must hold exactly, and reports
 * p-values of statistical hypotheses with TEST_ACCEPT (the hypothesis is true) or TEST_REJECT (it is planted to be
 * false, the companion that must fail). p-values are judged when all selected tests have run: the whole suite has
 * one significance level, 0.001, shared among its hypotheses by Sidak's formula.
 */
#ifndef ASBDPT_TEST_H
#define ASBDPT_TEST_H

#include <stdbool.h>
#include <stdint.h>

struct test; /* running state, owned by the runner */

bool test_check(struct test *t, const char *file, int line, bool ok, const char *format, ...);
void test_hypothesis(struct test *t, const char *file, int line, bool must_hold, double p, const char *format, ...);

/* The suite's seed: fixed by default, changed with `build/test --seed N` to measure the false-alarm rate. */
uint64_t test_seed(const struct test *t);

/* Which random scenes the user wants, [first, end). False if he has not said; both stay as they are then. */
bool test_range(const struct test *t, uint64_t *first, uint64_t *end);

/* A directory for temporary files, removed at the end; no trailing slash. */
const char *test_tmp(const struct test *t);

/* CHECK(t, condition, format, ...): a fact. Continues after a failure; returns the condition. */
#define CHECK(t, ...) test_check((t), __FILE__, __LINE__, __VA_ARGS__)
/* TEST_ACCEPT(t, p, format, ...): a true hypothesis; fails when p is too small. */
#define TEST_ACCEPT(t, ...) test_hypothesis((t), __FILE__, __LINE__, true, __VA_ARGS__)
/* TEST_REJECT(t, p, format, ...): a planted falsehood; fails when p is NOT small. */
#define TEST_REJECT(t, ...) test_hypothesis((t), __FILE__, __LINE__, false, __VA_ARGS__)

#endif
