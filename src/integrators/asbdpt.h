/* asbdpt.h: Alias Sampled Bidirectional Path Tracing, the integrator; its ways of selection are in select.h.
 * Tests: test_asbdpt.c. */
#ifndef ASBDPT_ASBDPT_H
#define ASBDPT_ASBDPT_H

#include "integrators/integrator.h"

extern const struct integrator integrator_asbdpt;

#endif
