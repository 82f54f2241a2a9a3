/* sampler.h: the random numbers one sub-path consumes, drawn in order.
 *
 * Used by: path, connect, the methods.
 */
#ifndef ASBDPT_SAMPLER_H
#define ASBDPT_SAMPLER_H

#include "rng.h"

struct sampler {
    struct rng rng;
};

/* sampler_start: the numbers of (seed, purpose, pixel, iteration); see rng_stream. */
static inline struct sampler sampler_start(uint64_t seed, enum rng_purpose purpose, uint64_t pixel,
                                           uint64_t iteration)
{
    struct sampler s = {rng_stream(seed, purpose, pixel, iteration)};
    return s;
}

/* sampler_next: the next number in [0,1). */
static inline double sampler_next(struct sampler *s) { return rng_uniform(&s->rng); }

#endif
