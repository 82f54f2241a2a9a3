/* stats.c: distribution functions and hypothesis tests, see stats.h.
 *
 * The incomplete gamma and beta functions are a power series on one side of their mean and a continued fraction on
 * the other, the latter evaluated with Lentz's method [Lentz 1976] [Thompson & Barnett 1986]. Everything else is
 * one of these two functions.
 */
#include "lab/stats.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/vec.h"

static const double TINY = 1e-300; /* instead of a zero denominator in Lentz's method */
enum { MAX_TERMS = 1000000 };      /* sqrt(a) times a few are needed: enough for 10^10 degrees of freedom */

/* --- special functions ------------------------------------------------------------------------------- */

/* log Gamma(a) + log *product for a > 0. The library's lgamma writes a global sign, so it may not be called by two
 * threads: Stirling's series above 12 is as exact as a double, the recurrence Gamma(a+1) = a Gamma(a) leads there. */
static double log_gamma_times(double a, double *product)
{
    const double half_log_2_pi = 0.91893853320467274;
    *product = 1;
    for (; a < 12; a++)
        *product *= a;
    double r = 1 / (a * a);
    double series = (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r / 1188)))) / a;
    return (a - 0.5) * m_log(a) - a + half_log_2_pi + series;
}

static double log_gamma(double a)
{
    double product, sum = log_gamma_times(a, &product);
    return sum - m_log(product);
}

/* P(a,x) for x < a + 1: x^a e^-x / Gamma(a+1) * sum of x^k / ((a+1)...(a+k)). */
static double gamma_p_series(double a, double x)
{
    double term = 1, sum = 1;
    for (int k = 1; k < MAX_TERMS && term > sum * DBL_EPSILON; k++) {
        term *= x / (a + k);
        sum += term;
    }
    return sum * m_exp(a * m_log(x) - x - log_gamma(a + 1));
}

/* One more term of a continued fraction ... b + numerator / (...): the factor by which its value changes. */
static double lentz_step(double numerator, double b, double *c, double *d)
{
    *d = numerator * *d + b;
    *c = b + numerator / *c;
    *d = 1 / (fabs(*d) < TINY ? TINY : *d);
    *c = fabs(*c) < TINY ? TINY : *c;
    return *d * *c;
}

/* Q(a,x) for x >= a + 1, by the continued fraction 1/(x+1-a - 1(1-a)/(x+3-a - 2(2-a)/(x+5-a - ...))). */
static double gamma_q_fraction(double a, double x)
{
    double b = x + 1 - a, c = 1 / TINY, d = 1 / b, value = d;
    for (int k = 1; k < MAX_TERMS; k++) {
        b += 2;
        double step = lentz_step(-k * (k - a), b, &c, &d);
        value *= step;
        if (fabs(step - 1) < DBL_EPSILON)
            break;
    }
    return value * m_exp(a * m_log(x) - x - log_gamma(a));
}

double stats_gamma_q(double a, double x)
{
    if (x <= 0)
        return 1;
    if (isinf(x) || isnan(x))
        return isnan(x) ? x : 0;
    return x < a + 1 ? 1 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

/* The continued fraction of I_x(a,b) without its factor x^a (1-x)^b / (a B(a,b)); converges fast for
 * x < (a+1)/(a+b+2). */
static double beta_fraction(double a, double b, double x)
{
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < TINY ? TINY : d);
    double value = d;
    for (int k = 1; k < MAX_TERMS; k++) {
        double even = k * (b - k) * x / ((a + 2 * k - 1) * (a + 2 * k));
        double odd = -(a + k) * (a + b + k) * x / ((a + 2 * k) * (a + 2 * k + 1));
        value *= lentz_step(even, 1, &c, &d);
        double step = lentz_step(odd, 1, &c, &d);
        value *= step;
        if (fabs(step - 1) < DBL_EPSILON)
            break;
    }
    return value;
}

