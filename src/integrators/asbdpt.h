/* asbdpt.h: Alias Sampled Bidirectional Path Tracing, the method; its ways of selection are in select.h.
 * Used by: methods. Tests: test_asbdpt.c. */
#ifndef ASBDPT_ASBDPT_H
#define ASBDPT_ASBDPT_H

#include "integrators/method.h"

extern const struct method method_asbdpt;

#endif
