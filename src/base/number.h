/* number.h: real numbers: which are usable, and roundings and conversions that are defined for all of them.
 *
 * C leaves open what becomes of a double that does not fit where it is converted to, and a NaN fits nowhere. Numbers of
 * scene files are checked where they are read; these conversions are for those that are computed.
 * Tests: test_vec.c. */
#ifndef ASBDPT_NUMBER_H
#define ASBDPT_NUMBER_H

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* No fused multiply-add, even without -ffp-contract=off. gcc knows only the option, and -std=c99 implies it. */
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

#define PI 3.14159265358979323846
#define INV_PI 0.31830988618379067154

/* Numbers in scene files lie within +-NUMBER_MAX, those that must be greater than 0 are at least NUMBER_MIN: a product
 * of ten of them is still far from the ends of what a double holds. */
#define NUMBER_MAX 1e30
#define NUMBER_MIN 1e-30

static inline double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
static inline double sqr(double x) { return x * x; }

/* most_of: the larger of two numbers; NaN if one of them is, which fmax forgets. */
static inline double most_of(double a, double b) { return isnan(a) || a > b ? a : b; }

/* safe_sqrt: square root of a number that rounding may have pushed below 0. */
static inline double safe_sqrt(double x) { return x > 0 ? sqrt(x) : 0; }

/* below_one: u, or the largest double below 1 where rounding has carried u to 1: what is said to be in [0,1) is. */
static inline double below_one(double u) { return u < 1 ? u : 1 - DBL_EPSILON / 2; }

/* int_within: x without its fraction, brought into [low, high]; low for NaN. low >= 0, or x a whole number. */
static inline int int_within(double x, int low, int high) { return x > low ? (x < high ? (int)x : high) : low; }

/* fits_float: whether a float can hold x; false for NaN and infinities. */
static inline bool fits_float(double x) { return x >= -(double)FLT_MAX && x <= (double)FLT_MAX; }

/* float_within: the nearest float, at most FLT_MAX in magnitude; 0 for NaN. */
static inline float float_within(double x)
{
    if (fits_float(x))
        return (float)x;
    return x > 0 ? FLT_MAX : x < 0 ? -FLT_MAX : 0;
}

/* float_below, float_above: the nearest float not above, not below x; x fits a float. */
static inline float float_below(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -FLT_MAX) : f;
}
static inline float float_above(double x) { return -float_below(-x); }

#endif
