/* experiment.h: carry out a plan: render everything, measure, keep what was measured.
 *
 * In plan->directory it keeps
 *     runs/SCENE--METHOD--seedN.csv    one finished run, see results.h
 *     images/SCENE-METHOD.pfm          the picture of a method's first seed after all samples
 *     reference/SCENE.{pfm,txt}        a reference made here
 * and uses them again when started once more with the same plan, so that an interrupted experiment goes on where it
 * stopped. A scene or program that renders another picture begins anew; one that is only faster does not notice, so
 * delete runs/ to measure times again. One run accumulates its samples in one film, so that it yields a whole
 * convergence curve.
 *
 * Tests: test_report.c (a resumed experiment gives the same results).
 */
#ifndef ASBDPT_EXPERIMENT_H
#define ASBDPT_EXPERIMENT_H

#include "lab/results.h"

/* experiment_run: fill `out`, to be released with results_free also on failure. Seeds are plan_seed's. Returns false
 * with a message. */
bool experiment_run(const struct plan *plan, struct results *out, struct error *err);

#endif
