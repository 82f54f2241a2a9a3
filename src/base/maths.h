/* maths.h: the elementary functions, computed by this program itself.
 *
 * IEEE 754 prescribes the last bit of + - * / and sqrt, not that of sin or exp: every libm rounds them in its own way,
 * and one bit at the start of a path is another picture. These use nothing that is not prescribed, so that pictures
 * have the same bytes on every machine whose doubles are doubles. Elsewhere `src` does not call functions of libm that
 * round as they please; test/tree/standard.sh looks for them.
 *
 * Errors are bounds in units of the last place of the result (ulp), where it is a normal number. A result too large
 * is infinite, one too small is 0 or subnormal, NaN gives NaN. Cannot fail, thread-safe.
 * Tests: test_maths.c, against series in twice the precision. */
#ifndef ASBDPT_MATHS_H
#define ASBDPT_MATHS_H

/* Sine and cosine of an angle in radians, each to 0.8 ulp. Beyond |x| = 10^6, where a double is no
 * longer good for a direction, they are those of a number within 1 ulp of x. */
void m_sincos(double x, double *sine, double *cosine);
double m_sin(double x);
double m_cos(double x);

/* m_tan: their quotient, 2.5 ulp. */
double m_tan(double x);

/* m_atan2: the angle of the point (x,y), in [-pi,pi], as C99 defines it for zeros; 1.7 ulp. x and y are finite, and
 * such that their sum and quotient are not subnormal or infinite; (0,0) gives 0 or pi. */
double m_atan2(double y, double x);

/* m_acos: the angle in [0,pi] whose cosine is x, 3 ulp; NaN outside [-1,1]. */
double m_acos(double x);

/* m_exp: e^x, 0.7 ulp. m_expm1: e^x - 1, 1.5 ulp, also where it is small. */
double m_exp(double x);
double m_expm1(double x);

/* Logarithms, 0.6 ulp: natural and binary; exact where the result is a whole number. -infinity for 0, NaN below.
 * m_log1p: log(1 + x), 1 ulp, also where it is small. */
double m_log(double x);
double m_log2(double x);
double m_log1p(double x);

/* m_pow: x^y for x >= 0, 0.7 ulp; NaN for x < 0, unless y = 0. y is finite. */
double m_pow(double x, double y);

#endif
