/* sampler.c: see sampler.h. */
#include "base/sampler.h"

/* Owen scrambling of a binary fraction given with its first digit in bit 0: every digit is flipped or not depending on
 * a hash of the digits before it. Multiplications by even numbers carry upwards only, which is what makes this hash do
 * that [Laine & Karras 2011]; constants of [Burley 2020]. */
static uint32_t scramble_digits(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Second dimension of Sobol's sequence, first digit in bit 0. Its generator matrix is Pascal's triangle mod 2, where
 * entry (row, column) is 1 if and only if every bit of `row` is set in `column` [Lucas 1878]: digit i is the sum mod 2
 * of the bits of `index` whose numbers contain i, and these are summed one bit of i after the other. */
static uint32_t sobol_second(uint32_t index)
{
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

struct sampler sampler_start(uint64_t seed, enum rng_purpose purpose, uint64_t pixel, uint64_t iteration)
{
    struct sampler s = {.rng = rng_stream(seed, purpose, pixel, iteration),
                        .index = reverse_bits((uint32_t)(iteration & (SAMPLER_POINTS - 1)))};
    /* hash_mix is a bijection with hash_mix(0) = 0: every run of 2^16 iterations has a scramble of its own. */
    s.scramble = hash_combine(hash_combine(hash_mix(seed ^ 0x6a09e667f3bcc908u), (uint64_t)purpose), pixel) ^
                 hash_mix(iteration >> SAMPLER_LOG2_POINTS);
    return s;
}

/* Where a decision's sequence is at an iteration, given with its bits reversed: the points are visited in a scrambled
 * order, of which the first 2^k still are a net. */
static uint32_t scramble_order(uint32_t index, uint32_t seed)
{
    const uint32_t kept = ~(uint32_t)0 << (32 - SAMPLER_LOG2_POINTS);
    return reverse_bits(scramble_digits(index, seed) & kept);
}

/* The fraction whose first digit is bit 0. */
static double fraction(uint32_t digits) { return reverse_bits(digits) * (1.0 / 4294967296.0); }

/* Whether the next number of a decision is of low discrepancy; then *h is a hash of which it is. */
static inline bool is_even(struct sampler *s, enum decision d, uint64_t *h)
{
    if (d >= DRAW_LOBE || s->drawn[d] >= SAMPLER_TIMES)
        return false;
    *h = hash_combine(s->scramble, (uint64_t)d * SAMPLER_TIMES + s->drawn[d]++);
    return true;
}

double sampler_number(struct sampler *s, enum decision d)
{
    uint64_t h;
    double u;
    if (s->source != NULL) {
        s->source->next(s->source, d, &u, 1);
        return u;
    }
    if (!is_even(s, d, &h))
        return rng_uniform(&s->rng);
    return fraction(scramble_digits(scramble_order(s->index, (uint32_t)h), (uint32_t)(h >> 32)));
}

void sampler_pair(struct sampler *s, enum decision d, double u[2])
{
    uint64_t h;
    if (s->source != NULL) {
        s->source->next(s->source, d, u, 2);
        return;
    }
    if (!is_even(s, d, &h)) {
        u[0] = rng_uniform(&s->rng);
        u[1] = rng_uniform(&s->rng);
        return;
    }
    uint32_t index = scramble_order(s->index, (uint32_t)h);
    u[0] = fraction(scramble_digits(index, (uint32_t)(h >> 32)));
    u[1] = fraction(scramble_digits(sobol_second(index), (uint32_t)hash_mix(h)));
}

int64_t lattice_step(int64_t n)
{
    for (int64_t a = (int64_t)((double)n * 0.6180339887498949); a > 1; a--) {
        int64_t x = n, y = a;
        for (int64_t rest; y > 0; x = y, y = rest)
            rest = x % y;
        if (x == 1)
            return a;
    }
    return n > 1;
}
