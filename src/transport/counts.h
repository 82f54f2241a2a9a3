/* counts.h: how many samples a strategy takes for a path (mis.h). The number n is a function of the two ends of the
 * connecting edge: a number of struct mis_counts times factors from tables for the places of the two ends (tables.h). A
 * walk that arrives at the second end knows both, so every strategy computes the same number for the same path.
 */
#ifndef ASBDPT_COUNTS_H
#define ASBDPT_COUNTS_H

#include "tables/tables.h"
#include "transport/vertex.h"

/* How many samples of each kind a method takes, in each iteration. */
struct numbers {
    int path_pixels;     /* pixels per light sub-path; 0: there are no light sub-paths */
    int draws[EYE_ENDS]; /* light vertices that an eye vertex is joined to; BDPT: all vertices of one sub-path, once */
    int light_points;    /* points on lights that a first hit is joined to; a later hit is joined to one */
    bool path_tracing;   /* does it use the strategies of path tracing, s = 0 (t >= 3) and s = 1? */
};

/* One eye sub-path, one light sub-path, and all connections between them. */
#define NUMBERS_OF_BDPT {.path_pixels = 1, .draws = {1, 1}, .light_points = 1, .path_tracing = true}

/* How many independent samples one sample counts as (see struct mis_counts). */
struct credits {
    double direct; /* direct light at a first hit: s = 1, and s = 0 if the edge before the light begins there */
    double draw;   /* s >= 2, t >= 2 */
};
static const struct credits NO_CREDITS = {1, 1};

/* counts_of: the counts in the weights: numbers times credits.
 *   pixels  number of pixels of the film; a light sub-path may reach each of them */
struct mis_counts counts_of(struct numbers n, struct credits c, double pixels);

static inline const struct tables *counts_tables(const struct mis_counts *c)
{
    return c->tables != NULL ? c->tables : &NO_TABLES;
}

/* n_connect: n of the strategy s >= 2, t >= 2 with its light end in region l and its eye end in region e. Draws do not
 * count as more samples than there are sub-paths to draw from. */
static inline double n_connect(const struct mis_counts *c, int l, int e, enum eye_end end)
{
    double n = c->connect[end] * pairs_worth(&counts_tables(c)->pairs, e, l);
    return c->most > 0 ? n * c->most / (n + c->most) : n;
}

/* n_direct: n of the strategy s = 1, t >= 2 that joins a surface point in region e to the light point y_0.
 *   cell, w  of y_0, see guide_density */
static inline double n_direct(const struct mis_counts *c, const struct light_set *lights, int e, enum eye_end end,
                              int cell, vec3 w)
{
    double n = c->direct[end];
    return n > 0 ? n * guide_density(&counts_tables(c)->guide, lights, e, cell, w) : 0;
}

/* c_light: c_e of mis.h (3) for vertex y of a light sub-path: n of the strategy that connects prev, the vertex before,
 * to y, which then is an eye vertex of kind `end`; 0 if prev was left by a delta lobe.
 * c_eye: the same for vertex z of an eye sub-path, which then is the light vertex that is connected to prev. */
double c_light(const struct mis_counts *c, const struct light_set *lights, const struct vertex *prev,
               const struct vertex *y, enum eye_end end);
double c_eye(const struct mis_counts *c, const struct vertex *prev, const struct vertex *z);

#endif
