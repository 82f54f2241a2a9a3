/* mark.c: see mark.h. */
#include "lab/mark.h"

#include <math.h>
#include <stdlib.h>

#include "base/maths.h"
#include "lab/plan.h"
#include "lab/sheet.h"
#include "lab/stats.h"

const char *const MARKS[N_MARKS] = {"", "misses light", "biased"};

/* Sums over blocks: of differences, of their squares, of the variance that is expected of these, and its degrees of
 * freedom by the squares of its terms. */
struct sums {
    double d, square, variance, terms, uncertain;
};

static void add_block(struct sums *s, double weight, double d, double own, double reference, int n)
{
    s->d += d;
    s->square += weight * d * d;
    s->variance += weight * (own + reference);
    s->terms += sqr(weight * (own + reference));
    s->uncertain += sqr(weight * own) / (n - 1);
}

/* Of the variance that is expected. */
static double freedom(const struct sums *s) { return sqr(s->variance) / (s->uncertain + 1e-6 * s->terms); }

/* The sum of a block's three channels. */
static double grey(const float *block) { return (double)block[0] + (double)block[1] + (double)block[2]; }

struct mark_tests mark_tests(float *const *picture, int n, const struct reference *r)
{
    int k = compare_block(r->width, r->height), count = (r->width / k) * (r->height / k);
    float *mean = sheet_shrink(r->pixels, r->width, r->height, k);
    float *noise = sheet_shrink(r->variance, r->width, r->height, k), *x[PLAN_MAX_SEEDS];
    struct sums blocks = {0}, whole = {0};
    for (int i = 0; i < n; i++)
        x[i] = sheet_shrink(picture[i], r->width, r->height, k);
    for (int b = 0; b < 3 * count; b += 3) {
        double sum = 0, square = 0, reference = grey(mean + b), u = 3 * grey(noise + b) / (k * k);
        for (int i = 0; i < n; i++)
            sum += grey(x[i] + b) / n;
        for (int i = 0; i < n; i++)
            square += sqr(grey(x[i] + b) - sum) / (n - 1);
        add_block(&blocks, 1 / (sqr(reference / 3) + 0.01), sum - reference, square / n, u, n);
        add_block(&whole, 1, sum - reference, square / n, u, n);
    }
    for (int i = 0; i < n; i++)
        free(x[i]);
    free(mean);
    free(noise);
    struct mark_tests out = {1, 1, 0};
    if (blocks.variance == 0 && blocks.square == 0)
        return out;
    out.t = whole.d / sqrt(whole.variance);
    out.mean = stats_student_p(out.t, freedom(&whole));
    out.blocks =
        stats_fisher_p(blocks.square / blocks.variance, sqr(blocks.variance) / blocks.terms, freedom(&blocks));
    return out;
}

enum mark mark_of(struct mark_tests found, int methods)
{
    double level = stats_sidak(MARK_LEVEL, 1.0 / (2.0 * methods));
    if (found.blocks >= level && found.mean >= level)
        return MARK_NONE;
    return found.t < -2 ? MARK_DARK : MARK_BIASED;
}
