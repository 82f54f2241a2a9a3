/* importance.h: where in space can the camera make use of light?
 *
 * A grid of cells over the scene, each split by the way the surfaces in it face: the two sides of a wall differ. The
 * pre-pass (prepass.h) adds to each cell the luminance of the throughput of the eye vertices that fall into it: E(x),
 * large where many or strong eye sub-paths pass. A light vertex y is worth about luminance(beta_y) E(y). After the
 * pre-pass the grid is frozen: it may guide random choices and enter MIS weights without bias, and it is the same for
 * every thread and tile.
 *
 * Used by: asbdpt (pool, vertices), prepass. Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_IMPORTANCE_H
#define ASBDPT_IMPORTANCE_H

#include "base/grid.h"
#include "transport/path.h"

struct importance {
    struct grid grid;
    double *E; /* [grid.n], owned */
    size_t capacity;
    /* About the connectible vertices y_1, y_2 ... of light sub-paths, from the pre-pass: */
    double mean;   /* expectation over sub-paths of the sum of E over their vertices */
    /* Share of vertices that carries the importance I = luminance(beta) E: (mean I)^2 / mean(I^2), (0,1]: the effective
     * sample size [Kish 1965] per sample. */
    double useful;
};

/* importance_init: `cells` along the scene's diameter, e.g. 128. */
void importance_init(struct importance *g, const struct light_set *lights, int cells);
void importance_free(struct importance *g);

/* importance_key: the cell of a surface point with unit geometric normal ng; importance_add: an eye vertex of that
 * throughput luminance fell into it. */
uint64_t importance_key(const struct importance *g, vec3 p, vec3 ng);
void importance_add(struct importance *g, uint64_t key, double luminance);

/* importance_at: E at a surface point, >= 0; 0 where no eye sub-path of the pre-pass came. */
double importance_at(const struct importance *g, vec3 p, vec3 ng);

/* importance_of_path: sum of luminance(beta) E over the connectible vertices y_1 .. of a light sub-path. */
double importance_of_path(const struct importance *g, const struct vertex *light, int n);

#endif
