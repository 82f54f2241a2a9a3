/* equal_run.h: render every scene by every integrator in the same CPU time.
 *
 * Per scene and seed bdpt comes first and its time is what the others are given, or all are given as many seconds as
 * were asked for. A variant renders 4 samples per pixel, by which its samples are chosen; it renders them, and unless
 * that took the given time within 3 %, it renders again with the samples corrected, at most three times. The render
 * whose time is nearest counts. No choice looks at an error. One thread; times are CPU times of the process.
 *
 * Tests: test_equal_time.c, test/cli.sh.
 */
#ifndef ASBDPT_EQUAL_RUN_H
#define ASBDPT_EQUAL_RUN_H

#include "lab/equal_time.h"

/* equal_run: carry out out->plan, whose width 0 stands for the size of each scene's stored reference and whose
 * max_depth 0 for that reference's. Both files are written after each scene. `out` is to be released with equal_free
 * also on failure. Returns false with a message. */
bool equal_run(struct equal_time *out, struct error *err);

#endif
