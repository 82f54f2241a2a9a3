/* delta.h: where mirrors and smooth glass send what comes.
 *
 * Tests: test_bsdf.c, test_caustic.c.
 */
#ifndef CAUSTICS_DELTA_H
#define CAUSTICS_DELTA_H

#include "material/bsdf.h"

/* bsdf_delta: what the delta lobes send to one side: in the direction of the mirror, or of refraction. As bsdf_sample
 * returns it, but that f is the coefficient of the delta itself, of all lobes with that direction.
 * Returns false if there are none, or nothing is sent. */
bool bsdf_delta(const struct bsdf *b, vec3 wo, bool transmit, enum transport mode, struct bsdf_sample *out);

#endif
