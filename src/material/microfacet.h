/* microfacet.h: the Trowbridge-Reitz ("GGX") distribution of microfacet normals.       [Trowbridge & Reitz 1975]
 *
 * All directions are unit and in the shading frame. Everything is even in w -> -w, so both sides of the surface
 * are served. alpha_x and alpha_y are the roughnesses along x and y, > 0.
 *
 * Tests: test_lobe.c.
 */
#ifndef ASBDPT_MICROFACET_H
#define ASBDPT_MICROFACET_H

#include "base/vec.h"

/* microfacet_d: area of the facets whose normal is wh, per area of surface and per steradian, 1/sr.
 * The integral of D(wh) |cos(wh)| over a hemisphere is 1. */
double microfacet_d(vec3 wh, double alpha_x, double alpha_y);

/* microfacet_lambda: area of the facets hidden from w per area of visible ones [Smith 1967] [Heitz 2014].
 * Seen from w a share 1/(1 + lambda(w)) is visible; from wo and wi together 1/(1 + lambda(wo) + lambda(wi)). */
double microfacet_lambda(vec3 w, double alpha_x, double alpha_y);

/* microfacet_sample: the normal, on wo's side, of a facet drawn from those that wo sees, by the area it sees of
 * them [Heitz 2018], in the form of [Dupuy & Benyoub 2023]. wo.z != 0, (u1,u2) uniform in [0,1)^2.
 * Its density is D(wh) dot(wo,wh) / ((1 + lambda(wo)) |cos(wo)|), 1/sr, where dot(wo,wh) > 0, else 0. */
vec3 microfacet_sample(vec3 wo, double alpha_x, double alpha_y, double u1, double u2);

#endif
