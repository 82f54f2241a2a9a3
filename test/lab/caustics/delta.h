/* delta.h: where mirrors and smooth glass send what comes, and the densities of the other walk.
 *
 * Tests: test_bsdf.c, test_caustic.c.
 */
#ifndef CAUSTICS_DELTA_H
#define CAUSTICS_DELTA_H

#include "transport/vertex.h"

/* bsdf_delta: what the delta lobes send to one side: in the direction of the mirror, or of refraction. As bsdf_sample
 * returns it, but that f is the coefficient of the delta itself, of all lobes with that direction.
 * Returns false if there are none, or nothing is sent. */
bool bsdf_delta(const struct bsdf *b, vec3 wo, bool transmit, enum transport mode, struct bsdf_sample *out);

/* vertex_pdf_rev: density, 1/sr, with which a walk that comes from the next vertex of a sub-path would leave v for the
 * vertex before it. If a delta lobe sent the walk on, that is relative to the walk's own density, as mis.h needs it.
 *   mode  of the sub-path */
double vertex_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode);

#endif
