/* ellipse.h: points by which light's way has a given length. See ellipse.c.
 *
 * Tests: test_rival_parts.c.
 */
#ifndef ASBDPT_ELLIPSE_H
#define ASBDPT_ELLIPSE_H

#include <stdbool.h>

#include "base/vec.h"

/* ellipse_draw: with the number u in [0,1) a point x of a triangle for which |y - x| + |x - z| = tau; *pdf: its density
 * per area if tau is uniform in an interval as long as `range`. False if there is none. */
bool ellipse_draw(vec3 y, vec3 z, const vec3 corner[3], double tau, double range, double u, vec3 *x, double *pdf);

#endif
