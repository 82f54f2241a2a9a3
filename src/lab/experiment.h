/* experiment.h: carry out a plan: render everything, measure, keep what was measured.
 *
 * In plan->directory it keeps
 *     runs/SCENE--VARIANT--seedN.csv   one finished run, see results.h
 *     images/SCENE-VARIANT.pfm         the picture of a variant's first seed after all samples
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
#include "scene/scene.h"

/* experiment_run: fill `out`, to be released with results_free also on failure. Seeds are plan_seed's; a reference
 * made here has 100001 and 100002. Returns false with a message. */
bool experiment_run(const struct plan *plan, struct results *out, struct error *err);

/* experiment_scene: a scene as experiments render it: whole, of this size, with a box filter, prepared.
 *   height     0: by the scene's aspect ratio
 *   max_depth  0: the scene's; *depth is the one in force
 * Returns false with a message, then nothing needs release. */
bool experiment_scene(const char *path, int width, int height, int max_depth, struct scene *scene, int *depth,
                      struct error *err);

/* experiment_planned_scene: the same at the plan's size and depth. Where the plan leaves the width open, size and depth
 * are those of the stored reference; without one it is WIDTH_WITHOUT_REFERENCE wide. */
enum { WIDTH_WITHOUT_REFERENCE = 48 };
bool experiment_planned_scene(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                              struct error *err);

/* experiment_directory: make a directory and those above it unless they are there. Returns false with a message. */
bool experiment_directory(const char *wanted, struct error *err);

#endif
