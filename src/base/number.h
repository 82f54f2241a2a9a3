/* number.h: which numbers are usable, and conversions that are defined for all of them.
 *
 * C leaves open what becomes of a double that does not fit where it is converted to, and a NaN fits nowhere. Numbers of
 * scene files are checked where they are read; these conversions are for those that are computed.
 *
 * Used by: everything that turns a computed number into an index or a pixel. Tests: test_vec.c.
 */
#ifndef ASBDPT_NUMBER_H
#define ASBDPT_NUMBER_H

#include <float.h>

/* Numbers in scene files lie within +-NUMBER_MAX, those that must be greater than 0 are at least NUMBER_MIN: a product of
 * ten of them is still far from the ends of what a double holds. */
#define NUMBER_MAX 1e30
#define NUMBER_MIN 1e-30

/* int_within: x without its fraction, brought into [low, high]; low for NaN. low >= 0, or x a whole number. */
static inline int int_within(double x, int low, int high)
{
    return x > low ? (x < high ? (int)x : high) : low;
}

/* fits_float: whether a float can hold x; false for NaN and infinities. */
static inline int fits_float(double x) { return x >= -(double)FLT_MAX && x <= (double)FLT_MAX; }

/* float_within: the nearest float, at most FLT_MAX in magnitude; 0 for NaN. */
static inline float float_within(double x)
{
    if (fits_float(x))
        return (float)x;
    return x > 0 ? FLT_MAX : x < 0 ? -FLT_MAX : 0;
}

#endif
