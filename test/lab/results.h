/* results.h: the measurements of an experiment in memory and in files, and the statistics over its seeds.
 *
 * Every number shown anywhere (tables, plots, CSV) comes from the functions here. On disk there are
 *     runs/SCENE--METHOD--seedN.csv
 *                   one run, written when it is finished, read back when the experiment is started again; its first
 *                   line is a key that says everything the numbers depend on
 *     results.csv   one line per scene, method and number of samples: means over seeds with standard errors, ratios
 *                   to the first method with 95 % intervals; empty where unknown
 *     runs.csv      one line per scene, method, seed and number of samples: what was measured
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_RESULTS_H
#define ASBDPT_RESULTS_H

#include <stdio.h>

#include "lab/plan.h"
#include "lab/reference.h"

enum quantity {
    Q_SECONDS,    /* of CPU so far, pre-pass included, scene loading not */
    Q_RMSE,       /* linear */
    Q_RMSE8,      /* 8-bit sRGB */
    Q_RELMSE,     /* relative squared error */
    Q_BLOCKS,     /* the same of means over blocks of 8x8 pixels, see compare_blocks */
    Q_MEAN_ERROR, /* mean of image over mean of reference, less 1 */
    N_QUANTITIES
};

/* Measured after `spp` samples per pixel, against the reference. */
struct run_step {
    long spp;
    double value[N_QUANTITIES];
    long nonfinite; /* values that could not be compared */
};

/* What one seed of a method brought: a whole convergence curve. */
struct seed_run {
    struct run_step step[PLAN_MAX_STEPS]; /* [n] */
    int n;                                /* 0: not done */
};

struct scene_results {
    const struct plan *plan; /* borrowed */
    const char *path;
    char name[256];
    int width, height, max_depth;
    struct reference reference;
    struct seed_run run[METHODS_MAX][PLAN_MAX_SEEDS]; /* the first plan_seeds() of each */
    float *image[METHODS_MAX];                        /* of what is compared: first seed, all samples; owned */
};

struct results {
    const struct plan *plan;     /* borrowed */
    struct scene_results *scene; /* [plan->n_scenes], owned */
};

void results_free(struct results *r);

/* run_write: all or nothing. Returns false with a message. */
bool run_write(const char *path, const char *key, const struct seed_run *run, struct error *err);

/* run_read: returns false, without a message, when there is no such file, its key differs or it is damaged; the run
 * must then be done again. */
bool run_read(const char *path, const char *key, int n_steps, struct seed_run *out);

void results_csv(FILE *f, const struct results *r);
void results_runs_csv(FILE *f, const struct results *r);

/* A mean over seeds. */
struct estimate {
    double mean, error; /* standard error of the mean; NaN for fewer than two seeds */
    int n;              /* seeds; 0: mean is NaN */
};

struct estimate results_mean(const struct scene_results *s, int method, int step, enum quantity q);

/* A ratio of two means with its 95 % confidence interval; NaN where it cannot be told. */
struct interval {
    double value, low, high;
};

/* results_ratio: mean of a[na] over mean of b[nb], both independent and positive on average. The interval is Welch's,
 * on the logarithm of the ratio. */
struct interval results_ratio(const double *a, int na, const double *b, int nb);

/* results_rmse_ratio: rmse8 of a method over the first one's after the same number of samples, the dissertation's
 * comparison. results_cost_ratio: the same of squared error times seconds, (MSE - noise^2) T: what a method pays for
 * the inverse of its variance, as the squared error falls as one over the time; noise8 of the reference is subtracted
 * if known. */
struct interval results_rmse_ratio(const struct scene_results *s, int method, int step);
struct interval results_cost_ratio(const struct scene_results *s, int method, int step);

/* results_bias_p: p-value of "the signed mean error is 0" by Student's t, from the seeds' scatter and the error of the
 * reference's mean. (The variances of pixels over samples are no estimate of it: samples that are spread evenly err
 * together several times less.) NaN for one seed. */
double results_bias_p(const struct scene_results *s, int method, int step);

/* student_quantile: x with P(|t| > x) = p for Student's t, 0 < p < 1. */
double student_quantile(double p, double dof);

#endif
