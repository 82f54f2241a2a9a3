/* rng.h: random numbers that belong to a pixel, never to a thread.
 *
 * A stream is named by (seed, purpose, pixel, iteration); the same name gives the same numbers whatever
 * thread draws them and in whatever order, which is what makes an image reproducible to the byte. The
 * generator is PCG-XSH-RR 64/32 [O'Neill 2014]; names are mixed into its state by SplitMix64 [Steele 2014].
 * Tests: test_vec.c (published numbers), test_streams.c (no two streams meet). */
#ifndef ASBDPT_RNG_H
#define ASBDPT_RNG_H

#include <stdint.h>

#include "base/bits.h"

struct rng {
    uint64_t state, increment; /* increment is odd and selects the sequence */
};

/* What a stream is for: two purposes never share numbers. */
enum rng_purpose {
    RNG_EYE = 1,
    RNG_LIGHT,
    RNG_SELECT,
    RNG_SHUFFLE,
    RNG_CONNECT,
    RNG_LEARN,
    RNG_TEST,
    RNG_RECORD,
    RNG_START, /* independent states, of which Markov chains start */
    RNG_CHAIN,
    RNG_TURN
};

static inline uint32_t rng_u32(struct rng *r)
{
    uint64_t old = r->state;
    r->state = old * 6364136223846793005u + r->increment;
    uint32_t x = (uint32_t)(((old >> 18) ^ old) >> 27);
    uint32_t turn = (uint32_t)(old >> 59);
    return (x >> turn) | (x << ((32 - turn) & 31));
}

/* rng_seed: start sequence number `sequence` at position `state`, as the published reference code does. */
static inline void rng_seed(struct rng *r, uint64_t state, uint64_t sequence)
{
    r->state = 0;
    r->increment = (sequence << 1) | 1;
    rng_u32(r);
    r->state += state;
    rng_u32(r);
}

/* rng_stream: the stream named by its four keys.
 *   seed       the user's --seed
 *   index      whatever the stream belongs to, usually the pixel's number y * width + x of the full frame
 *   iteration  sample number within the pixel, from 0 */
static inline struct rng rng_stream(uint64_t seed, enum rng_purpose purpose, uint64_t index, uint64_t iteration)
{
    uint64_t h = hash_combine(hash_combine(hash_combine(hash_mix(seed), (uint64_t)purpose), index), iteration);
    struct rng r;
    rng_seed(&r, h, hash_mix(h ^ 0x5851f42d4c957f2du));
    return r;
}

/* rng_uniform: a multiple of 2^-32 in [0,1); never 1. */
static inline double rng_uniform(struct rng *r) { return rng_u32(r) * (1.0 / 4294967296.0); }

#endif
