/* equal.h: methods after the same CPU time, by arithmetic.
 *
 * The first method has N samples per pixel, or all have as many seconds as were asked for. Time is counted in samples
 * of the first method: T = before_1 + N. A method that with a seed prepares for `before` and spends `each` per sample
 * (struct price) can afford n = (T - before) / each, and is rendered with the nearest whole number of samples. The
 * squared error of an unbiased method falls as 1 / samples, so at T it is that of the render times samples / n: only
 * the rounding. (A bias does not fall; half a sample of some dozen is not seen in it. At equal samples scenes do not
 * count where one of the two methods is marked.)
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_LAB_EQUAL_H
#define ASBDPT_LAB_EQUAL_H

#include "lab/results.h"

/* Intervals hold the truth 95 % of the time. That of one scene is results_ratio's, over seeds, whose prices are part of
 * what scatters. That of several is Student's, on the logarithms of the scenes' ratios, which scatter by seeds, by
 * prices and above all by scenes. Logarithms far from normal make it too narrow: of 11 scenes as skewed as
 * an exponential distribution it holds the truth in 90 %. */

/* equal_afforded: n; equal_samples: as rendered, at least 1.  seed: from 0 */
double equal_afforded(const struct scene_results *s, int method, int seed);
long equal_samples(const struct scene_results *s, int method, int seed);

/* equal_squares: of all seeds, the squared errors at T, or of one sample, into out [PLAN_MAX_SEEDS]; NaN where not even
 * one sample can be afforded. equal_ratio: their mean at T over that of another method, with the interval of
 * results_ratio. */
enum basis { AT_EQUAL_TIME, AT_EQUAL_SAMPLES };
extern const char *const EQUAL_NAMES[N_SQUARES]; /* mse8, relmse, 8x8: as tables call them */
void equal_squares(const struct scene_results *s, int method, enum square which, enum basis basis, double *out);
struct interval equal_ratio(const struct scene_results *s, int method, int over, enum square which);

/* equal_ends: the smallest and the largest ratio of a method over another, and their scenes; NaN and "-" if there is
 * none. */
struct equal_ends {
    double best, worst;
    const char *best_scene, *worst_scene;
};
struct equal_ends equal_ends(const struct results *r, int method, int over, enum square which);

/* equal_price: of a sample over one of the first, geometric mean over scenes and seeds. equal_spread: the largest ratio
 * of two seeds' prices of a method in a scene, less 1. */
double equal_price(const struct results *r, int method);
double equal_spread(const struct results *r);

/* equal_mean: the geometric mean over scenes of a method's ratio to another, with its interval. NaN where a scene has
 * no ratio.
 *   wanted  only scenes whose name begins so; NULL: all;  n  out: how many these are */
struct interval equal_mean(const struct results *r, int method, int over, enum square which, enum basis basis,
                           const char *wanted, int *n);

/* equal_over_best: the same of a method over the best of several in each scene, of those that have no mark there. For
 * each seed the other seeds say which is the best: a method that is chosen for its luck has less error than it will
 * have.
 *   others  [n_others] */
struct interval equal_over_best(const struct results *r, int method, const int *others, int n_others,
                                enum square which);

/* equal_verdict: is the first method beaten? A list: two lines for each other method, which say what would decide it if
 * that is undecided, and one. Before these a line for each scene where a method is marked, which has no gain. */
void equal_verdict(FILE *f, const struct results *r);

#endif
