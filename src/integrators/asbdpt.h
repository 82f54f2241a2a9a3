/* asbdpt.h: Alias Sampled Bidirectional Path Tracing, the integrator; its ways of selection are in select.h.
 * Tests: test_asbdpt.c. */
#ifndef ASBDPT_ASBDPT_H
#define ASBDPT_ASBDPT_H

#include "integrators/integrator.h"

extern const struct integrator integrator_asbdpt;

/* asbdpt_learnt: what a prepared asbdpt knows of places, with a table of pairs; NULL if its selection has none.
 *   state  of struct preparation; remains the owner */
const struct learnt *asbdpt_learnt(const void *state);

#endif
