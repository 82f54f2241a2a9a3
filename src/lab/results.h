/* results.h: the measurements of an experiment in memory, and the statistics over its seeds.
 *
 * Every number shown anywhere (tables, plots, CSV, JSON, sentences) comes from the functions here.
 *
 * Used by: experiment (fills it), results_file, figures, tables, findings. Tests: test_report.c.
 */
#ifndef ASBDPT_RESULTS_H
#define ASBDPT_RESULTS_H

#include "lab/plan.h"
#include "lab/reference.h"
#include "lab/run_file.h"

struct scene_results {
    const char *path;
    char name[256];
    int width, height, max_depth;
    struct reference reference;
    struct run run[N_VARIANTS][PLAN_MAX_SEEDS]; /* the first plan_seeds() of each */
    float *image[N_METHODS];                    /* first seed, all samples; owned */
};

struct results {
    const struct plan *plan;     /* borrowed */
    struct scene_results *scene; /* [plan->n_scenes], owned */
};

void results_free(struct results *r);

/* A mean over seeds. */
struct estimate {
    double mean, error; /* standard error of the mean; NaN for fewer than two seeds */
    int n;              /* seeds; 0: mean is NaN */
};

enum quantity { Q_SECONDS, Q_RMSE, Q_RMSE8, Q_RELMSE, Q_MEAN_ERROR };

struct estimate results_mean(const struct scene_results *s, int n_seeds, int variant, int step, enum quantity q);

/* A ratio of two means with its 95 % confidence interval; NaN where it cannot be told. */
struct interval {
    double value, low, high;
};

/* results_ratio: mean of a[na] over mean of b[nb], both samples independent and positive on average. The interval
 * is Welch's, on the logarithm of the ratio. */
struct interval results_ratio(const double *a, int na, const double *b, int nb);

/* results_rmse_ratio: rmse8 of a variant over bdpt's after the same number of samples, the dissertation's
 * comparison. results_equal_time: squared error of a variant over bdpt's after the same CPU time, (MSE_m - noise^2)
 * T_m / ((MSE_b - noise^2) T_b), for bdpt's squared error is inversely proportional to its time; noise8 of the
 * reference is subtracted if known. */
struct interval results_rmse_ratio(const struct results *r, const struct scene_results *s, int variant, int step);
struct interval results_equal_time(const struct results *r, const struct scene_results *s, int variant, int step);

/* results_bias: the signed mean error with its whole standard error, and the p-value of "it is 0" by Student's t.
 * The method's share of the standard error is the larger of two: that over seeds, which are few, and that from the
 * variances of pixels, which takes them as independent. The reference's share is added. NaN for one seed. */
struct bias {
    double mean, error, p;
};
struct bias results_bias(const struct results *r, const struct scene_results *s, int variant, int step);

/* student_quantile: x with P(|t| > x) = p for Student's t, 0 < p < 1. */
double student_quantile(double p, double dof);

#endif
