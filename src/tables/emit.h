/* emit.h: how a light sub-path leaves its light: as light.h has it, or by the table of emission.h, which makes the
 * density of the ray rho times light_pdf_emission's. That of y_0 remains. So p_i has rho for every i >= 2, p_0 and
 * p_1 have it not, and the recursions of mis.h need no other change.
 *
 * Tests: test_mis.c.
 */
#ifndef ASBDPT_TABLES_EMIT_H
#define ASBDPT_TABLES_EMIT_H

#include "tables/emission.h"

/* emit_sample: draw a light point and a ray that leaves it.
 *   u        uniform: of the cell, then of the point in it. direction: uniform, of the ray
 *   pdf      out: density of the ray's direction, at infinity of its origin
 *   pdf_mis  out: the same as the weights have it: an escaping ray cannot tell infinite lights apart, so theirs add up
 * Returns what light_sample_emission does; black as well if there is no light point. */
rgb emit_sample(const struct emission *e, const struct light_set *lights, const struct geometry *geo, const double u[3],
                double direction[2], struct light_point *at, struct ray *ray, double *pdf, double *pdf_mis);

/* emit_pdf: density, for the weights, of the ray of direction w through p, given that y0 is where it leaves.
 *   y0  y0->light may be -1: an infinite light, any of them, in the direction y0->w */
double emit_pdf(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p, vec3 w);

#endif
