/* bdpt.h: Veach's bidirectional path tracing, and its two halves, path tracing and light tracing.
 *
 * All three walk the same sub-paths; they differ in the strategies they use, which is to say in their sample counts
 * (mis.h).
 *
 * Used by: methods. Tests: test_render.c (they agree with each other and with analytic scenes).
 */
#ifndef ASBDPT_BDPT_H
#define ASBDPT_BDPT_H

#include "integrators/method.h"

extern const struct method method_pt, method_lt, method_bdpt;

#endif
