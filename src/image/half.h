/* half.h: 16-bit floating point numbers, as OpenEXR stores them: the format binary16 [IEEE 754 3.6]. A sign, 5 bits of
 * exponent (bias 15), 10 bits of fraction.
 *
 * Tests: test_hdr.c (all 65536 of them there and back, roundings).
 */
#ifndef ASBDPT_HALF_H
#define ASBDPT_HALF_H

#include <math.h>
#include <stdint.h>

#include "base/bits.h"

/* The largest finite half. */
#define HALF_MAX 65504

/* half_to_float: exact; a NaN stays one. */
static inline float half_to_float(uint16_t h)
{
    unsigned exponent = h >> 10 & 31, fraction = h & 1023;
    if (exponent == 0) { /* 0 and subnormal numbers: multiples of 2^-24 */
        float small = (float)fraction * (1.0f / (1 << 24));
        return (h & 0x8000) != 0 ? -small : small;
    }
    return float_of_bits((uint32_t)(h & 0x8000) << 16 | (exponent == 31 ? 255 : exponent + 112) << 23 | fraction << 13);
}

/* float_to_half: the nearest half, of two equally near ones the even. What is finite stays finite: at most HALF_MAX in
 * magnitude. */
static inline uint16_t float_to_half(float x)
{
    uint32_t bits = bits_of_float(x);
    uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
    uint32_t size = bits & 0x7fffffff;
    if (size >= 0x7f800000) /* infinity, NaN */
        return (uint16_t)(sign | (size > 0x7f800000 ? 0x7e00 : 0x7c00));
    if (size >= 0x477fe000) /* HALF_MAX */
        return (uint16_t)(sign | 0x7bff);
    if (size < 0x38800000) /* below 2^-14: a multiple of 2^-24, which rounding to an integer finds */
        return (uint16_t)(sign | (uint16_t)lrintf(fabsf(x) * (1 << 24)));
    size += 0xfff + (size >> 13 & 1); /* round to even; a carry into the exponent is right */
    return (uint16_t)(sign | (size - 0x38000000) >> 13);
}

#endif
