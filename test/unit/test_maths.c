/* test_maths.c: the elementary functions against series summed in twice the precision of a double.
 *
 * A `wide` is a sum of two doubles, good for some 100 bits. Its exponential and its sine and cosine are Taylor series
 * of an argument halved until it is small; inverse functions are judged by them: if e^y misses x by a relative d, then
 * y misses log(x) by -d, and so on. No constant is shared with maths.c, and nothing is asked of the machine's libm.
 */
#include "base/maths.h"

#include <math.h>

#include "base/number.h"
#include "base/rng.h"
#include "lab/numbers.h"
#include "suites.h"

struct wide {
    double high, low;
};

static struct wide wide(double x)
{
    struct wide w = {x, 0};
    return w;
}

/* The rounding error of a + b is exactly ((a - (s - v)) + (b - v)), v = s - a.                         [Dekker 1971] */
static struct wide wide_add(struct wide a, struct wide b)
{
    double s = a.high + b.high, v = s - a.high;
    double low = ((a.high - (s - v)) + (b.high - v)) + (a.low + b.low);
    struct wide w = {s + low, 0};
    w.low = low - (w.high - s);
    return w;
}

static struct wide wide_mul(struct wide a, struct wide b)
{
    const double cut = 134217729; /* 2^27 + 1 */
    double a1 = cut * a.high - (cut * a.high - a.high), a2 = a.high - a1;
    double b1 = cut * b.high - (cut * b.high - b.high), b2 = b.high - b1;
    double p = a.high * b.high;
    double low = (((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2) + (a.high * b.low + a.low * b.high);
    struct wide w = {p + low, 0};
    w.low = low - (w.high - p);
    return w;
}

static struct wide wide_less(struct wide a, struct wide b)
{
    struct wide minus = {-b.high, -b.low};
    return wide_add(a, minus);
}

static struct wide wide_scale(struct wide a, int power)
{
    struct wide w = {ldexp(a.high, power), ldexp(a.low, power)};
    return w;
}

static struct wide wide_over(struct wide a, double n)
{
    struct wide q = wide(a.high / n), rest = wide_less(a, wide_mul(q, wide(n)));
    return wide_add(q, wide((rest.high + rest.low) / n));
}

/* a = x / 2^halvings is at most 0.1. */
static struct wide halved(struct wide x, int *halvings)
{
    for (*halvings = 0; fabs(ldexp(x.high, -*halvings)) > 0.1;)
        ++*halvings;
    return wide_scale(x, -*halvings);
}

/* e^x - 1, doubling by e^(2a) - 1 = 2 (e^a - 1) + (e^a - 1)^2. */
static struct wide wide_expm1(struct wide x)
{
    int halvings;
    struct wide a = halved(x, &halvings), term = a, sum = a;
    for (int n = 2; n < 25; n++) {
        term = wide_over(wide_mul(term, a), n);
        sum = wide_add(sum, term);
    }
    while (halvings-- > 0)
        sum = wide_add(wide_scale(sum, 1), wide_mul(sum, sum));
    return sum;
}

/* e^x, doubling by squares: small results are as exact as large ones. */
static struct wide wide_exp(struct wide x)
{
    int halvings;
    struct wide a = halved(x, &halvings), power = wide_add(wide(1), wide_expm1(a));
    while (halvings-- > 0)
        power = wide_mul(power, power);
    return power;
}

/* sin(2a) = 2 sin(a) cos(a), cos(2a) = 1 - 2 sin(a)^2. */
static void wide_sincos(double x, struct wide *sine, struct wide *cosine)
{
    int halvings;
    struct wide a = halved(wide(x), &halvings), term = a;
    *sine = a;
    *cosine = wide(1);
    for (int n = 2; n < 25; n++) {
        term = wide_over(wide_mul(term, a), n % 2 == 0 ? -n : n);
        struct wide *sum = n % 2 == 0 ? cosine : sine;
        *sum = wide_add(*sum, term);
    }
    while (halvings-- > 0) {
        struct wide s = *sine;
        *sine = wide_scale(wide_mul(s, *cosine), 1);
        *cosine = wide_less(wide(1), wide_scale(wide_mul(s, s), 1));
    }
}

/* ---- what is missing to y: the true value less y ---- */

static double off(struct wide truth, double y)
{
    struct wide d = wide_less(truth, wide(y));
    return d.high + d.low;
}

static double off_sin(double x, double y)
{
    struct wide s, c;
    wide_sincos(x, &s, &c);
    return off(s, y);
}

static double off_cos(double x, double y)
{
    struct wide s, c;
    wide_sincos(x, &s, &c);
    return off(c, y);
}

static double off_tan(double x, double y)
{
    struct wide s, c;
    wide_sincos(x, &s, &c);
    return off(wide_less(s, wide_mul(wide(y), c)), 0) / c.high;
}

static double off_exp(double x, double y) { return off(wide_exp(wide(x)), y); }
static double off_expm1(double x, double y) { return off(wide_expm1(wide(x)), y); }

/* (above + 1) / e^z - 1, where e^z nearly is above + 1: what is missing to the logarithm z. */
static double off_logarithm(double above, struct wide z)
{
    return off(wide_less(wide(above), wide_expm1(z)), 0) / (1 + above);
}

static double off_log1p(double x, double y) { return off_logarithm(x, wide(y)); }

static double off_log(double x, double y)
{
    return x >= 0.5 && x <= 2 ? off_logarithm(x - 1, wide(y)) : off(wide_mul(wide(x), wide_exp(wide(-y))), 1);
}

static struct wide wide_log(double x)
{
    double y = m_log(x);
    return wide_add(wide(y), wide(off_log(x, y)));
}

static double off_log_to(double base, double x, double y)
{
    struct wide unit = wide_log(base);
    return off(wide_less(wide_log(x), wide_mul(wide(y), unit)), 0) / unit.high;
}

static double off_log2(double x, double y) { return off_log_to(2, x, y); }
static double off_log10(double x, double y) { return off_log_to(10, x, y); }

static double off_acos(double x, double y)
{
    struct wide s, c;
    wide_sincos(y, &s, &c);
    return off(c, x) / s.high;
}

/* Functions of two arguments, of which the second varies less. */
static double power(double x) { return m_pow(x, 2.4); }
static double root(double x) { return m_pow(x, 1 / 2.4); }
static double tenth(double x) { return m_pow(10, x); }
static double off_power(double x, double y) { return off(wide_exp(wide_mul(wide(2.4), wide_log(x))), y); }
static double off_root(double x, double y) { return off(wide_exp(wide_mul(wide(1 / 2.4), wide_log(x))), y); }
static double off_tenth(double x, double y) { return off(wide_exp(wide_mul(wide(x), wide_log(10))), y); }

static double off_angle(double y, double x, double angle)
{
    struct wide s, c;
    wide_sincos(angle, &s, &c);
    return off(wide_less(wide_mul(wide(y), c), wide_mul(wide(x), s)), 0) / sqrt(x * x + y * y);
}

static double angle_right(double y) { return m_atan2(y, 0.75); }
static double angle_left(double y) { return m_atan2(y, -0.75); }
static double off_right(double y, double angle) { return off_angle(y, 0.75, angle); }
static double off_left(double y, double angle) { return off_angle(y, -0.75, angle); }

/* ---- the tests ---- */

static const struct function {
    const char *name;
    double (*value)(double x), (*off)(double x, double y);
    double low, high; /* uniform arguments */
    double bound;     /* of the error, ulp, as maths.h promises it */
} FUNCTIONS[] = {
    {"sin", m_sin, off_sin, -7, 7, 0.8},       {"sin", m_sin, off_sin, -1e6, 1e6, 0.8},
    {"cos", m_cos, off_cos, -7, 7, 0.8},       {"cos", m_cos, off_cos, -1e6, 1e6, 0.8},
    {"tan", m_tan, off_tan, -7, 7, 2.5},       {"acos", m_acos, off_acos, -1, 1, 3},
    {"exp", m_exp, off_exp, -700, 700, 0.7},   {"exp", m_exp, off_exp, -1, 1, 0.7},
    {"expm1", m_expm1, off_expm1, -3, 3, 1.5}, {"expm1", m_expm1, off_expm1, -50, 50, 1.5},
    {"log", m_log, off_log, 0, 2, 0.6},        {"log", m_log, off_log, 0, 1e10, 0.6},
    {"log2", m_log2, off_log2, 0, 10, 0.6},    {"log_ten", log_ten, off_log10, 0, 10, 3},
    {"log1p", m_log1p, off_log1p, -1, 1, 1},   {"log1p", m_log1p, off_log1p, -1e-4, 1e-4, 1},
    {"pow", power, off_power, 0, 1, 0.7},      {"pow", root, off_root, 0, 1, 0.7},
    {"pow", tenth, off_tenth, -300, 300, 0.7}, {"atan2", angle_right, off_right, -3, 3, 1.7},
    {"atan2", angle_left, off_left, -3, 3, 1.7}, {"atan2", angle_right, off_right, 0.18, 0.19, 1.7}, /* its worst */
};
enum { N_FUNCTIONS = sizeof FUNCTIONS / sizeof FUNCTIONS[0], N_ARGUMENTS = 1500 };

static double in_ulps(double error, double y)
{
    int power_of_2;
    frexp(y, &power_of_2);
    return fabs(error) / ldexp(1, power_of_2 - 53);
}

/* No error is above its bound, and one that is would be seen. */
static void check_function(struct test *t, const struct function *f, struct rng *r)
{
    double worst = 0, at = 0, wrong = INFINITY;
    for (int i = 0; i < N_ARGUMENTS; i++) {
        double x = f->low + rng_uniform(r) * (f->high - f->low), y = f->value(x);
        double error = in_ulps(f->off(x, y), y);
        if (!(error <= worst)) {
            worst = error;
            at = x;
        }
        double shifted = y + ldexp(y, -52) * (2 * f->bound + 1);
        wrong = least_of(wrong, in_ulps(f->off(x, shifted), y));
    }
    CHECK(t, worst <= f->bound, "%s(%.17g) is off by %.3f ulp, more than %g", f->name, at, worst, f->bound);
    CHECK(t, wrong > f->bound, "%s: a planted error counts as %.3f ulp", f->name, wrong);
}

/* Where the angle is next to a multiple of pi/2: its digits are those of pi after the sixteenth. */
static void check_cancellation(struct test *t)
{
    CHECK(t, m_sin(PI) == 1.2246467991473532e-16 && m_sin(-PI) == -1.2246467991473532e-16, "sin pi");
    CHECK(t, m_cos(PI / 2) == 6.123233995736766e-17, "cos pi/2");
    CHECK(t, m_cos(1.5 * PI) == -1.8369701987210297e-16, "cos 3 pi/2");
    CHECK(t, fabs(m_sin(1e22)) <= 1 && fabs(m_cos(-1e300)) <= 1, "sines of huge numbers");
}

static void check_exact_cases(struct test *t)
{
    CHECK(t, m_sin(0) == 0 && m_cos(0) == 1 && m_tan(0) == 0 && m_exp(0) == 1 && m_expm1(0) == 0, "at 0");
    CHECK(t, m_log(1) == 0 && m_log1p(0) == 0 && m_acos(1) == 0 && m_acos(-1) == PI, "at 1");
    for (int k = -1074; k < 1024; k++)
        CHECK(t, m_log2(ldexp(1, k)) == k, "log2 of 2^%d is %.17g", k, m_log2(ldexp(1, k)));
    double ten = 1;
    for (int k = 0; k <= 22; k++, ten *= 10)
        CHECK(t, log_ten(ten) == k && m_pow(10, k) == ten, "10^%d", k);
    CHECK(t, m_pow(0, 2) == 0 && m_pow(7, 0) == 1 && m_pow(0, -1) == HUGE_VAL, "powers");
    static const double angles[][3] = {
        {0.0, 1, 0},     {-0.0, 1, -0.0}, {0.0, -1, PI},       {-0.0, -1, -PI}, {1, 0, PI / 2},
        {-1, 0, -PI / 2}, {1, 1, PI / 4},  {1, -1, 3 * PI / 4}, {0.0, 0.0, 0},   {0.0, -0.0, PI},
    };
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        const double *a = angles[i], angle = m_atan2(a[0], a[1]);
        CHECK(t, angle == a[2] && (a[2] != 0 || 1 / angle == 1 / a[2]), "atan2(%g, %g) = %g", a[0], a[1], angle);
    }
}

static void check_ends(struct test *t)
{
    CHECK(t, m_exp(1000) == HUGE_VAL && m_exp(-1000) == 0 && m_exp(-745) > 0 && m_exp(709.7) < HUGE_VAL, "exp");
    CHECK(t, m_exp(HUGE_VAL) == HUGE_VAL && m_exp(-HUGE_VAL) == 0 && m_expm1(-HUGE_VAL) == -1, "exp of infinity");
    CHECK(t, m_log(0) == -HUGE_VAL && m_log(HUGE_VAL) == HUGE_VAL && isnan(m_log(-1)), "log");
    CHECK(t, m_pow(10, 400) == HUGE_VAL && m_pow(10, -400) == 0 && m_pow(0.1, 1e300) == 0, "pow");
    CHECK(t, isnan(m_sin(NAN)) && isnan(m_cos(HUGE_VAL)) && isnan(m_exp(NAN)) && isnan(m_log(NAN)), "no numbers");
    CHECK(t, isnan(m_pow(NAN, 2)) && isnan(m_pow(2, NAN)) && isnan(m_pow(-1, 2)) && isnan(m_atan2(NAN, 1)), "nor pow");
    CHECK(t, isnan(m_acos(2)) && isnan(m_log1p(-2)) && m_log1p(-1) == -HUGE_VAL, "outside");
}

void test_maths(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_EYE, 31, 0);
    for (int i = 0; i < N_FUNCTIONS; i++)
        check_function(t, &FUNCTIONS[i], &r);
    check_cancellation(t);
    check_exact_cases(t);
    check_ends(t);
}
