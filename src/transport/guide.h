/* guide.h: which lights, and which parts of the sky, do the surfaces of a region actually see?
 *
 * s = 1 connects an eye vertex to a point on a light. Choosing the light by power alone wastes most shadow rays where
 * walls stand between, and an environment map seen through a window is mostly hidden. The pre-pass tries light points
 * from eye vertices and adds up, per region of space and per light cell (light.h), the contributions that arrived.
 * Each region then has an alias table over all light cells,
 *     q(c) = delta e(c) + (1 - delta) (N t(c) + K t_all(c)) / (N + K),
 * e being the choice by power, t the region's shares after N contributions, t_all those of the whole scene (a region
 * seldom visited relies on it). The first term, a defensive mixture [Hesterberg 1995], keeps every light within reach;
 * how N and K share the second is ours.
 *
 * Frozen after the pre-pass, so any choice is unbiased; MIS needs the ratio of the two choices, guide_ratio, as the
 * count of strategy s = 1 (mis.h): its samples are that many times denser than those of emission.
 *
 * Used by: connect, path, prepass. Tests: test_asbdpt.c, test_mis.c.
 */
#ifndef ASBDPT_GUIDE_H
#define ASBDPT_GUIDE_H

#include "base/alias.h"
#include "base/grid.h"
#include "scene/light.h"

/* What the pre-pass has found so far, per region. */
struct guide_lessons {
    const struct light_set *lights;
    struct grid grid;
    double *arrived; /* [grid.n * n_cells] sums of contributions (luminance), owned */
    double *samples; /* [grid.n] number of contributions other than zero, owned */
    size_t arrived_capacity, samples_capacity;
};

/* guide_lessons_init: `cells` regions along the scene's diameter. */
void guide_lessons_init(struct guide_lessons *l, const struct light_set *lights, int cells);
void guide_lessons_free(struct guide_lessons *l);

/* guide_lessons_add: a light point of `cell` brought `value` >= 0 to a vertex of the region. */
void guide_lessons_add(struct guide_lessons *l, uint64_t key, int cell, double value);

/* guide_key: the region of a surface point with unit geometric normal ng. */
uint64_t guide_key(const struct grid *grid, vec3 p, vec3 ng);

/* The frozen tables. */
struct guide {
    struct grid grid;
    struct alias_table *table; /* [grid.n], over all light cells; owned */
};

/* guide_build: make the tables from the lessons, with `delta` in (0,1].
 *   g  zero-initialised or built before; guide_free releases it */
void guide_build(struct guide *g, const struct guide_lessons *l, double delta);
void guide_free(struct guide *g);

/* guide_table: the choice of light cells at a surface point; the lights' own where nothing is known or g is NULL. */
const struct alias_table *guide_table(const struct guide *g, const struct light_set *lights, vec3 p, vec3 ng);

/* guide_ratio: density of y0 under guided choice over that under the choice by power.
 *   table  from guide_table for the surface point that y0 is connected to
 *   cell   of y0; -1 for a direction met by an escaping ray
 *   w      lights at infinity: unit direction towards the light
 * Returns 0 when the choice by power could not draw y0. */
double guide_ratio(const struct light_set *lights, const struct alias_table *table, int cell, vec3 w);

#endif
