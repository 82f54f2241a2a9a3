/* select.h: the ways in which ASBDPT chooses the light sub-path of an eye sub-path.
 *
 *   bins      the dissertation: bins of two sub-paths per pixel, one used and replaced     [S24 Algorithms 1 and 2]
 *   pool      one alias table over the sub-paths of a tile, one bin per pixel, weighted: unbiased
 *   vertices  one alias table over the light *vertices* of a tile, C draws per eye vertex, known to the MIS weights
 *
 * Each is one file and one entry here; asbdpt.c reads the parameters and calls them.
 *
 * Used by: asbdpt.
 */
#ifndef ASBDPT_SELECT_H
#define ASBDPT_SELECT_H

#include "transport/guide.h"
#include "integrators/importance.h"
#include "integrators/method.h"
#include "transport/mis.h"

enum metric {
    METRIC_CONSTANT,   /* every sub-path alike: `pool` is BDPT then */
    METRIC_THROUGHPUT, /* the dissertation's: mean over RGB of beta at the furthest vertex */
    METRIC_IMPORTANCE  /* what the camera can use of it, importance.h */
};

/* Parameters and frozen data of a render. */
struct selection {
    const struct selector *selector;
    struct mis_counts counts;
    int max_depth;
    enum metric metric;     /* pool, vertices */
    double delta;           /* pool, vertices: share of draws that ignore the importance, (0,1] */
    int connections;        /* vertices: C, draws per eye vertex */
    int path_pixels;        /* vertices: pixels for each light sub-path */
    int bin_paths;          /* bins: sub-paths per pixel */
    long max_age;           /* bins: iterations until an unused one is replaced */
    struct importance grid; /* pool, vertices with METRIC_IMPORTANCE */
    struct guide guide;     /* pool, vertices: lights as the regions of space see them */
};

struct selector {
    const char *name;
    void (*render)(const void *selection, const struct tile_pass *pass);
    void *(*new_own)(const void *selection);
    void (*free_own)(void *own);
};

extern const struct selector select_bins, select_pool, select_vertices;

/* select_throughput: beta of [S24]: mean over RGB at the furthest vertex; 0 for an empty sub-path. A sub-path of y_0
 * alone, which met no surface, has the emitted radiance there, as in pbrt-v3, where [S24] was implemented. */
double select_throughput(const struct vertex *light, int n);

/* The light sub-paths of one tile and iteration, one for every few pixels in row order, packed one behind the other. */
struct light_pool {
    struct arena arena;                  /* their lobes */
    struct vertex *vertex;               /* [used], grows to the longest need; owned */
    size_t used, capacity;
    size_t start[TILE_SIZE * TILE_SIZE]; /* first vertex of path k */
    int length[TILE_SIZE * TILE_SIZE];   /* vertices of path k */
    int n;
};

/* light_pool_free: release what the pool owns. A pool starts as zeros. */
void light_pool_free(struct light_pool *pool);

/* light_pool_fill: trace the sub-paths of the tile's pixels 0, path_pixels, 2 path_pixels... for one iteration. */
void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct mis_counts *counts,
                     int path_pixels, long iteration);

static inline const struct vertex *light_pool_path(const struct light_pool *pool, int k)
{
    return &pool->vertex[pool->start[k]];
}

#endif
