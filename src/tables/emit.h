/* emit.h: how a light sub-path leaves its light: as in light.h, or by the table of emission.h. The table multiplies the
 * density of the ray, light_pdf_emission, by rho, and leaves the density of y_0 as it is. So p_i has the factor rho for
 * every i >= 2, but not for i = 0 and i = 1. The recursions of mis.h need no other change.
 *
 * Tests: test_mis.c.
 */
#ifndef ASBDPT_TABLES_EMIT_H
#define ASBDPT_TABLES_EMIT_H

#include "tables/emission.h"

/* emit_sample: draw a light point and a ray that leaves it.
 *   u          uniform: for the cell, then for the point in it
 *   direction  uniform: for the ray
 *   pdf        out: density of the ray's direction; for lights at infinity, of its origin
 *   pdf_mis    out: the same for the weights: the sum over all infinite lights, since an escaping ray meets all of them
 * Returns the value of light_sample_emission; black if there is no light point. */
rgb emit_sample(const struct emission *e, const struct light_set *lights, const struct geometry *geo, const double u[3],
                double direction[2], struct light_point *at, struct ray *ray, double *pdf, double *pdf_mis);

/* emit_pdf: density, for the weights, of the ray of direction w through p that leaves y0.
 *   y0  if y0->light is -1: all infinite lights together, in direction y0->w */
double emit_pdf(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p, vec3 w);

#endif
