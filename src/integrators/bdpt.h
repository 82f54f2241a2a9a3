/* bdpt.h: Veach's bidirectional path tracing, and its two halves, path tracing and light tracing.
 *
 * All three walk the same sub-paths; they differ in the strategies they use, which is to say in their sample counts
 * (mis.h).
 *
 * Tests: test_render.c (they agree with each other and with analytic scenes).
 */
#ifndef ASBDPT_BDPT_H
#define ASBDPT_BDPT_H

#include "integrators/integrator.h"

extern const struct integrator integrator_pt, integrator_lt, integrator_bdpt;

#endif
