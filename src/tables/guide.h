/* guide.h: which lights, and which parts of the sky, do the surfaces of a region actually see?
 *
 * s = 1 connects an eye vertex to a point on a light. Choosing the light by power alone wastes most shadow rays where
 * walls stand between, and an environment map seen through a window is mostly hidden. Learning tries light points
 * from eye vertices and adds up, per region (regions.h) and per light cell (light.h), the contributions that arrived.
 * Each region then has a table over all light cells, from which they are drawn by cumulative sums, so that neighbours
 * stay neighbours and well-spread numbers are spread over the lights,
 *     q(c) = delta e(c) + (1 - delta) t(c),      t(c) = (N own(c) + K above(c)) / (N + K),
 * e being the choice by power, own the region's shares after N contributions, and above the t of the region that holds
 * it, at the top e. K = 8 contributions count as much as what is above.
 *
 * A scene with more than GUIDE_COLUMNS light cells is learnt in groups of consecutive cells; within a group the choice
 * is by power. So the memory is bounded, by 16 bytes for each of GUIDE_COLUMNS columns of each region.
 *
 * The tables are frozen before the render, so any choice is unbiased; MIS needs the ratio of the two choices,
 * guide_density, as the count of strategy s = 1 (mis.h): its samples are that many times denser than those of emission.
 *
 * Tests: test_asbdpt.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_GUIDE_H
#define ASBDPT_TABLES_GUIDE_H

#include "tables/columns.h"
#include "tables/regions.h"

enum { GUIDE_COLUMNS = 256 };

/* What has been found so far. */
struct guide_sums {
    struct light_columns columns;
    double *arrived; /* [regions->limit * (columns.n + 1)], per region: contributions (luminance) by column, and last
                      * how many there were; owned */
};

/* guide_sums_init: nothing yet, of regions known or to come; guide_build releases them. */
void guide_sums_init(struct guide_sums *s, const struct light_set *lights, const struct regions *regions);

/* guide_sums_add: a light point of `cell` brought `value` > 0 to a vertex of the region, and of all above. */
void guide_sums_add(struct guide_sums *s, const struct regions *regions, int region, int cell, double value);

/* The frozen tables. */
struct guide {
    struct light_columns columns;
    double *before; /* [n * (columns.n + 1)], per region: probability of the columns before, and of all; owned */
    int n;          /* regions; 0: nothing is known */
};

/* guide_build: the tables of these regions, with `delta` in (0,1]; guide_free releases them. */
struct guide guide_build(struct guide_sums *s, const struct regions *regions, double delta);
void guide_free(struct guide *g);

/* guide_draw: draw a light cell for an eye vertex of `region` with the uniform number u; *pmf is its probability.
 * Returns -1 if the scene has no light. */
int guide_draw(const struct guide *g, const struct light_set *lights, int region, double u, double *pmf);

/* guide_density: of y0 under guided choice, over that under the choice by power; 0 where the latter is 0.
 *   region  of the surface point that y0 is connected to
 *   cell    of y0; -1 for a direction met by an escaping ray
 *   w       lights at infinity: unit direction towards the light */
double guide_density(const struct guide *g, const struct light_set *lights, int region, int cell, vec3 w);

#endif
