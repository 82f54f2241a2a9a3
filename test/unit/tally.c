/* tally.c: see tally.h. */
#include "tally.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "lab/stats.h"

struct tally tally_new(size_t ways, size_t n)
{
    return (struct tally){.n = n, .ways = ways, .stated = mem_alloc(n * ways, sizeof(double)),
                          .counted = mem_alloc(n * ways, sizeof(double)), .collects = true};
}

void tally_free(struct tally *c)
{
    free(c->stated);
    free(c->counted);
}

void tally_note(struct tally *c, size_t thing, double pmf)
{
    size_t i = thing * c->ways, end = i + c->ways;
    while (i < end && c->stated[i] > 0 && fabs(c->stated[i] - pmf) > 1e-9 * pmf)
        i++;
    if (thing >= c->n || i == end || !(pmf > 0))
        c->strange++;
    else if (c->collects)
        c->stated[i] = pmf;
    else
        c->counted[i] += c->stated[i] > 0;
}

double tally_p(const struct tally *c, double draws, double *sum)
{
    size_t n = c->n * c->ways;
    double *expected = mem_alloc(n + 1, sizeof *expected), *observed = mem_alloc(n + 1, sizeof *observed);
    *sum = 0;
    observed[n] = draws;
    for (size_t i = 0; i < n; i++) {
        *sum += c->stated[i];
        expected[i] = draws * c->stated[i];
        observed[i] = c->counted[i];
        observed[n] -= c->counted[i];
    }
    expected[n] = fmax(draws * (1 - *sum), 1e-9);
    double p = stats_chi2_test(observed, expected, n + 1);
    free(expected);
    free(observed);
    return p;
}

void tally_judge(struct test *t, const struct tally *c, double draws, size_t ways, const char *name, const char *what)
{
    int things = 0, several = 0;
    double sum, p = tally_p(c, draws, &sum);
    for (size_t i = 0; i < c->n * c->ways; i++) {
        things += c->stated[i] > 0;
        several += c->stated[i] > 0 && i % c->ways >= ways;
    }
    CHECK(t, c->strange == 0 && several == 0, "%s, %s: %d things and %d draws have several probabilities", name, what,
          several, c->strange);
    CHECK(t, things > 5 && sum < 1 + 1e-9, "%s, %s: stated probabilities of %d things sum to %.9g", name, what, things,
          sum);
    TEST_ACCEPT(t, p, "%s, %s: %d things are drawn as often as stated", name, what, things);
}
