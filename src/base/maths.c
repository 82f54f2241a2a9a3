/* maths.c: see maths.h. Everywhere the same three steps: move the argument near 0 by an exact step, sum the Taylor
 * series there, undo the first step. Where the result must not lose the bits that rounding cuts off on the way, they
 * are carried along as the low part of a pair.
 *
 * The number of terms follows from the largest reduced argument: the first term left out is below 1/16 ulp. Rests on
 * every operation being rounded to double at once: no fused multiply-add (-ffp-contract=off), no x87. */
#include "base/maths.h"

#include "base/number.h"

/* A sum of two doubles that is not carried out; |low| is at most about an ulp of high. */
struct pair {
    double high, low;
};

/* a + b, exactly, for |a| >= |b| or a = 0.                                                          [Dekker 1971] */
static struct pair sum_of_ordered(double a, double b)
{
    double s = a + b;
    return (struct pair){s, b - (s - a)};
}

/* a b, exactly: each is cut into halves of 26 bits, whose products have room. |a|, |b| below 2^996. [Dekker 1971] */
static struct pair product(double a, double b)
{
    const double cut = 134217729; /* 2^27 + 1 */
    double a1 = cut * a - (cut * a - a), a2 = a - a1, b1 = cut * b - (cut * b - b), b2 = b - b1;
    double p = a * b;
    return (struct pair){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

/* The product of two pairs, to about 2^-100. */
static struct pair product_of_pairs(struct pair a, struct pair b)
{
    struct pair p = product(a.high, b.high);
    return sum_of_ordered(p.high, p.low + (a.high * b.low + a.low * b.high));
}

/* c[0] + c[1] x + ... + c[n-1] x^(n-1), n even: even and odd powers side by side, which takes half the time of one
 * chain in which every step waits for the one before. */
static inline double polynomial(const double *c, int n, double x)
{
    double square = x * x, even = c[n - 2], odd = c[n - 1];
    for (int i = n - 4; i >= 0; i -= 2) {
        even = even * square + c[i];
        odd = odd * square + c[i + 1];
    }
    return even + x * odd;
}

/* ---- sine and cosine ---- */

/* x = quarters pi/2 + at.high + at.low, |at.high| not much above pi/4. pi/2 is the sum of three numbers of 33 bits,
 * whose products with `quarters`, below 2^20, are exact, and a rest: what cancels is known in time.
 *                                                                                         [Cody & Waite 1980 8] */
static struct pair reduce_angle(double x, int *quarters)
{
    static const double part[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69, 0x1.b839a252049c1p-104};
    struct pair at = {x, 0};
    *quarters = (int)(x * 0.63661977236758134308 + (x < 0 ? -0.5 : 0.5));
    double k = *quarters;
    double a = x - k * part[0];
    double b = a - k * part[1], rest_b = (a - b) - k * part[1];
    double c = b - k * part[2], rest_c = (b - c) - k * part[2];
    double low = (rest_b + rest_c) - k * part[3];
    at.high = c + low;
    at.low = (c - at.high) + low;
    return at;
}

/* The two series; a.low changes sine by a.low cos(a.high).      [Abramowitz & Stegun 1964 4.3.65] */
static double sine_series(struct pair a)
{
    static const double c[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                               -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
    double z = a.high * a.high;
    return a.high + (a.high * z * polynomial(c, 8, z) + a.low * (1 - 0.5 * z));
}

static double cosine_series(struct pair a) /* [Abramowitz & Stegun 1964 4.3.66] */
{
    static const double c[] = {1.0 / 24,        -1.0 / 720,         1.0 / 40320,          -1.0 / 3628800,
                               1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000, -1.0 / 6402373705728000};
    double z = a.high * a.high;
    struct pair first = sum_of_ordered(1, -0.5 * z);
    return first.high + (first.low + (z * z * polynomial(c, 8, z) - a.high * a.low));
}

void m_sincos(double x, double *sine, double *cosine)
{
    const double limit = 1e6, period = 0x1.921fb54442d18p+20; /* 2^18 times 2 pi, rounded */
    if (!(fabs(x) <= limit))
        x = fmod(x, period);
    if (!(fabs(x) <= period)) { /* infinite or no number */
        *sine = *cosine = NAN;
        return;
    }
    int quarters = 0;
    struct pair a = {x, 0};
    if (fabs(x) > 0.7854)
        a = reduce_angle(x, &quarters);
    static const double sign[] = {1, 1, -1, -1};
    double s = sine_series(a), c = cosine_series(a);
    unsigned quadrant = (unsigned)quarters;
    bool swapped = quadrant % 2 == 1;
    *sine = sign[quadrant % 4] * (swapped ? c : s);
    *cosine = sign[(quadrant + 1) % 4] * (swapped ? s : c);
}

double m_sin(double x)
{
    double s, c;
    m_sincos(x, &s, &c);
    return s;
}

double m_cos(double x)
{
    double s, c;
    m_sincos(x, &s, &c);
    return c;
}

double m_tan(double x)
{
    double s, c;
    m_sincos(x, &s, &c);
    return s / c;
}

/* ---- inverse functions ---- */

/* The angle is that of a node, a line y = c x through the origin with c one of 0, 1/2, 1, 2 and infinity, and the angle
 * between the two, whose tangent t = (y - c x) / (x + c y) is at most 1/4: the subtraction is exact.
 *                                   [Abramowitz & Stegun 1964 4.4.34] [Abramowitz & Stegun 1964 4.4.42] */
double m_atan2(double y, double x)
{
    static const struct pair node[] = {{0, 0}, /* atan 0, 1/2, 1, 2, infinity */
                                       {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                       {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
                                       {0x1.1b6e192ebbe44p+0, 0x1.b1b466a88828ep-54},
                                       {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54}};
    static const double c[] = {-1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,  -1.0 / 11, 1.0 / 13,
                               -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23, 1.0 / 25};
    double a = fabs(x), b = fabs(y), t;
    int near;
    if (isnan(x) || isnan(y))
        return NAN;
    if (b <= 0.235 * a)
        near = 0, t = b == 0 ? 0 : b / a;
    else if (b <= 0.72 * a)
        near = 1, t = (b - 0.5 * a) / (a + 0.5 * b);
    else if (a > 0.72 * b)
        near = 2, t = (b - a) / (a + b);
    else if (a > 0.235 * b)
        near = 3, t = (b - 2 * a) / (a + 2 * b);
    else
        near = 4, t = -a / b;
    double z = t * t;
    double high = node[near].high, low = node[near].low + t * z * polynomial(c, 12, z);
    if (x < 0 || (x == 0 && 1 / x < 0)) { /* pi - angle */
        struct pair left = sum_of_ordered(2 * node[4].high, -high);
        high = left.high;
        low = left.low + 2 * node[4].low - low;
        t = -t;
    }
    double angle = high + (t + low);
    return y < 0 || (y == 0 && 1 / y < 0) ? -angle : angle;
}

double m_acos(double x) { return m_atan2(sqrt((1 - x) * (1 + x)), x); }

/* ---- exponential functions ---- */

static const struct pair LN2 = {0x1.62e42ffp-1, -0x1.718432a1b0e26p-35}; /* products of high with 2^11 are exact */
static const double INV_LN2 = 1.44269504088896340736;

/* The series of e^r - 1 - r over r^2, |r| <= ln(2)/2.                              [Abramowitz & Stegun 1964 4.2.1] */
static double exp_series(double r)
{
    static const double c[] = {1.0 / 2,      1.0 / 6,       1.0 / 24,       1.0 / 120,
                               1.0 / 720,    1.0 / 5040,    1.0 / 40320,    1.0 / 362880,
                               1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
    return polynomial(c, 12, r);
}

/* x = power ln(2) + r.high + r.low, |x.high| < 800.                                         [Cody & Waite 1980 6] */
static struct pair reduce_exponent(struct pair x, int *power)
{
    *power = (int)(x.high * INV_LN2 + (x.high < 0 ? -0.5 : 0.5));
    double high = x.high - *power * LN2.high, low = x.low - *power * LN2.low;
    struct pair r = {high + low, 0};
    r.low = (high - r.high) + low;
    return r;
}

static double exp_of_pair(struct pair x)
{
    if (!(fabs(x.high) < 800))
        return x.high > 0 ? HUGE_VAL : x.high < 0 ? 0 : x.high;
    int power;
    struct pair r = reduce_exponent(x, &power), first = sum_of_ordered(1, r.high);
    double rest = r.high * r.high * exp_series(r.high) + r.low * first.high;
    return ldexp(first.high + (first.low + rest), power);
}

double m_exp(double x) { return exp_of_pair((struct pair){x, 0}); }

double m_expm1(double x)
{
    if (!(fabs(x) < 40)) /* e^40 is beyond 2^53, and e^-40 below 2^-53 */
        return m_exp(x) - 1;
    int power;
    struct pair p = {x, 0}, r = reduce_exponent(p, &power);
    double less_one = r.high + (r.high * r.high * exp_series(r.high) + r.low), scale = ldexp(1, power);
    return power == 0 ? less_one : (scale - 1) + scale * less_one;
}

/* ---- logarithms ---- */

/* log(x) for finite x > 0, to 2^-64 of itself: x = 2^k m, sqrt(1/2) <= m < sqrt(2), and with s = (m - 1)/(m + 1) at
 * most 0.172 log(m) = 2 s + (2/3) s^3 + (2/5) s^5 + ... [Abramowitz & Stegun 1964 4.1.27], of which the terms from the
 * third on are small enough to be summed in double. */
static struct pair log_of(double x)
{
    static const double c[] = {2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13, 2.0 / 15,
                               2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23, 2.0 / 25, 2.0 / 27};
    int k;
    double m = frexp(x, &k);
    if (m < 0.70710678118654752440) {
        m *= 2;
        k--;
    }
    double above = m + 1, lost = m - (above - 1); /* m + 1 = above + lost */
    struct pair s = {(m - 1) / above, 0}, back = product(s.high, above);
    s.low = (((m - 1 - back.high) - back.low) - s.high * lost) / above;
    struct pair z = product_of_pairs(s, s);
    struct pair third = sum_of_ordered(2.0 / 3, z.high * polynomial(c, 12, z.high));
    third.low += 0x1.5555555555555p-55; /* what 2.0 / 3 lacks */
    struct pair cubic = product_of_pairs(s, product_of_pairs(z, third));
    struct pair log_m = sum_of_ordered(2 * s.high, cubic.high);
    log_m.low += 2 * s.low + cubic.low;
    if (k == 0)
        return sum_of_ordered(log_m.high, log_m.low);
    struct pair sum = sum_of_ordered(k * LN2.high, log_m.high);
    return sum_of_ordered(sum.high, sum.low + (log_m.low + k * LN2.low));
}

/* The logarithm times `unit`, 1 over that of the base. */
static double log_to_base(double x, struct pair unit)
{
    if (!(x > 0 && x <= DBL_MAX))
        return x == 0 ? -HUGE_VAL : x > 0 ? x : NAN;
    struct pair y = product_of_pairs(log_of(x), unit);
    return y.high;
}

double m_log(double x) { return log_to_base(x, (struct pair){1, 0}); }
double m_log2(double x) { return log_to_base(x, (struct pair){0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56}); }

double m_log1p(double x)
{
    double above = 1 + x;
    if (!(above > 0 && above <= DBL_MAX))
        return m_log(above);
    double part = above - 1, lost = (1 - (above - part)) + (x - part); /* 1 + x = above + lost */
    struct pair y = log_of(above);
    return y.high + (y.low + lost / above);
}

/* ---- powers ---- */

double m_pow(double x, double y)
{
    if (y == 0 || x == 1)
        return 1;
    if (!(x > 0 && x <= DBL_MAX)) /* 0, infinite, negative, or no number */
        return x < 0 || isnan(x) ? NAN : (x == 0) == (y > 0) ? 0 : HUGE_VAL;
    struct pair l = log_of(x);
    if (!(fabs(y * l.high) < 800)) /* also where the cut of y would overflow */
        return isnan(y) ? NAN : (y > 0) == (l.high > 0) ? HUGE_VAL : 0;
    struct pair p = product(y, l.high);
    p.low += y * l.low;
    return exp_of_pair(p);
}
