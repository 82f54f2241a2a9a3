/* importance.h: where in space can the camera make use of light?
 *
 * A grid of cells over the scene. A short pre-pass of eye sub-paths adds to each cell the luminance of the throughput
 * of the vertices that fall into it: E(x), large where many or strong eye sub-paths pass. A light vertex y is worth
 * about luminance(beta_y) E(y). After the pre-pass the grid is frozen: it may guide random choices and enter MIS weights
 * without bias, and it is the same for every thread and tile.
 *
 * Only cells that eye sub-paths reached are stored, in a hash table, so memory follows the visible surfaces.
 *
 * Used by: asbdpt (pool, vertices). Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_IMPORTANCE_H
#define ASBDPT_IMPORTANCE_H

#include "method.h"

struct importance_cell {
    uint64_t key; /* packed cell coordinates + 1; 0: free slot */
    double E;
};

struct importance {
    vec3 origin;      /* corner of cell (0,0,0) */
    double per_metre; /* cells per unit of length */
    struct importance_cell *slot; /* [n_slots], open addressing; owned */
    size_t n_slots, n_used;       /* n_slots is a power of 2 */
    double mean; /* expectation over light sub-paths of the sum of E over their connectible vertices y_1, y_2 ... */
};

/* importance_build: run the pre-pass.
 *   job      scene, film, seed, depth, threads
 *   cells    along the diagonal of the scene's bounds, e.g. 128
 * The result does not depend on the number of threads. */
void importance_build(struct importance *g, const struct render_job *job, int cells);
void importance_free(struct importance *g);

/* importance_at: E at a point, >= 0; 0 where no eye sub-path of the pre-pass came. */
double importance_at(const struct importance *g, vec3 p);

/* importance_of_path: sum of luminance(beta) E over the connectible vertices y_1 .. of a light sub-path. */
double importance_of_path(const struct importance *g, const struct vertex *light, int n);

#endif
