/* guide.h: which lights, and which parts of the sky, do the surfaces of a region actually see?
 *
 * s = 1 connects an eye vertex to a point on a light. Choosing the light by power alone wastes most shadow rays where
 * walls stand between, and an environment map seen through a window is mostly hidden. The pre-pass tries light points
 * from eye vertices and adds up, per region of space and per light cell (light.h), the contributions that arrived.
 * Each region then has an alias table over all light cells,
 *     q(c) = delta e(c) + (1 - delta) (N t(c) + K t_all(c)) / (N + K),
 * e being the choice by power, t the region's shares after N contributions, t_all those of the whole scene (a region
 * seldom visited relies on it).
 *
 * Frozen after the pre-pass, so any choice is unbiased; MIS needs the ratio of the two choices, guide_ratio, as the
 * count of strategy s = 1 (mis.h): its samples are that many times denser than those of emission.
 *
 * Used by: connect, path, prepass. Tests: test_asbdpt.c, test_mis.c.
 */
#ifndef ASBDPT_GUIDE_H
#define ASBDPT_GUIDE_H

#include "alias.h"
#include "grid.h"
#include "light.h"

struct guide_region {
    double *arrived; /* [n_cells] sums of contributions; freed by guide_finish */
    double samples;  /* contributions other than zero */
    struct alias_table table;
};

struct guide {
    const struct light_set *lights;
    struct grid grid;
    struct guide_region *region; /* [grid.n], owned */
    size_t capacity;
};

/* guide_init: `cells` regions along the scene's diameter. */
void guide_init(struct guide *g, const struct light_set *lights, int cells);
void guide_free(struct guide *g);

/* guide_key: the region of a surface point with unit geometric normal ng. */
uint64_t guide_key(const struct guide *g, vec3 p, vec3 ng);

/* guide_add: a light point of `cell` brought `value` (luminance, >= 0) to a vertex of the region. */
void guide_add(struct guide *g, uint64_t key, int cell, double value);

/* guide_finish: make the tables, with `delta` in (0,1]; nothing may be added afterwards. */
void guide_finish(struct guide *g, double delta);

/* guide_table: the choice of light cells at a surface point; the lights' own where nothing is known or g is NULL. */
const struct alias_table *guide_table(const struct guide *g, const struct light_set *lights, vec3 p, vec3 ng);

/* guide_ratio: density of y0 under guided choice over that under the choice by power.
 *   table  from guide_table for the surface point that y0 is connected to
 *   cell   of y0; -1 for a direction met by an escaping ray
 *   w      lights at infinity: unit direction towards the light
 * Returns 0 when the choice by power could not draw y0. */
double guide_ratio(const struct light_set *lights, const struct alias_table *table, int cell, vec3 w);

#endif
