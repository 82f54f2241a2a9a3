/* emission.h: light sub-paths start in directions that lead to places where the camera can use light.
 *
 * Emission by power chooses a light cell c with probability e(c), a point of the cell, and with two uniform numbers u
 * the ray: its direction, or for lights at infinity its origin on a disk. Most of these rays lead to places that do not
 * contribute to the image. Learning traces some rays and computes the worth of each,
 *     I = sum over its vertices of luminance(beta) E                   (importance.h),
 * where the first vertex counts less (light_pass.c). It adds up the worths by cell and by bin b: the square of u has
 * SIDE x SIDE bins. From then on
 *     q(c,b) = delta e(c) / B + (1 - delta) t(c,b),   t ~ e(c) / B sqrt(mean of I^2),   B = SIDE SIDE,
 * chooses cell and bin, and u is uniform in its bin. The square root minimises the variance of the sum of I. The mean
 * of a bin with few rays is regularised towards that of four times as many bins, and so on up to the cell and the
 * scene:
 *     m = (sum of I^2 + K m_above) / (n + K).
 * The density of a ray is then rho = B q / e times that of light.h. rho is a function of the cell and of u, not of the
 * point of the cell.
 *
 * The table does not change during the render, so every table is unbiased, and the weights use rho (emit.h). If there
 * are more than EMISSION_COLUMNS cells, they share columns. Column, row, bin and cell are drawn in this order by
 * inversion, which keeps strata.
 * [Grittmann 2018] has such tables for photons. To learn squares is from [Rath 2020].
 *
 * Tests: test_emission.c, test_mis.c, test_learning.c.
 */
#ifndef ASBDPT_TABLES_EMISSION_H
#define ASBDPT_TABLES_EMISSION_H

#include "tables/columns.h"

enum { EMISSION_COLUMNS = 1024, EMISSION_SIDE = 8, EMISSION_BINS = EMISSION_SIDE * EMISSION_SIDE };

/* Sums while learning. */
struct emission_sums {
    struct light_columns columns;
    double *square; /* [columns.n * EMISSION_BINS] sums of I^2, owned */
};

/* emission_sums_init: start with zeros; emission_build releases the sums. */
void emission_sums_init(struct emission_sums *s, const struct light_set *lights);

/* emission_sums_add: a ray that light_sample_emission drew with u from a point of `cell` was worth I >= 0. */
void emission_sums_add(struct emission_sums *s, int cell, const double u[2], double I);

/* The frozen table. */
struct emission {
    struct light_columns columns;
    double *q;      /* [columns.n * EMISSION_BINS], > 0 in columns of power > 0; NULL: the table is empty; owned */
    double *before; /* [columns.n + 1], cumulative sums of q over the columns; owned */
};

/* emission_build: the table from `rays` rays that were drawn by power; `delta` is in (0,1]. emission_free releases
 * it. */
struct emission emission_build(struct emission_sums *s, double rays, double delta);
void emission_free(struct emission *e);

/* emission_draw: draw a light cell with the uniform number u, and the numbers for light_sample_emission. The scene must
 * have a light.
 *   direction  in: uniform in [0,1)^2; out: the point of the square of u
 *   rho        out: > 0 */
int emission_draw(const struct emission *e, const struct light_set *lights, double u, double direction[2],
                  double *rho);

/* emission_density: rho of the ray of direction w through p that leaves y0; 0 if emission by power cannot make it.
 *   y0  if y0->light is -1: all infinite lights together, in direction y0->w: the sum of their densities over the sum
 *       of their densities by power */
double emission_density(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p,
                        vec3 w);

#endif
