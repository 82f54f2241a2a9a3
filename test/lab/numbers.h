/* numbers.h: what the laboratory and the tests ask of numbers, and the renderer does not.
 *
 * Tests: test_maths.c, test_random.c.
 */
#ifndef ASBDPT_LAB_NUMBERS_H
#define ASBDPT_LAB_NUMBERS_H

#include <math.h>

#include "base/maths.h"
#include "base/rng.h"

/* least_of: the smaller of two numbers; NaN if one of them is, which fmin forgets. */
static inline double least_of(double a, double b) { return isnan(a) || a < b ? a : b; }

/* rng_below: an integer in [0,n), n >= 1, without modulo bias worth speaking of (2^-32 n). */
static inline uint32_t rng_below(struct rng *r, uint32_t n) { return (uint32_t)(((uint64_t)rng_u32(r) * n) >> 32); }

/* log_ten: the decimal logarithm of x > 0, exact where that is a whole number; 3 ulp. */
static inline double log_ten(double x)
{
    double y = m_log(x) / m_log(10), whole = floor(y + 0.5);
    return m_pow(10, whole) == x ? whole : y;
}

#endif
