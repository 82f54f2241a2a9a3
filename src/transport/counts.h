/* counts.h: how many samples each kind of strategy takes, and how many these count as in the weights (mis.h).
 *
 *   s0    s = 0          the eye walk meets a light
 *   s1    s = 1          connection to a new point on a light
 *   pair  s >= 2, t >= 2 connection to a light vertex
 *   lens  s >= 2, t = 1  connection of a light vertex to the lens
 *
 * BDPT takes one sample of each, and of `lens` one for each pixel of the film. In general the number n of a strategy
 * for a path is a function of the two ends of the connecting edge: of which hit the eye vertex is, and of the places of
 * both (vertex.h). A walk that arrives at the second end knows both, so every strategy computes the same number for the
 * same path. Places count for methods that learn: these choose one place more often than another, by the *ratio* of a
 * table (table.h). Elsewhere it is 1: take it for 1 at a first reading.
 *
 * The balance heuristic compares second moments. Samples that are better distributed than independent ones have less
 * variance and deserve a higher count, a credit [Grittmann 2019]; the weights still add up to 1. Stratified draws have
 * the credit 2. Direct light at a first hit has 4, because the first numbers of an eye sub-path are stratified over the
 * iterations of a pixel (sampler.h). X being its contribution and V_N the variance of the mean of N samples, each
 * should count as E[X^2] / (N V_N). Where light sub-paths are rare (`every` below), so are splats of the same light,
 * which would be noise: there the credit is 4 times `every`.
 *
 * Draws from a pool (asbdpt.c, with a derivation) have a bound M: where few of its light vertices are useful, the same
 * ones are drawn again and again. Draws that would count as x samples of an endless pool count as x / (1 + x / M), less
 * than M; if they happen in one of `every` iterations, as x / every / (1 + x / M).
 */
#ifndef ASBDPT_COUNTS_H
#define ASBDPT_COUNTS_H

#include "tables/tables.h"
#include "transport/vertex.h"

/* Of methods whose parameter `credits` is on. */
enum { DIRECT_CREDIT = 4, PAIR_CREDIT = 2 };

/* How many samples a method takes, in each iteration of a pixel. */
struct numbers {
    int light_points;    /* points on lights that a first hit is joined to; a later hit is joined to one. 0: the method
                          * does not use the strategies of path tracing, s = 0 (t >= 3) and s = 1 */
    int draws[EYE_HITS]; /* light vertices, or sub-paths, that are drawn for an eye vertex; BDPT: its pixel's, once */
    int path_pixels;     /* pixels per light sub-path; 0: there are no light sub-paths */
    int every;           /* light sub-paths, and draws, happen in one of so many iterations of a tile, and count so
                          * many times. 0, 1: in each. A power of two */
};
static inline int numbers_every(const struct numbers *n) { return n->every > 1 ? n->every : 1; }

/* An eye sub-path alone; an eye sub-path, a light sub-path, and all connections between them. */
#define NUMBERS_OF_PT {.light_points = 1}
#define NUMBERS_OF_BDPT {.light_points = 1, .draws = {1, 1}, .path_pixels = 1}

/* What a method does, and counts in the weights. 0: it does not use the strategy.
 *
 * A light walk cannot know which hit its vertex would be, and takes every vertex for a later one. This is wrong
 * only at its last vertex if the lens is next (connect.c: light_side). Between any other first hit and the lens there
 * are delta lobes, where no strategy ends. */
struct counts {
    double s0[EYE_HITS];    /* t >= 3; by which hit z_{t-2} is */
    double s1[EYE_HITS];    /* times the ratio of tables->guide */
    double pair[EYE_HITS];  /* times the ratio of tables->pairs: x / every */
    double lens;            /* light sub-paths, those of all pixels of the film */
    const struct tables *tables;
    double bound[EYE_HITS]; /* times the ratio of tables->pairs: x / M, 0 without a bound */
    int light_points[EYE_HITS]; /* taken for s = 1 */
};

/* counts_of: what a method counts that takes these numbers of samples.
 *   direct  credit of direct light at a first hit: s = 1, and s = 0 if the edge before the light begins there
 *   draw    what a draw at ratio 1 counts as: its credit; of single vertices over N (asbdpt.c)
 *   M       bound of draws; 0: none
 *   pixels  of the film; a light sub-path may reach each of them */
struct counts counts_of(struct numbers n, double direct, const double draw[EYE_HITS], double M, double pixels,
                        const struct tables *tables);

/* n_of: n of the strategy that connects light vertex y and eye vertex z. It is a function of both alone.
 * n_if: the same as if z were that hit.
 * n_s1: n of s = 1, of an eye vertex in a region and a point of a light cell.
 * n_pair: n of s >= 2, t >= 2, of an eye vertex in region e and a light vertex in region l. */
static inline double n_s1(const struct counts *c, int region, enum eye_hit hit, int cell)
{
    return c->s1[hit] * table_ratio(&c->tables->guide, region, cell);
}
static inline double n_pair(const struct counts *c, int e, enum eye_hit hit, int l)
{
    double ratio = table_ratio(&c->tables->pairs, e, l);
    return c->pair[hit] * ratio / (1 + c->bound[hit] * ratio);
}
static inline double n_if(const struct counts *c, const struct vertex *y, const struct vertex *z, enum eye_hit hit)
{
    return z->kind == VERTEX_LENS    ? c->lens
           : y->kind == VERTEX_LIGHT ? n_s1(c, z->place, hit, y->place)
                                     : n_pair(c, z->place, hit, y->place);
}
static inline double n_of(const struct counts *c, const struct vertex *y, const struct vertex *z)
{
    return n_if(c, y, z, z->eye_hit);
}

#endif
