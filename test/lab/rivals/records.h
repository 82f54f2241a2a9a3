/* records.h: places of a tile at which it is known what each light vertex of the pool is worth, for eye vertices nearby
 * to choose by: importance records, after [Georgiev 2012b].
 *
 * Records are the vertices of a few eye sub-paths of their own, through a coarse raster over the tile. For record c and
 * light vertex v of the pool
 *     h_c(v) = L_v luminance(f_v towards c) G(v,c) Vis(v,c),    PMF_c(v) = h_c(v) / sum h_c,
 * the BSDF at the record being left out, since at the eye vertex it is another. They see what a choice by power does
 * not: cosine, distance, and visibility; they cost a shadow ray for every pair of a record and a vertex.
 *
 * Tests: test_rivals.c.
 */
#ifndef ASBDPT_RECORDS_H
#define ASBDPT_RECORDS_H

#include "integrators/loop.h"

enum { RECORDS_NEAR = 3, RECORDS_DEPTH = 5, RECORDS_TILE = MAX_TILE_SIZE };
#define RECORDS_SHARE 0.004 /* of the pixels have a record's eye sub-path */

struct record {
    struct vertex z;
    double sum;           /* of h over the light vertices */
    double expected;      /* of that over one light sub-path; set by the caller that needs it */
    const double *h;      /* [V] */
    const double *before; /* [V] sum of h before each */
};

struct records {
    struct record *item; /* [n] */
    int n;
};

/* records_place: where the records of an iteration are, of eye sub-paths through a share of the tile's pixels; no
 * record's h is known yet. `arena` has all of it, as of what records_fill adds. */
struct records records_place(const struct prepared *p, const struct tile_pass *pass, struct arena *arena,
                             long iteration, double share);

/* records_fill: h of all records for these n light vertices; u: [n] factors of L_v, or NULL. */
void records_fill(struct records *r, struct arena *arena, const struct scene *scene, const struct vertex *const *found,
                  int n, const double *u);

/* record_worth: h of one light vertex, which light reaches from wo, as if it and the record saw each other, over L_v;
 * record_sees: do they? */
double record_worth(const struct record *c, const struct scene *scene, const struct vertex *v, vec3 wo);
bool record_sees(const struct record *c, const struct scene *scene, const struct vertex *v);

/* records_near: the nearest records to an eye vertex into near [RECORDS_NEAR], nearest first; returns how many there
 * are. Distances squared grow by `normals` times the scene's diagonal squared times 1 - cosine of the normals. */
int records_near(const struct records *r, const struct scene *scene, const struct vertex *z, double normals, int *near);

/* What an eye vertex draws from: m of its nearest records, and the uniform choice. records_mixture: with those that met
 * no light (blind) or without. */
struct mixture {
    const struct record *record[RECORDS_NEAR];
    int m, V;
};
struct mixture records_mixture(const struct records *r, const struct scene *scene, const struct vertex *z,
                               double normals, bool blind, int V);

/* mixture_draw: a light vertex with the number u in [0,1); *which: by which record, m for none.
 * mixture_pmf: the probability of that, all taken together. */
int mixture_draw(const struct mixture *m, double u, int *which);
double mixture_pmf(const struct mixture *m, int v);

#endif
