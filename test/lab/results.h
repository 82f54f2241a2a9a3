/* results.h: one table of runs: what was measured, in memory and as runs.csv, and the statistics over its seeds.
 *
 * Every number shown anywhere in a table is a query on this table. runs.csv has a line for each scene, method,
 * seed and number of samples: errors, squares, CPU time, price, and whether the method is marked. A number that is not
 * known is left out.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_RESULTS_H
#define ASBDPT_RESULTS_H

#include <stdio.h>

#include "lab/compare.h"
#include "lab/mark.h"
#include "lab/plan.h"
#include "lab/reference.h"

enum quantity {
    Q_SECONDS,    /* of CPU so far, pre-pass included, scene loading not */
    Q_RMSE8,      /* 8-bit sRGB */
    Q_MEAN_ERROR, /* mean of image over mean of reference, less 1 */
    N_QUANTITIES
};

/* Measured after `spp` samples per pixel; 0: not at all. The values are against the reference; the squares are the
 * squared errors of the picture itself, in two ways: against a reference, whose own noise is subtracted, which sees all
 * errors; or by pairs of renders with unlike seeds, whose half squared difference sees all but a bias, and needs no
 * reference.
 *     Of S seeds with half squared differences d_ij, V is the mean of all pairs, and seed i has
 *     V + 2 (S-1)/(S-2) (mean_j d_ij - V): these have the mean V and scatter as independent errors would.
 * A square may be below 0. */
struct run {
    long spp;
    double value[N_QUANTITIES], square[N_SQUARES];
    long nonfinite; /* values that could not be compared */
};

/* What a method costs with one seed, in CPU time of a sample of the first method, by medians over rounds in which both
 * were timed: what it prepares, and each sample per pixel. Seeds have prices of their own, since a method may choose by
 * its seed how it renders. */
struct price {
    double before, each;
};

struct scene_results {
    const struct plan *plan; /* borrowed */
    const char *path;
    char name[256];
    int width, height, max_depth;
    struct reference reference;
    const char *by;   /* the method that rendered it; NULL: it was stored, or given */
    bool lacks;       /* that one may not find all light: see reference_method */
    enum mark mark[METHODS_MAX]; /* after all samples */
    struct price price[METHODS_MAX][PLAN_MAX_SEEDS]; /* of equal time */
    double seconds; /* of equal time: CPU seconds of a sample of the first method */
    /* The first plan_seeds() and n_steps of each. At equal time the steps from 1 on are earlier numbers of samples of
     * the same render, for curves; some may be missing. */
    struct run run[METHODS_MAX][PLAN_MAX_SEEDS][PLAN_MAX_STEPS];
    float *image[METHODS_MAX]; /* [height*width*3] of the first seed, all samples; owned */
};

struct results {
    const struct plan *plan;     /* borrowed */
    struct scene_results *scene; /* [plan->n_scenes], owned */
};

void results_free(struct results *r);

/* results_pairs: the squares of n >= 3 seeds from their pairs, as above.
 *   half  [n*n] half squared differences, of which those next to the diagonal are read;  out  [n] */
void results_pairs(const double *half, int n, double *out);

/* results_by_pairs: are a method's squares by pairs? These see all the error of a method that has all light. Where
 * perhaps none has, or the first method is marked, all are against the reference: few seeds may not tell which of two
 * lacks the same light, and a ratio needs one way of measuring. */
bool results_by_pairs(const struct scene_results *s, int method);

/* results_doubt: variance of the logarithm of a method's mean square that its seeds do not show: the noise of the
 * reference has been subtracted, and that may be wrong by as much as it is. NaN where the noise is not known, or more
 * than what is left: then nothing can be told of the square. */
double results_doubt(const struct scene_results *s, int method, int step, enum square which);

/* results_square: the mean of a method's squares; NaN where nothing can be told of it. results_seconds: mean CPU
 * seconds, at equal time those that its prices say. */
double results_square(const struct scene_results *s, int method, int step, enum square which);
double results_seconds(const struct scene_results *s, int method, int step);

/* results_csv: runs.csv. */
void results_csv(FILE *f, const struct results *r);

/* A mean over seeds. */
struct estimate {
    double mean, error; /* standard error of the mean; NaN for fewer than two seeds */
    int n;              /* seeds; 0: mean is NaN */
};

/* results_mean: of a value. The error of Q_MEAN_ERROR has that of the reference's mean in it, if this is known. */
struct estimate results_mean(const struct scene_results *s, int method, int step, enum quantity q);

/* A ratio of two means with its 95 % confidence interval; NaN where it cannot be told. */
struct interval {
    double value, low, high;
};

/* results_marked: in how many scenes a method is marked. */
int results_marked(const struct results *r, int method);

/* results_write: what `write` writes, as a file of the plan's directory. False with a message. */
bool results_write(const struct results *r, const char *name, void (*write)(FILE *, const struct results *),
                   struct error *err);

/* results_ratio: mean of a[na] over mean of b[nb], both independent and positive on average. The interval is Welch's,
 * on the logarithm of the ratio.
 *   doubt  variance of that logarithm which seeds do not show: the sum of both methods' results_doubt; with NaN there
 *          is no ratio */
struct interval results_ratio(const double *a, int na, const double *b, int nb, double doubt);

/* results_mean_log: geometric mean of n numbers given by their logarithms, with Student's interval. */
struct interval results_mean_log(const double *log, int n);

/* results_over_first: a method over the first after the same number of samples: rmse8, the dissertation's comparison;
 * or squared error times seconds, the cost of the inverse of its variance, as the squared error falls as
 * one over the time. */
struct interval results_over_first(const struct scene_results *s, int method, int step, bool paid);

/* student_quantile: x with P(|t| > x) = p for Student's t, 0 < p < 1. */
double student_quantile(double p, double dof);

#endif
