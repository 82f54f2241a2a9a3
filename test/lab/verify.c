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
    NEAR = 2, /* tiles, along each side: whose largest samples a tile may have missed */
    RESAMPLINGS = 299,
    MANY = 1000 /* instead of the number of batches of a picture whose error is known */
};

struct batches batches_new(int n_batches, long n, bool with_error)
{
    struct batches b = {.n_batches = n_batches, .n = n};
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
    out.across = across;
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

/* --- rare samples ------------------------------------------------------------------------------------ */

/* How far value i of a batch is from the mean of all at most; of a picture with errors nobody knows. */
static double largest_step(const struct batches *b, long i)
{
    double mean = batches_moments(b, i).mean, largest = 0;
    for (int k = 0; k < b->n_batches && b->error == NULL; k++)
        largest = most_of(largest, fabs(b->value[b->n * k + i] - mean));
    return largest;
}

/* The largest of the steps of the tiles near tile (x, y), in channel c. */
static double largest_near(const double *step, long across, long down, long x, long y, long c)
{
    double largest = 0;
    for (long v = y - NEAR; v <= y + NEAR; v++)
        for (long u = x - NEAR; u <= x + NEAR; u++)
            if (u >= 0 && u < across && v >= 0 && v < down)
                largest = most_of(largest, step[3 * (v * across + u) + c]);
    return largest;
}

/* Of each value the largest step that a rare sample has made in it or near it, or anywhere where that is none. To be
 * freed. */
static double *rare_steps(const struct batches *b)
{
    double *step = mem_alloc((size_t)b->n, sizeof *step), *out = mem_alloc((size_t)b->n, sizeof *out), most = 0;
    for (long i = 0; i < b->n; i++) {
        out[i] = step[i] = largest_step(b, i);
        most = most_of(most, step[i]);
    }
    for (long i = 0; i < b->n && b->across > 0; i++)
        out[i] = largest_near(step, b->across, b->n / 3 / b->across, i / 3 % b->across, i / 3 / b->across, i % 3);
    for (long i = 0; i < b->n; i++)
        out[i] = out[i] == 0 ? most : out[i];
    free(step);
    return out;
}

/* The probability that a side has missed all samples of this size that its mean lacks. */
static double missed_p(struct moments side, double lacks, double step)
{
    return step > 0 ? m_exp(-lacks * side.n / step) : 0;
}

/* --- all of them ------------------------------------------------------------------------------------- */

/* Both sides, and of each value the rare_steps of each; NULL: nothing is rare. */
struct sides_steps {
    const double *a, *b;
};

/* Welch's p-value, or more if a side may lack but a few samples of its step's size: bright ones or, as at the edge of a
 * shadow, dark ones. */
static double rare_p(struct moments x, struct moments y, double step_x, double step_y)
{
    double lacks = fabs(x.mean - y.mean);
    return most_of(welch(x, y), most_of(missed_p(x, lacks, step_x), missed_p(y, lacks, step_y)));
}

/* The same of the means over all values: a sample has three channels. */
static double mean_p(const struct batches *a, const struct batches *b, struct sides_steps steps)
{
    double most[2] = {0, 0};
    for (long i = 0; i < a->n; i++) {
        most[0] = most_of(most[0], steps.a[i]);
        most[1] = most_of(most[1], steps.b[i]);
    }
    return rare_p(total_moments(a), total_moments(b), 3 * most[0] / (double)a->n, 3 * most[1] / (double)a->n);
}

/* p-values of all n hypotheses; those between two exact, equal values say nothing and are left out. Returns how many
 * were written; where[j] (may be NULL) is the index of the j-th. What is not finite equals nothing. */
static long all_p(const struct batches *a, const struct batches *b, struct sides_steps steps, double *p, long *where)
{
    long n = 0;
    for (long i = 0; i < a->n; i++) {
        struct moments x = batches_moments(a, i), y = batches_moments(b, i);
        if (x.variance + y.variance == 0 && x.mean - y.mean == 0)
            continue;
        if (where != NULL)
            where[n] = i;
        p[n++] = steps.a != NULL ? rare_p(x, y, steps.a[i], steps.b[i]) : welch(x, y);
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

/* Adds to each tenth of [0,1] how many of n p-values are in it, times `weight`. */
static void add_bars(const double *p, long n, double weight, double bar[VERIFY_BARS])
{
    for (long i = 0; i < n; i++)
        bar[int_within(p[i] * VERIFY_BARS, 0, VERIFY_BARS - 1)] += weight;
}

/* p-value of a distance: Kolmogorov's, with the scale on which the resamplings' distances have its 90 % quantile.
 *   expected  adds the mean of the resamplings' bars */
static double uniform_p(const struct batches *a, const struct batches *b, struct sides_steps steps, double distance,
                        uint64_t seed, double expected[VERIFY_BARS])
{
    const double quantile = 1.2238; /* stats_kolmogorov_p(1.2238) = 0.1 */
    double found[RESAMPLINGS], *p = mem_alloc((size_t)a->n, sizeof *p);
    struct rng r = rng_stream(seed, RNG_TEST, 0, 0);
    struct batches x = batches_new(a->n_batches, a->n, a->error != NULL);
    struct batches y = batches_new(b->n_batches, b->n, b->error != NULL);
    for (int i = 0; i < RESAMPLINGS; i++) {
        resample(a, &r, &x);
        resample(b, &r, &y);
        long n = all_p(&x, &y, steps, p, NULL);
        add_bars(p, n, 1.0 / RESAMPLINGS, expected);
        found[i] = stats_ks_distance(p, (size_t)n);
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
    double smallest = smallest_p(p, all_p(a, b, (struct sides_steps){NULL, NULL}, p, where), NAN, where, &place);
    free(p);
    free(where);
    return smallest;
}

struct verdict verify_batches(const struct batches *a, const struct batches *b, uint64_t seed)
{
    struct verdict v = {0};
    double *p = mem_alloc((size_t)a->n, sizeof *p);
    long *where = mem_alloc((size_t)a->n, sizeof *where);
    double *step_a = rare_steps(a), *step_b = rare_steps(b);
    struct sides_steps steps = {step_a, step_b};
    v.n = all_p(a, b, steps, p, where);
    add_bars(p, v.n, 1, v.bar);
    v.smallest = smallest_p(p, v.n, a->n > 0 ? 1 : NAN, where, &v.where);
    v.uniform = v.n > 0 ? uniform_p(a, b, steps, stats_ks_distance(p, (size_t)v.n), seed, v.expected) : 1;
    struct moments x = total_moments(a), y = total_moments(b);
    v.mean = mean_p(a, b, steps);
    v.ratio = x.mean / y.mean;
    v.ratio_error = fabs(v.ratio) * sqrt(x.variance / (x.n * x.mean * x.mean) + y.variance / (y.n * y.mean * y.mean));
    v.p = stats_sidak(least_of(v.smallest, least_of(v.mean, v.uniform)), 3);
    free(step_a);
    free(step_b);
    free(p);
    free(where);
    return v;
}
