/* select.h: the ways in which ASBDPT chooses the light sub-path of an eye sub-path.
 *
 *   bins           the dissertation: bins of two sub-paths per pixel, one used and replaced  [S24 Algorithms 1 and 2]
 *   pool           one alias table over the sub-paths of a tile, one bin per pixel, weighted: unbiased
 *   vertices       one alias table over a tile's light *vertices*, C draws per eye vertex, known to the MIS weights
 *   subspaces      the same, but what is drawn depends on where the eye vertex is too
 *   lvc            vertices, but all of them equally likely: the light vertex cache                  [Davidovic 2014]
 *   combinatorial  no choice: an eye sub-path is connected with M light sub-paths in all pairs           [Pajot 2011]
 *
 * The last two are rivals to measure the others by: but for their connections they are plain BDPT, with lights by power
 * and nothing learnt about places. Each is one file, `lvc` a variant of vertices.c, and a line in each table of
 * asbdpt.c.
 */
#ifndef ASBDPT_INTEGRATORS_SELECT_H
#define ASBDPT_INTEGRATORS_SELECT_H

#include "guiding/learnt.h"
#include "integrators/importance.h"
#include "integrators/integrator.h"
#include "transport/pixel_sample.h"

enum metric {
    METRIC_CONSTANT,   /* every sub-path alike: `pool` is BDPT then */
    METRIC_THROUGHPUT, /* the dissertation's: mean over RGB of beta at the furthest vertex */
    METRIC_IMPORTANCE  /* what the camera can use of it, importance.h */
};

enum select { SELECT_BINS, SELECT_POOL, SELECT_VERTICES, SELECT_SUBSPACES, SELECT_LVC, SELECT_COMBINATORIAL };

/* Parameters and frozen data of a render. */
struct selection {
    enum select select;
    struct mis_counts counts;
    int max_depth;
    enum metric metric;           /* pool, vertices */
    double delta;                 /* pool, vertices, subspaces: share of draws that ignore what was learnt, (0,1] */
    double connections[2];        /* all but bins, pool: C, draws per eye vertex, for t = 2 and t > 2, or M */
    int lights;                   /* subspaces: samples of s = 1 for t = 2 */
    int path_pixels;              /* all but bins: pixels for each light sub-path; pool: 1 */
    int bin_paths;                /* bins: sub-paths per pixel */
    long max_age;                 /* bins: iterations until an unused one is replaced */
    struct importance importance; /* all but bins, combinatorial; of it lvc has light_vertices alone */
    struct learnt learnt;         /* pool, vertices, subspaces */
};

extern const struct tile_renderer render_bins, render_pool, render_vertices, render_subspaces, render_combinatorial;

/* select_throughput: beta of [S24]: mean over RGB at the furthest vertex; 0 for an empty sub-path. A sub-path of y_0
 * alone, which met no surface, has the emitted radiance there, as in pbrt-v3, where [S24] was implemented. */
double select_throughput(const struct vertex *light, int n);

/* The light sub-paths of one tile and iteration, one for every few pixels in row order, packed one behind the other. */
struct light_pool {
    struct arena arena;                  /* their lobes */
    struct vertex *vertex;               /* [used], grows to the longest need; owned */
    size_t used, capacity;
    size_t start[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* first vertex of path k */
    int length[MAX_TILE_SIZE * MAX_TILE_SIZE];   /* vertices of path k */
    int n;
};

/* light_pool_free: release what the pool owns. A pool starts as zeros. */
void light_pool_free(struct light_pool *pool);

/* light_pool_shuffle: a random permutation of the sub-paths' numbers for one iteration into order [pool->n]. */
void light_pool_shuffle(const struct light_pool *pool, const struct tile_pass *pass, long iteration, int *order);

static inline const struct vertex *light_pool_path(const struct light_pool *pool, int k)
{
    return &pool->vertex[pool->start[k]];
}

/* A pixel of a tile and iteration, its eye sub-path traced. */
struct pool_pixel {
    struct pixel_sample sample;
    const struct vertex *eye; /* [n] */
    int n, number;            /* which pixel of the tile, in row order */
    struct sampler draws;     /* random numbers for the choice */
};

/* A way to choose from a pool. The scratch of a thread begins with its light_pool. */
struct pool_choice {
    /* The pool of an iteration has been filled. */
    void (*begin)(void *scratch, const struct selection *sel, const struct tile_pass *pass, long iteration);
    /* One of the two adds the weighted contributions of the strategies s >= 2, t >= 2: of all of the pixel's to
     * p->sample, or to g those of z = z_{t-1}, being called for every eye vertex that can be connected to. The other is
     * NULL. */
    void (*connect)(void *scratch, const struct selection *sel, struct pool_pixel *p);
    void (*connect_drawn)(void *scratch, const struct selection *sel, struct pixel_sample *g, const struct vertex *z,
                          int t, struct sampler *sampler);
};

/* light_pool_render: a tile pass with light sub-paths for all its pixels in common: fill the pool, connect every pixel,
 * splat every sub-path once. */
void light_pool_render(const struct selection *sel, const struct tile_pass *pass, const struct pool_choice *choice);

#endif
