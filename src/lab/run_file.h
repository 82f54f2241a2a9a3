/* run_file.h: the measurements of one run (scene, variant, seed) and the small file that keeps them.
 *
 * An experiment writes one such file per finished run and reads it back when it is started again, so that nothing
 * is computed twice. The file's first line is a key that says everything the numbers depend on; another key means
 * another experiment, and the file is not used.
 *
 * Used by: experiment, results. Tests: test_report.c.
 */
#ifndef ASBDPT_RUN_FILE_H
#define ASBDPT_RUN_FILE_H

#include <stdbool.h>

#include "base/error.h"
#include "lab/plan.h"

/* Measured after `spp` samples per pixel, against the reference. */
struct run_step {
    long spp;
    double seconds;    /* of CPU so far, pre-pass included, scene loading not */
    double rmse;       /* linear */
    double rmse8;      /* 8-bit sRGB */
    double relmse;     /* relative squared error */
    double mean_error; /* mean of image over mean of reference, less 1 */
    double mean_noise; /* its standard error, were pixels independent; NaN if unknown */
    long nonfinite;    /* values that could not be compared */
};

struct run {
    struct run_step step[PLAN_MAX_STEPS]; /* [n] */
    int n;                                /* 0: not done */
};

/* run_write: all or nothing. Returns false with a message. */
bool run_write(const char *path, const char *key, const struct run *run, struct error *err);

/* run_read: returns false, without a message, when there is no such file, its key differs or it is damaged; the run
 * must then be done again. */
bool run_read(const char *path, const char *key, int n_steps, struct run *out);

#endif
