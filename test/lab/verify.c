/* verify.c: see verify.h. */
#include "lab/verify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "base/vec.h"
#include "lab/numbers.h"
#include "lab/stats.h"

enum {
    RESAMPLINGS = 299,
    MANY = 1000 /* instead of the number of batches of a picture whose error is known */
};

struct batches batches_new(int n_batches, long n, bool with_error)
{
    struct batches b = {n_batches, n, NULL, NULL};
    b.value = mem_alloc((size_t)n * (size_t)n_batches, sizeof *b.value);
    if (with_error)
        b.error = mem_alloc((size_t)n, sizeof *b.error);
    return b;
}

void batches_free(struct batches *b)
{
    free(b->value);
    free(b->error);
    memset(b, 0, sizeof *b);
}

/* Average one batch over one tile; with `squares` the values are errors, which add up by their squares. */
static double tile_value(const double *pixel, int width, int x0, int y0, int x1, int y1, int c, bool squares)
{
    double sum = 0, count = (double)(x1 - x0) * (y1 - y0);
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) {
            double v = pixel[3 * ((long)y * width + x) + c];
            sum += squares ? v * v : v;
        }
    return squares ? sqrt(sum) / count : sum / count;
}

struct batches batches_tiles(const struct batches *b, int width, int height, int side)
{
    long across = (width + side - 1) / side, down = (height + side - 1) / side;
    struct batches out = batches_new(b->n_batches, 3 * across * down, b->error != NULL);
    for (long i = 0; i < out.n; i++) {
        int c = (int)(i % 3), x0 = (int)(i / 3 % across) * side, y0 = (int)(i / 3 / across) * side;
        int x1 = x0 + side < width ? x0 + side : width, y1 = y0 + side < height ? y0 + side : height;
        for (int k = 0; k < b->n_batches; k++)
            out.value[out.n * k + i] = tile_value(b->value + b->n * k, width, x0, y0, x1, y1, c, false);
        if (b->error != NULL)
            out.error[i] = tile_value(b->error, width, x0, y0, x1, y1, c, true);
    }
    return out;
}

/* --- one hypothesis ---------------------------------------------------------------------------------- */

struct moments batches_moments(const struct batches *b, long i)
{
    struct moments m = {0, 0, b->n_batches};
    for (int k = 0; k < b->n_batches; k++)
        m.mean += b->value[b->n * k + i] / b->n_batches;
    for (int k = 0; k < b->n_batches; k++) {
        double d = b->value[b->n * k + i] - m.mean;
        m.variance += b->n_batches > 1 ? d * d / (b->n_batches - 1) : 0;
    }
    if (b->error != NULL) {
        m.n = MANY;
        m.variance = b->error[i] * b->error[i] * MANY;
    }
    return m;
}

/* Of the mean of all values. Errors of pixels are independent, those of a pixel's channels are not: they add up. */
static struct moments total_moments(const struct batches *b)
{
    struct batches total = batches_new(b->n_batches, 1, b->error != NULL);
    for (int k = 0; k < b->n_batches; k++)
        for (long i = 0; i < b->n; i++)
            total.value[k] += b->value[b->n * k + i] / (double)b->n;
    if (b->error != NULL) {
        double sum[3] = {0, 0, 0};
        for (long i = 0; i < b->n; i++)
            sum[i % 3] += b->error[i] * b->error[i];
        total.error[0] = (sqrt(sum[0]) + sqrt(sum[1]) + sqrt(sum[2])) / (double)b->n;
    }
    struct moments m = batches_moments(&total, 0);
    batches_free(&total);
    return m;
}

static double welch(struct moments a, struct moments b)
{
    return stats_welch_p(a.mean, a.variance, a.n, b.mean, b.variance, b.n);
}

double batches_mean(const struct batches *b, double *error)
{
    struct moments m = total_moments(b);
    if (error != NULL)
        *error = sqrt(m.variance / m.n);
    return m.mean;
}

/* --- all of them ------------------------------------------------------------------------------------- */

/* p-values of all n hypotheses; those between two exact, equal values say nothing and are left out. Returns how many
 * were written; where[j] (may be NULL) is the index of the j-th. What is not finite equals nothing. */
static long all_p(const struct batches *a, const struct batches *b, double *p, long *where)
{
    long n = 0;
    for (long i = 0; i < a->n; i++) {
        struct moments x = batches_moments(a, i), y = batches_moments(b, i);
        if (x.variance + y.variance == 0 && x.mean - y.mean == 0)
            continue;
        if (where != NULL)
            where[n] = i;
        p[n++] = welch(x, y);
    }
    return n;
}

