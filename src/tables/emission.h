/* emission.h: light sub-paths leave the lights where the camera can use them.
 *
 * Emission chooses a light cell c with probability e(c), by power, a point of it, and with two uniform numbers u the
 * ray: its direction, from lights at infinity its origin on a disk. Most of these rays go where no picture is. Learning
 * follows some and adds up what each was worth, I = sum over its vertices of luminance(beta) E (importance.h; the first
 * counts less, light_pass.c), by cell and by bin b of SIDE x SIDE in the square of u. From then on
 *     q(c,b) = delta e(c) / B + (1 - delta) t(c,b),   t ~ e(c) / B sqrt(mean of I^2),   B = SIDE SIDE,
 * chooses both, and u lies uniformly in its bin. That root makes the variance of the sum of I least; the mean of few
 * leans on that of four times as many bins, at last of the cell and of the scene:
 *     m = (sum of I^2 + K m_above) / (n + K).
 * The density of a ray is then rho = B q / e times that of light.h: of its cell and u; the point of the cell that it
 * leaves does not matter.
 *
 * The table is frozen before the render, so any is unbiased, and the weights know rho (emit.h). More than
 * EMISSION_COLUMNS cells share columns. Column, row, bin and cell are drawn in turn by inversion: strata remain strata.
 * [Grittmann 2018] has such tables for photons; that squares are to be learnt is from [Rath 2020].
 *
 * Tests: test_emission.c, test_mis.c, test_learning.c.
 */
#ifndef ASBDPT_TABLES_EMISSION_H
#define ASBDPT_TABLES_EMISSION_H

#include "tables/columns.h"

enum { EMISSION_COLUMNS = 1024, EMISSION_SIDE = 8, EMISSION_BINS = EMISSION_SIDE * EMISSION_SIDE };

/* What has been found so far. */
struct emission_sums {
    struct light_columns columns;
    double *square; /* [columns.n * EMISSION_BINS] sums of I^2, owned */
};

/* emission_sums_init: nothing yet; emission_build releases them. */
void emission_sums_init(struct emission_sums *s, const struct light_set *lights);

/* emission_sums_add: a ray that light_sample_emission drew with u from a point of `cell` was worth I >= 0. */
void emission_sums_add(struct emission_sums *s, int cell, const double u[2], double I);

/* The frozen table. */
struct emission {
    struct light_columns columns;
    double *q;      /* [columns.n * EMISSION_BINS], > 0 where the column's power is; NULL: nothing is known; owned */
    double *before; /* [columns.n + 1] sums of the columns before, and of all; owned */
};

/* emission_build: the table after `rays` rays, drawn by power, with `delta` in (0,1]; emission_free releases it. */
struct emission emission_build(struct emission_sums *s, double rays, double delta);
void emission_free(struct emission *e);

/* emission_draw: a light cell by the uniform number u, and what light_sample_emission is to be given. The scene has a
 * light.
 *   direction  in-out, [0,1)^2: uniform; where it lies in the square then
 *   rho        out: > 0 */
int emission_draw(const struct emission *e, const struct light_set *lights, double u, double direction[2],
                  double *rho);

/* emission_density: rho of the ray of direction w through p that leaves y0; 0 where emission by power makes none.
 *   y0  y0->light may be -1: of all infinite lights together, in the direction y0->w: the sum of densities over the
 *       sum of those by power */
double emission_density(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p,
                        vec3 w);

#endif
