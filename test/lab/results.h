/* results.h: the measurements of an experiment in memory and in files, and the statistics over its seeds.
 *
 * Every number shown anywhere (tables, plots, CSV, sentences) comes from the functions here. On disk there are
 *     runs/SCENE--VARIANT--seedN.csv
 *                   one run, written when it is finished, read back when the experiment is started again; its first
 *                   line is a key that says everything the numbers depend on
 *     results.csv   one line per scene, variant and number of samples: means over seeds with standard errors, ratios
 *                   to BDPT with 95 % intervals; empty where unknown
 *     runs.csv      one line per scene, variant, seed and number of samples: what was measured
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
    Q_MEAN_ERROR, /* mean of image over mean of reference, less 1 */
    N_QUANTITIES
};

/* Measured after `spp` samples per pixel, against the reference. */
struct run_step {
    long spp;
    double value[N_QUANTITIES];
    long nonfinite; /* values that could not be compared */
};

/* What one seed of a variant brought: a whole convergence curve. */
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
    struct seed_run run[N_VARIANTS][PLAN_MAX_SEEDS]; /* the first plan_seeds() of each */
    float *image[N_COMPARED];                        /* first seed, all samples; owned */
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

struct estimate results_mean(const struct scene_results *s, int variant, int step, enum quantity q);

/* A ratio of two means with its 95 % confidence interval; NaN where it cannot be told. */
struct interval {
    double value, low, high;
};

/* results_ratio: mean of a[na] over mean of b[nb], both independent and positive on average. The interval is Welch's,
 * on the logarithm of the ratio. */
struct interval results_ratio(const double *a, int na, const double *b, int nb);

/* results_rmse_ratio: rmse8 of a variant over bdpt's after the same number of samples, the dissertation's
 * comparison. results_equal_time: squared error of a variant over bdpt's after the same CPU time, (MSE_v - noise^2)
 * T_v / ((MSE_b - noise^2) T_b), for bdpt's squared error is inversely proportional to its time; noise8 of the
 * reference is subtracted if known. */
struct interval results_rmse_ratio(const struct scene_results *s, int variant, int step);
struct interval results_equal_time(const struct scene_results *s, int variant, int step);

/* results_bias: the signed mean error with its standard error over seeds, as results_mean has them, and the p-value of
 * "it is 0" by Student's t, the error of the reference's mean added. (The variances of pixels over samples are no
 * estimate of it: samples that are spread evenly err together several times less.) NaN for one seed. */
struct bias {
    double mean, error, p;
};
struct bias results_bias(const struct scene_results *s, int variant, int step);

/* student_quantile: x with P(|t| > x) = p for Student's t, 0 < p < 1. */
double student_quantile(double p, double dof);

#endif