static double random_normal(struct rng *r)
{
    double u = 1 - rng_uniform(r), v = rng_uniform(r);
    return sqrt(-2 * m_log(u)) * m_cos(2 * PI * v);
}

/* Batches with expectation 0 that scatter like b does. */
static void resample(const struct batches *b, struct rng *r, struct batches *out)
{
    if (b->error != NULL) {
        for (long i = 0; i < b->n; i++) {
            out->value[i] = b->error[i] * random_normal(r);
            out->error[i] = b->error[i];
        }
        return;
    }
    /* Deviations from the batches' own mean are too small by this factor. */
    double stretch = sqrt(b->n_batches / (b->n_batches - 1.0));
    double *mean = mem_alloc((size_t)b->n, sizeof *mean);
    for (long i = 0; i < b->n; i++)
        mean[i] = batches_moments(b, i).mean;
    for (int k = 0; k < b->n_batches; k++) {
        double sign = rng_u32(r) & 1 ? stretch : -stretch;
        for (long i = 0; i < b->n; i++)
            out->value[b->n * k + i] = sign * (b->value[b->n * k + i] - mean[i]);
    }
    free(mean);
}

/* p-value of a distance: Kolmogorov's, with the scale on which the resamplings' distances have its 90 % quantile. */
static double uniform_p(const struct batches *a, const struct batches *b, double distance, uint64_t seed)
{
    const double quantile = 1.2238; /* stats_kolmogorov_p(1.2238) = 0.1 */
    double found[RESAMPLINGS], *p = mem_alloc((size_t)a->n, sizeof *p);
    struct rng r = rng_stream(seed, RNG_TEST, 0, 0);
    struct batches x = batches_new(a->n_batches, a->n, a->error != NULL);
    struct batches y = batches_new(b->n_batches, b->n, b->error != NULL);
    for (int i = 0; i < RESAMPLINGS; i++) {
        resample(a, &r, &x);
        resample(b, &r, &y);
        found[i] = stats_ks_distance(p, (size_t)all_p(&x, &y, p, NULL));
    }
    batches_free(&x);
    batches_free(&y);
    free(p);
    stats_sort(found, RESAMPLINGS);
    return stats_kolmogorov_p(quantile * distance / found[RESAMPLINGS * 9 / 10]);
}

/* Of n p-values the smallest, corrected for their number, and its place; `none` if there are none. */
static double smallest_p(const double *p, long n, double none, const long *where, long *place)
{
    double smallest = 1;
    for (long i = 0; i < n && !isnan(smallest); i++)
        if (!(p[i] >= smallest)) {
            smallest = p[i];
            *place = where[i];
        }
    return n > 0 ? stats_sidak(smallest, (double)n) : none;
}

double batches_smallest_p(const struct batches *a, const struct batches *b)
{
    long place = 0, *where = mem_alloc((size_t)a->n, sizeof *where);
    double *p = mem_alloc((size_t)a->n, sizeof *p);
    double smallest = smallest_p(p, all_p(a, b, p, where), NAN, where, &place);
    free(p);
    free(where);
    return smallest;
}

struct verdict verify_batches(const struct batches *a, const struct batches *b, uint64_t seed)
{
    struct verdict v = {0};
    double *p = mem_alloc((size_t)a->n, sizeof *p);
    long *where = mem_alloc((size_t)a->n, sizeof *where);
    v.n = all_p(a, b, p, where);
    v.smallest = smallest_p(p, v.n, a->n > 0 ? 1 : NAN, where, &v.where);
    for (long i = 0; i < v.n; i++)
        v.bar[int_within(p[i] * VERIFY_BARS, 0, VERIFY_BARS - 1)]++;
    v.uniform = v.n > 0 ? uniform_p(a, b, stats_ks_distance(p, (size_t)v.n), seed) : 1;
    struct moments x = total_moments(a), y = total_moments(b);
    v.mean = welch(x, y);
    v.ratio = x.mean / y.mean;
    v.ratio_error = fabs(v.ratio) * sqrt(x.variance / (x.n * x.mean * x.mean) + y.variance / (y.n * y.mean * y.mean));
    v.p = stats_sidak(least_of(v.smallest, least_of(v.mean, v.uniform)), 3);
    free(p);
    free(where);
    return v;
}
