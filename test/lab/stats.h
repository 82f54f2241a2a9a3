/* stats.h: distribution functions and hypothesis tests, the yardsticks of the test suite and of `compare`.
 *
 * Every test returns a p-value: the probability, were the hypothesis true, of data at least as extreme. With a NaN
 * among the data it is NaN, which does not agree and does not differ: say `p >= level` where agreement is wanted, `p <
 * level` where a difference is, and take the smallest of several with least_of (numbers.h). Tests: test_stats.c
 * (published tables).
 */
#ifndef ASBDPT_LAB_STATS_H
#define ASBDPT_LAB_STATS_H

#include <stddef.h>

/* stats_gamma_q: regularised upper incomplete gamma function Q(a,x), a > 0, x >= 0. */
double stats_gamma_q(double a, double x);

/* stats_beta_i: regularised incomplete beta function I_x(a,b), a,b > 0, x in [0,1]. */
double stats_beta_i(double a, double b, double x);

/* stats_normal_p: two-sided p-value of a standard normal deviate. */
double stats_normal_p(double z);

/* stats_student_p: two-sided p-value of Student's t with dof > 0 degrees of freedom (need not be an integer). */
double stats_student_p(double t, double dof);

/* stats_fisher_p: upper tail of Fisher's distribution: of a ratio of mean squares of a and b degrees of freedom. */
double stats_fisher_p(double ratio, double a, double b);

/* stats_chi2_p: upper tail of the chi-square distribution. */
double stats_chi2_p(double x, double dof);

/* stats_chi2_test: Pearson's test of observed counts against expected ones.
 *   observed, expected  [n], counts; the two sums should agree
 * Cells with an expectation below 5 are pooled, smallest first. A count in a cell of expectation 0 gives p = 0.
 * NaN when else fewer than two cells remain: nothing has been tested. */
double stats_chi2_test(const double *observed, const double *expected, size_t n);

/* stats_welch_p: two-sided p-value for equal means of two samples given by mean, variance of one observation
 * and count [Welch 1947]. Both variances 0: 1 if the means agree, else 0. */
double stats_welch_p(double mean1, double var1, double n1, double mean2, double var2, double n2);

/* stats_kolmogorov_p: Kolmogorov's limit distribution: the probability that sqrt(n) times the distance exceeds x. */
double stats_kolmogorov_p(double x);

/* stats_ks_distance: largest distance of the empirical distribution of n numbers from the uniform one on [0,1]; sorts
 * them. NaN if one of them is. */
double stats_ks_distance(double *x, size_t n);

/* stats_ks_uniform_p: Kolmogorov-Smirnov test that the n numbers are uniform on [0,1]; sorts them. NaN for n = 0. */
double stats_ks_uniform_p(double *x, size_t n);

/* stats_sidak: the probability that the least of m independent p-values is p or less [Sidak 1967]. With 1 / m instead
 * of m: the level of one of m tests that keeps the family at level p. */
double stats_sidak(double p, double m);

/* stats_sort: by rising value, NaN last. stats_median: of n >= 1 numbers, which it sorts. */
void stats_sort(double *x, size_t n);
double stats_median(double *x, size_t n);

#endif
