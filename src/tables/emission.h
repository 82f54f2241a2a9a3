/* emission.h: how light sub-paths leave lights: by power, or by a table, towards places where the camera can use light.
 *
 * Emission by power chooses a light cell c with probability base(c), a point of the cell, and with a point of the unit
 * square the ray: its direction, or for lights at infinity its origin on a disk. The square is cut into SIDE x SIDE
 * leaves. A table (table.h) has one row and a column for each leaf of each cell, whose base is base(c) / LEAVES. Above
 * the leaves are 4 x 4 and 2 x 2 wider ones, the cell, and all cells. Learning traces rays, and squares the worth of
 * each [Rath 2020]: probabilities in proportion to the root of the mean square minimise the variance of the sum of
 * worths.
 *
 * A ray of the table has `ratio` times the density of light.h. The density of y_0 stays as it is. So p_i has the factor
 * `ratio` for every i >= 2, but not for i = 0 and i = 1, and the recursions of mis.h need no other change. The ratio is
 * a function of the cell and of the point of the square, not of the point on the light.  [Grittmann 2018] has such
 * tables for photons.
 *
 * Tests: test_emission.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_EMISSION_H
#define ASBDPT_TABLES_EMISSION_H

#include "scene/light.h"
#include "tables/table.h"

/* emission_axis_new: the tree of columns, and *base [n] of them. emission_axis_free releases both. */
struct axis emission_axis_new(const struct light_set *lights, double **base);
void emission_axis_free(struct axis *a, double *base);

/* emission_column: the column of a ray that emission by power draws from a cell with a point of the square.
 * emission_column_of: that of the ray of direction w through p that leaves y0. */
int emission_column(int cell, const double square[2]);
int emission_column_of(const struct light_set *lights, const struct light_point *y0, vec3 p, vec3 w);

/* emission_sample: draw a light point and a ray that leaves it.
 *   u          uniform: for the cell and leaf, then for the point
 *   direction  uniform: for the ray
 *   pdf        out: density of the ray's direction, 1/sr; for lights at infinity, of its origin, 1/m^2
 *   column     out: of the ray; 0 if there is no light
 * Returns the value of light_sample_emission; black if there is no light point. */
rgb emission_sample(const struct table *t, const struct light_set *lights, const struct geometry *geo,
                    const double u[3], const double direction[2], struct light_point *at, struct ray *ray, double *pdf,
                    int *column);

/* emission_pdf: that density for the ray of direction w through p that leaves y0. */
double emission_pdf(const struct table *t, const struct light_set *lights, const struct light_point *y0, vec3 p,
                    vec3 w);

#endif
