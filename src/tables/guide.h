/* guide.h: the lights, and the parts of the sky, that the surfaces of a region see.
 *
 * s = 1 connects an eye vertex to a point on a light. If walls are in between, a choice of the light by power alone
 * wastes most shadow rays, and most of an environment map is hidden behind a window's frame. Learning tries light
 * points from eye vertices. It adds up the contributions by region (regions.h) and by light cell (light.h). Each region
 * then has a table over all light cells,
 *     q(c) = delta e(c) + (1 - delta) t(c),      t(c) = (N own(c) + K above(c)) / (N + K).
 * e is the choice by power, `own` the shares of the region after N contributions, and `above` the t of the region that
 * contains it (for region 0 it is e). K = 8 is the number of contributions that `above` counts as. Cells are drawn by
 * inversion of cumulative sums, which keeps strata and low discrepancy.
 *
 * In a scene with more than GUIDE_COLUMNS light cells, consecutive cells form groups, and the choice within a group is
 * by power. This bounds the memory: 16 bytes for each column of each region.
 *
 * The tables do not change during the render, so every choice is unbiased. MIS needs the ratio of the two choices,
 * guide_density, as the count of strategy s = 1 (mis.h): the density of its samples over that of emission.
 *
 * Tests: test_asbdpt.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_GUIDE_H
#define ASBDPT_TABLES_GUIDE_H

#include "tables/columns.h"
#include "tables/regions.h"

enum { GUIDE_COLUMNS = 256 };

/* Sums while learning. */
struct guide_sums {
    struct light_columns columns;
    double *arrived; /* [regions->limit * (columns.n + 1)], for each region: the sums of contributions (luminance) by
                      * column, and then their number; owned */
};

/* guide_sums_init: start with zeros, with room for new regions; guide_build releases the sums. */
void guide_sums_init(struct guide_sums *s, const struct light_set *lights, const struct regions *regions);

/* guide_sums_add: a light point of `cell` contributed `value` > 0 to a vertex in the region, and in all regions
 * above. */
void guide_sums_add(struct guide_sums *s, const struct regions *regions, int region, int cell, double value);

/* The frozen tables. */
struct guide {
    struct light_columns columns;
    double *before; /* [n * (columns.n + 1)], for each region: cumulative probabilities of its columns; owned */
    int n;          /* regions; 0: the table is empty */
};

/* guide_build: the tables of these regions, with `delta` in (0,1]; guide_free releases them. */
struct guide guide_build(struct guide_sums *s, const struct regions *regions, double delta);
void guide_free(struct guide *g);

/* guide_draw: draw a light cell for an eye vertex of `region` with the uniform number u; *pmf is its probability.
 * Returns -1 if the scene has no light. */
int guide_draw(const struct guide *g, const struct light_set *lights, int region, double u, double *pmf);

/* guide_density: density of y0 by the guided choice over that by power; 0 if the latter is 0.
 *   region  of the surface point that y0 is connected to
 *   cell    of y0; -1 for a direction met by an escaping ray
 *   w       lights at infinity: unit direction towards the light */
double guide_density(const struct guide *g, const struct light_set *lights, int region, int cell, vec3 w);

#endif
