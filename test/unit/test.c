/* test.c: runs tests and judges what they report; see test.h. */
#include "test.h"

#include <stdarg.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"
#include "helpers.h"
#include "lab/stats.h"

static const double LEVEL = 1e-4, BEYOND_DOUBT = 1e-7, SECOND_LEVEL = 0.001;
enum { EFFORT = 10 };

struct hypothesis {
    double p;
    bool must_hold;
    char text[256];
};

struct test {
    const char *name;
    struct test_setting set;
    int effort;
    long checks, failures;         /* of this test; failures of hypotheses count when it is judged */
    struct hypothesis *hypothesis; /* [n] */
    size_t n, capacity;
};

static bool doubtful(const struct hypothesis *h) { return h->must_hold && h->p < LEVEL && h->p >= BEYOND_DOUBT; }

static void fail(struct test *t, const struct hypothesis *h, const char *must_be, double level)
{
    t->failures++;
    const char *planted = h->must_hold ? "" : ": a fault that the test has planted, and must notice, is not noticed";
    fprintf(t->set.out, "  FAIL %s\n       p = %.3g, must be %s %.3g%s\n", h->text, h->p, must_be, level, planted);
    fprintf(t->set.out, "       repeat with: build/test --seed %llu %s\n", (unsigned long long)t->set.seed, t->name);
}

/* Fails what is certain already; NaN is neither small nor large enough. Is it doubtful? */
static bool judge_one(struct test *t, const struct hypothesis *h)
{
    if (doubtful(h) && !t->set.once)
        return true;
    if (h->must_hold && !(h->p >= LEVEL))
        fail(t, h, ">=", LEVEL);
    else if (!h->must_hold && !(h->p < LEVEL))
        fail(t, h, "<", LEVEL);
    return false;
}

static void end_at_first(const struct test *t)
{
    if (!t->set.first || t->failures == 0)
        return;
    fprintf(t->set.out, "ended at the first failure\n");
    remove_tree(t->set.tmp);
    exit(1);
}

bool test_check(struct test *t, const char *file, int line, bool ok, const char *format, ...)
{
    t->checks++;
    if (ok)
        return true;
    t->failures++;
    va_list args;
    va_start(args, format);
    fprintf(t->set.out, "  FAIL %s:%d: ", file, line);
    vfprintf(t->set.out, format, args);
    fprintf(t->set.out, "\n       repeat with: build/test --seed %llu %s\n", (unsigned long long)t->set.seed, t->name);
    va_end(args);
    fflush(t->set.out); /* before a crash that may come of it */
    end_at_first(t);
    return false;
}

void test_hypothesis(struct test *t, const char *file, int line, bool must_hold, double p, const char *format, ...)
{
    t->hypothesis = mem_grow(t->hypothesis, &t->capacity, t->n + 1, sizeof *t->hypothesis);
    struct hypothesis *h = &t->hypothesis[t->n++];
    h->p = p;
    h->must_hold = must_hold;
    int used = snprintf(h->text, sizeof h->text, "%s:%d: ", file, line);
    va_list args;
    va_start(args, format);
    if (used > 0 && (size_t)used < sizeof h->text)
        vsnprintf(h->text + used, sizeof h->text - (size_t)used, format, args);
    va_end(args);
    if (t->set.show)
        fprintf(t->set.out, "  p = %.3g, %s: %s\n", p, must_hold ? "true" : "planted", h->text);
    if (t->set.first) {
        judge_one(t, h);
        end_at_first(t);
    }
}

/* Another seed for the second time, that no --seed of a few digits is. */
uint64_t test_seed(const struct test *t) { return t->set.seed + (t->effort > 1 ? 1u << 30 : 0); }
int test_effort(const struct test *t) { return t->effort; }
const char *test_tmp(const struct test *t) { return t->set.tmp; }

bool test_range(const struct test *t, uint64_t *first, uint64_t *end)
{
    if (t->set.end_scene <= t->set.first_scene)
        return false;
    *first = t->set.first_scene;
    *end = t->set.end_scene;
    return true;
}

/* Returns the number of doubtful hypotheses. */
static size_t judge(struct test *t)
{
    size_t doubts = 0;
    for (size_t i = 0; i < t->n; i++)
        if (judge_one(t, &t->hypothesis[i])) {
            doubts++;
            fprintf(t->set.out, "  doubtful: %s: p = %.3g\n", t->hypothesis[i].text, t->hypothesis[i].p);
        }
    return doubts;
}

/* The second time, of which only the hypotheses that were doubtful in `first` count. */
static void judge_again(struct test *t, const struct test *first, double level)
{
    if (!CHECK(t, t->n == first->n, "%lu hypotheses the first time, %lu the second", (unsigned long)first->n,
               (unsigned long)t->n))
        return;
    for (size_t i = 0; i < t->n; i++)
        if (doubtful(&first->hypothesis[i])) {
            fprintf(t->set.out, "  %s: p = %.3g, and %.3g of ten times the samples\n", t->hypothesis[i].text,
                    first->hypothesis[i].p, t->hypothesis[i].p);
            if (!(t->hypothesis[i].p >= level))
                fail(t, &t->hypothesis[i], ">=", level);
        }
}

static void run(const struct test_entry *e, struct test *t)
{
    double start = os_wall_seconds();
    e->run(t);
    fprintf(t->set.out, "%-10s %6.2f s%s\n", e->name, os_wall_seconds() - start,
            t->effort > 1 ? " for ten times the samples" : "");
    fflush(t->set.out);
}

int test_run(const struct test_entry *entry, int n, const struct test_setting *setting)
{
    struct test *tests = mem_alloc((size_t)n, sizeof *tests);
    size_t *doubts = mem_alloc((size_t)n, sizeof *doubts), all_doubts = 0, hypotheses = 0;
    for (int i = 0; i < n; i++) {
        struct test fresh = {.name = entry[i].name, .set = *setting, .effort = 1};
        tests[i] = fresh;
        run(&entry[i], &tests[i]);
        doubts[i] = judge(&tests[i]);
        if (tests[i].failures == 0)
            all_doubts += doubts[i];
        hypotheses += tests[i].n;
    }
    double level = all_doubts > 0 ? stats_sidak(SECOND_LEVEL, 1 / (double)all_doubts) : SECOND_LEVEL;
    long checks = 0;
    int failed = 0;
    for (int i = 0; i < n; i++) {
        if (tests[i].failures == 0 && doubts[i] > 0) {
            struct test again = {.name = entry[i].name, .set = *setting, .effort = EFFORT};
            run(&entry[i], &again);
            judge_again(&again, &tests[i], level);
            tests[i].failures = again.failures;
            free(again.hypothesis);
        }
        failed += tests[i].failures != 0;
        checks += tests[i].checks;
        free(tests[i].hypothesis);
    }
    fprintf(setting->out, "%ld checks, %lu hypotheses, of which %lu were tested again\n%d passed, %d failed\n", checks,
            (unsigned long)hypotheses, (unsigned long)all_doubts, n - failed, failed);
    free(doubts);
    free(tests);
    return failed;
}
