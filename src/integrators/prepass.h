/* prepass.h: the short pre-pass that learns where the camera can use light (importance.h) and which lights its paths
 * can see (guide.h), and then freezes both.
 *
 * Used by: asbdpt. Tests: test_asbdpt.c (same result for any number of threads, unbiased renders).
 */
#ifndef ASBDPT_PREPASS_H
#define ASBDPT_PREPASS_H

#include "transport/guide.h"
#include "integrators/importance.h"
#include "integrators/method.h"

/* prepass_run: trace eye sub-paths through the whole film, then light sub-paths for importance.mean.
 *   importance  initialised, or NULL
 *   guide       zero-initialised, or NULL
 * The result depends on job's scene, film, seed and depth, not on its threads. */
void prepass_run(const struct render_job *job, struct importance *importance, struct guide *guide);

#endif
