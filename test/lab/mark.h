/* mark.h: has a method the light of the reference? Tested before its errors are printed, for pairs of its own renders
 * see noise alone, not what all of them lack.
 *
 * Of S pictures and the reference means over blocks are taken (compare.h). In a block, D is the mean of the S less the
 * reference, v the variance of one of them and u that of the reference. Two tests are made, w being 1 / (r^2 + 0.01):
 *
 *     blocks  sum w D^2 over sum w (v / S + u), by Fisher's distribution
 *     mean    (sum D)^2 over sum (v / S + u), by Student's
 *
 * Degrees of freedom are Satterthwaite's, blocks being independent: the variance of the picture's mean over seeds has
 * been found to be that of independent blocks, in methods that share light sub-paths, too. Each test has a level that
 * keeps false marks of a whole measurement, of all methods in all scenes, below MARK_LEVEL. Where light is found
 * rarely few samples lack it more often than that; their errors against the reference are right all the same.
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_LAB_MARK_H
#define ASBDPT_LAB_MARK_H

#include "lab/reference.h"

#define MARK_LEVEL 0.01

/* MARK_DARK: it differs, and its mean is below the reference's; MARK_BIASED: it differs otherwise, or is not finite. */
enum mark { MARK_NONE, MARK_DARK, MARK_BIASED, N_MARKS };
extern const char *const MARKS[N_MARKS]; /* "", "misses light", "biased" */

/* What the tests say: MARK_NONE needs p >= level of both, which NaN is not. */
struct mark_tests {
    double blocks, mean; /* p-values */
    double t;            /* of the mean: below 0 is darker */
};

/* mark_tests: of n >= 2 pictures of the reference's size; its variance must be known. */
struct mark_tests mark_tests(float *const *picture, int n, const struct reference *r);

/* mark_of: the verdict in a measurement of so many methods in all, counted in each scene again. */
enum mark mark_of(struct mark_tests found, int methods);

#endif
