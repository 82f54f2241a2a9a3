/* sampler.c: see sampler.h. */
#include "base/sampler.h"

static uint32_t reverse_bits(uint32_t x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/* Owen scrambling of a binary fraction given with its first digit in bit 0: every digit is flipped or not depending on a
 * hash of the digits before it. Multiplications by even numbers carry upwards only, which is what makes this hash do
 * that [Laine & Karras 2011; constants of Burley 2020]. */
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
    struct sampler s = {rng_stream(seed, purpose, pixel, iteration), 0, (uint32_t)iteration, 0, 0};
    s.scramble = hash_combine(hash_combine(hash_mix(seed ^ 0x6a09e667f3bcc908u), (uint64_t)purpose), pixel);
    return s;
}

double sampler_pair(struct sampler *s)
{
    const double unit = 1.0 / 4294967296.0;
    uint64_t h = hash_combine(s->scramble, (uint64_t)s->dimension), h2 = hash_mix(h);
    /* Visit blocks of 2^16 points in a scrambled order; a prefix of 2^k iterations is still a prefix of the sequence. */
    uint32_t within = s->iteration & 0xffffu, block = s->iteration & 0xffff0000u;
    uint32_t index = block | reverse_bits(scramble_digits(reverse_bits(within), (uint32_t)h) & 0xffff0000u);
    uint32_t x = scramble_digits(index, (uint32_t)(h >> 32));
    uint32_t y = scramble_digits(sobol_second(index), (uint32_t)h2);
    s->second = reverse_bits(y) * unit;
    return reverse_bits(x) * unit;
}