double stats_beta_i(double a, double b, double x)
{
    if (x <= 0 || isnan(x))
        return isnan(x) ? x : 0;
    if (x >= 1)
        return 1;
    double of_sum, of_a, of_b; /* one logarithm for the three */
    double gammas = log_gamma_times(a + b, &of_sum) - log_gamma_times(a, &of_a) - log_gamma_times(b, &of_b);
    double front = m_exp(gammas + m_log(of_a * of_b / of_sum) + a * m_log(x) + b * m_log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(a, b, x) / a;
    return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

/* --- p-values ---------------------------------------------------------------------------------------- */

double stats_normal_p(double z) { return stats_gamma_q(0.5, z * z / 2); }

double stats_student_p(double t, double dof)
{
    if (isinf(t))
        return 0;
    return stats_beta_i(dof / 2, 0.5, dof / (dof + t * t));
}

double stats_fisher_p(double ratio, double a, double b)
{
    return isinf(ratio) ? 0 : stats_beta_i(b / 2, a / 2, b / (b + a * ratio));
}

double stats_chi2_p(double x, double dof) { return stats_gamma_q(dof / 2, x / 2); }

struct count_pair {
    double observed, expected;
    size_t at;
};

/* Equals in the order they came in, for which not every qsort cares. */
static int by_expectation(const void *a, const void *b)
{
    const struct count_pair *x = a, *y = b;
    if (x->expected != y->expected)
        return x->expected < y->expected ? -1 : 1;
    return x->at < y->at ? -1 : x->at > y->at;
}

/* Pearson's sum over the cells, sorted by expectation, after pooling; *n_pooled receives the number of pools. */
static double pearson(const struct count_pair *cell, size_t n, size_t *n_pooled)
{
    const double least = 5; /* expectation below which a cell's share is far from chi-square distributed */
    double sum = 0;
    *n_pooled = 0;
    for (size_t i = 0; i < n;) {
        struct count_pair pool = cell[i++];
        while (i < n && pool.expected < least) {
            pool.observed += cell[i].observed;
            pool.expected += cell[i++].expected;
        }
        double d = pool.observed - pool.expected;
        sum += d * d / pool.expected;
        ++*n_pooled;
    }
    return sum;
}

double stats_chi2_test(const double *observed, const double *expected, size_t n)
{
    struct count_pair *cell = mem_alloc(n, sizeof *cell);
    size_t used = 0;
    double impossible = 0;
    for (size_t i = 0; i < n; i++) {
        if (!(expected[i] <= 0)) {
            cell[used].observed = observed[i];
            cell[used].expected = expected[i];
            cell[used].at = i;
            used++;
        } else {
            impossible += fabs(observed[i]);
        }
    }
    qsort(cell, used, sizeof *cell, by_expectation);
    size_t pools;
    double sum = pearson(cell, used, &pools);
    free(cell);
    if (impossible > 0)
        return 0;
    return pools < 2 || isnan(impossible) ? NAN : stats_chi2_p(sum, (double)(pools - 1));
}

double stats_welch_p(double mean1, double var1, double n1, double mean2, double var2, double n2)
{
    double e1 = var1 / n1, e2 = var2 / n2; /* squared standard errors of the two means */
    if (e1 + e2 == 0 && isfinite(mean1 - mean2))
        return mean1 == mean2 ? 1 : 0;
    double t = (mean1 - mean2) / sqrt(e1 + e2);
    /* Welch-Satterthwaite, with the shares of the error so that tiny variances do not underflow. */
    double s1 = e1 / (e1 + e2), s2 = e2 / (e1 + e2);
    double dof = 1 / (s1 * s1 / (n1 - 1) + s2 * s2 / (n2 - 1));
    return stats_student_p(t, dof);
}

/* Two series, each fast where it is used [Marsaglia 2003]. */
double stats_kolmogorov_p(double x)
{
    double sum = 0;
    if (x < 0.1)
        return 1;
    if (x < 1.18) {
        for (int j = 1; j <= 5; j += 2)
            sum += m_exp(-(j * j) * PI * PI / (8 * x * x));
        return 1 - sqrt(2 * PI) / x * sum;
    }
    for (int j = 1; j <= 8; j++)
        sum += (j % 2 == 1 ? 2 : -2) * m_exp(-2.0 * j * j * x * x);
    return sum;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    if (isnan(x) || isnan(y))
        return (isnan(x) != 0) - (isnan(y) != 0);
    return (x > y) - (x < y);
}

void stats_sort(double *x, size_t n) { qsort(x, n, sizeof *x, by_value); }

double stats_median(double *x, size_t n)
{
    stats_sort(x, n);
    return n % 2 == 1 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

double stats_ks_distance(double *x, size_t n)
{
    double d = 0, count = (double)n;
    stats_sort(x, n);
    for (size_t i = 0; i < n; i++) {
        d = most_of(d, x[i] - (double)i / count);
        d = most_of(d, (double)(i + 1) / count - x[i]);
    }
    return d;
}

double stats_ks_uniform_p(double *x, size_t n)
{
    if (n == 0)
        return NAN;
    double root = sqrt((double)n); /* the bracket is Stephens's correction for small n [Stephens 1970] */
    return stats_kolmogorov_p(stats_ks_distance(x, n) * (root + 0.12 + 0.11 / root));
}

double stats_sidak(double p, double m) { return 0 - m_expm1(m * m_log1p(-p)); } /* never -0 */
