/* verify.c: see verify.h. */
#include "lab/verify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/rng.h"
#include "base/stats.h"
#include "base/vec.h"

enum { RESAMPLINGS = 299, MANY = 1000 /* stands in for the size of a sample whose error is known */ };

struct sample sample_new(int n_batches, long n, bool with_error)
{
    struct sample s = {n_batches, n, NULL, NULL};
    s.value = mem_alloc((size_t)n * (size_t)n_batches, sizeof *s.value);
    if (with_error)
        s.error = mem_alloc((size_t)n, sizeof *s.error);
    return s;
}

void sample_free(struct sample *s)
{
    free(s->value);
    free(s->error);
    memset(s, 0, sizeof *s);
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

struct sample sample_tiles(const struct sample *s, int width, int height, int side)
{
    long across = (width + side - 1) / side, down = (height + side - 1) / side;
    struct sample out = sample_new(s->n_batches, 3 * across * down, s->error != NULL);
    for (long i = 0; i < out.n; i++) {
        int c = (int)(i % 3), x0 = (int)(i / 3 % across) * side, y0 = (int)(i / 3 / across) * side;
        int x1 = x0 + side < width ? x0 + side : width, y1 = y0 + side < height ? y0 + side : height;
        for (int k = 0; k < s->n_batches; k++)
            out.value[out.n * k + i] = tile_value(s->value + s->n * k, width, x0, y0, x1, y1, c, false);
        if (s->error != NULL)
            out.error[i] = tile_value(s->error, width, x0, y0, x1, y1, c, true);
    }
    return out;
}

/* --- one hypothesis ---------------------------------------------------------------------------------- */

/* Mean, variance and number as Welch's test wants them. */
struct moments {
    double mean, variance, n;
};

/* Of value i. */
static struct moments moments_of(const struct sample *s, long i)
{
    struct moments m = {0, 0, s->n_batches};
    for (int k = 0; k < s->n_batches; k++)
        m.mean += s->value[s->n * k + i] / s->n_batches;
    for (int k = 0; k < s->n_batches; k++) {
        double d = s->value[s->n * k + i] - m.mean;
        m.variance += s->n_batches > 1 ? d * d / (s->n_batches - 1) : 0;
    }
    if (s->error != NULL) {
        m.n = MANY;
        m.variance = s->error[i] * s->error[i] * MANY;
    }
    return m;
}

/* Of the mean of all values. Errors of pixels are independent, those of a pixel's channels are not: they add up. */
static struct moments total_moments(const struct sample *s)
{
    struct sample total = sample_new(s->n_batches, 1, s->error != NULL);
    for (int k = 0; k < s->n_batches; k++)
        for (long i = 0; i < s->n; i++)
            total.value[k] += s->value[s->n * k + i] / (double)s->n;
    if (s->error != NULL) {
        double sum[3] = {0, 0, 0};
        for (long i = 0; i < s->n; i++)
            sum[i % 3] += s->error[i] * s->error[i];
        total.error[0] = (sqrt(sum[0]) + sqrt(sum[1]) + sqrt(sum[2])) / (double)s->n;
    }
    struct moments m = moments_of(&total, 0);
    sample_free(&total);
    return m;
}

static double welch(struct moments a, struct moments b)
{
    return stats_welch_p(a.mean, a.variance, a.n, b.mean, b.variance, b.n);
}

double sample_mean(const struct sample *s, double *error)
{
    struct moments m = total_moments(s);
    if (error != NULL)
        *error = sqrt(m.variance / m.n);
    return m.mean;
}

/* --- all of them ------------------------------------------------------------------------------------- */

/* p-values of all n hypotheses; those between two exact, equal values say nothing and are left out. Returns how many
 * were written; where[j] (may be NULL) is the index of the j-th. */
static long all_p(const struct sample *a, const struct sample *b, double *p, long *where)
{
    long n = 0;
    for (long i = 0; i < a->n; i++) {
        struct moments x = moments_of(a, i), y = moments_of(b, i);
        if (x.variance + y.variance == 0 && x.mean == y.mean)
            continue;
        if (where != NULL)
            where[n] = i;
        p[n++] = welch(x, y);
    }
    return n;
}

/* Largest distance between the p-values' distribution and the uniform one; sorts them. */
static double uniform_distance(double *p, long n)
{
    return n == 0 ? 0 : stats_ks_distance(p, (size_t)n);
}

static double random_normal(struct rng *r)
{
    double u = 1 - rng_uniform(r), v = rng_uniform(r);
    return sqrt(-2 * log(u)) * cos(2 * PI * v);
}

/* A sample with expectation 0 that scatters like s does. */
static void resample(const struct sample *s, struct rng *r, struct sample *out)
{
    if (s->error != NULL) {
        for (long i = 0; i < s->n; i++) {
            out->value[i] = s->error[i] * random_normal(r);
            out->error[i] = s->error[i];
        }
        return;
    }
    double stretch = sqrt(s->n_batches / (s->n_batches - 1.0)); /* deviations from the sample's own mean are too small */
    double *mean = mem_alloc((size_t)s->n, sizeof *mean);
    for (long i = 0; i < s->n; i++)
        mean[i] = moments_of(s, i).mean;
    for (int k = 0; k < s->n_batches; k++) {
        double sign = rng_u32(r) & 1 ? stretch : -stretch;
        for (long i = 0; i < s->n; i++)
            out->value[s->n * k + i] = sign * (s->value[s->n * k + i] - mean[i]);
    }
    free(mean);
}

/* p-value of a distance: Kolmogorov's, with the scale on which the resamplings' distances have its 90 % quantile. */
static double uniform_p(const struct sample *a, const struct sample *b, double distance, uint64_t seed)
{
    const double quantile = 1.2238; /* stats_kolmogorov_p(1.2238) = 0.1 */
    double found[RESAMPLINGS], *p = mem_alloc((size_t)a->n, sizeof *p);
    struct rng r = rng_stream(seed, RNG_TEST, 0, 0);
    struct sample x = sample_new(a->n_batches, a->n, a->error != NULL);
    struct sample y = sample_new(b->n_batches, b->n, b->error != NULL);
    for (int i = 0; i < RESAMPLINGS; i++) {
        resample(a, &r, &x);
        resample(b, &r, &y);
        found[i] = uniform_distance(p, all_p(&x, &y, p, NULL));
    }
    sample_free(&x);
    sample_free(&y);
    free(p);
    stats_sort(found, RESAMPLINGS);
    return stats_kolmogorov_p(quantile * distance / found[RESAMPLINGS * 9 / 10]);
}

struct verdict verify_samples(const struct sample *a, const struct sample *b, uint64_t seed, double *p_out)
{
    struct verdict v = {.smallest = 1};
    double *p = mem_alloc((size_t)a->n, sizeof *p);
    long *where = mem_alloc((size_t)a->n, sizeof *where);
    v.n = all_p(a, b, p, where);
    for (long i = 0; i < v.n; i++) {
        v.bar[int_within(p[i] * VERIFY_BARS, 0, VERIFY_BARS - 1)]++;
        if (p[i] < v.smallest) {
            v.smallest = p[i];
            v.where = where[i];
        }
    }
    if (p_out != NULL)
        memcpy(p_out, p, (size_t)v.n * sizeof *p);
    v.smallest = v.n > 0 ? stats_sidak(v.smallest, (double)v.n) : 1;
    v.uniform = v.n > 0 ? uniform_p(a, b, uniform_distance(p, v.n), seed) : 1;
    struct moments x = total_moments(a), y = total_moments(b);
    v.mean = welch(x, y);
    v.ratio = x.mean / y.mean;
    v.ratio_error = fabs(v.ratio) * sqrt(x.variance / (x.n * x.mean * x.mean) + y.variance / (y.n * y.mean * y.mean));
    v.p = stats_sidak(fmin(v.smallest, fmin(v.mean, v.uniform)), 3);
    free(p);
    free(where);
    return v;
}
