/* sampler.h: the random numbers one sub-path consumes, drawn in order.
 *
 * The first numbers of every stream, those that decide most, form a low-discrepancy sequence over the iterations of a
 * pixel: pairs of Sobol' points, Owen-scrambled by hashing, each pair visited in an order of its own [Burley 2020].
 * The rest comes from the pixel's generator. Each number alone is exactly uniform, and over pixels and seeds all are
 * independent, so nothing is biased. Within one pixel the iterations are better spread than independent ones, and a
 * weak correlation between two pairs may remain, since the order is a hash.
 *
 * Tests: test_sampler.c.
 */
#ifndef ASBDPT_SAMPLER_H
#define ASBDPT_SAMPLER_H

#include <math.h>

#include "base/rng.h"

enum {
    SAMPLER_DIMENSIONS = 6, /* numbers of low discrepancy at the start of a stream; even */
    SAMPLER_LOG2_POINTS = 16,
    SAMPLER_POINTS = 1 << SAMPLER_LOG2_POINTS /* iterations that share one scrambled sequence */
};

struct sampler {
    struct rng rng;
    uint64_t scramble; /* hash of (seed, purpose, pixel, iteration / SAMPLER_POINTS) */
    uint32_t index;    /* iteration % SAMPLER_POINTS: where in the sequence */
    int dimension;     /* numbers drawn so far, counted up to SAMPLER_DIMENSIONS */
    double second;     /* the other number of the current pair */
};

/* sampler_start: the numbers of (seed, purpose, pixel, iteration); see rng_stream. All 64 bits of each of them count:
 * names that differ give streams that differ. What lies above the sequence's index enters its scramble, so iterations
 * i and i + SAMPLER_POINTS have nothing in common. (A longer sequence would repeat there the first digits of all its
 * first coordinates, and with them whatever depends on no others.) */
struct sampler sampler_start(uint64_t seed, enum rng_purpose purpose, uint64_t pixel, uint64_t iteration);

/* sampler_pair: the next pair of the low-discrepancy part; for sampler_next only. */
double sampler_pair(struct sampler *s);

/* sampler_next: the next number in [0,1). */
static inline double sampler_next(struct sampler *s)
{
    if (s->dimension >= SAMPLER_DIMENSIONS)
        return rng_uniform(&s->rng);
    return s->dimension++ % 2 == 0 ? sampler_pair(s) : s->second;
}

/* sampler_next3: a discrete choice u[0] and a point of the unit square (u[1], u[2]), which is a pair where possible. */
static inline void sampler_next3(struct sampler *s, double u[3])
{
    u[1] = sampler_next(s);
    u[2] = sampler_next(s);
    u[0] = sampler_next(s);
}

/* sampler_r2: point i >= 0 of the sequence R2, which fills the unit square [0,1)^2 evenly [Roberts 2018]. */
static inline void sampler_r2(int64_t i, double *u, double *v)
{
    double x = 0.5 + 0.7548776662466927 * (double)i, y = 0.5 + 0.5698402909980532 * (double)i;
    *u = x - floor(x);
    *v = y - floor(y);
}

#endif
