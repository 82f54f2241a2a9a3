/* pooled.h: methods whose pixels choose from the light sub-paths of their tile: pool, vertices, subspaces, and others.
 *
 * In every iteration a tile traces light sub-paths, one for every path_pixels of its pixels. Each pixel traces its eye
 * sub-path, uses the strategies s = 0 and s = 1 as in BDPT, and is joined to what its method draws. Every light
 * sub-path is splat once (t = 1), whether it was drawn or not.
 */
#ifndef ASBDPT_POOLED_H
#define ASBDPT_POOLED_H

#include "integrators/method.h"

/* The light sub-paths of one tile and iteration, in row order of their pixels, one behind the other. The scratch of a
 * pooled method begins with this. */
struct light_pool {
    struct arena arena;                  /* of this iteration: their lobes, and data of the method */
    struct vertex *vertex;               /* [used], owned */
    size_t used, capacity;
    size_t start[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* first vertex of path k */
    int length[MAX_TILE_SIZE * MAX_TILE_SIZE];   /* vertices of path k */
    int n;                                       /* K */
};

/* light_pool_free: release what the pool owns. A method can have it as its `scratch_free`. */
void light_pool_free(void *pool);

/* light_pool_fill: trace the sub-paths of one iteration, for the tile's pixels 0, path_pixels, 2 path_pixels ... */
void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct frozen *f, long iteration);

static inline const struct vertex *light_pool_path(const struct light_pool *pool, int k)
{
    return &pool->vertex[pool->start[k]];
}

/* light_pool_shuffle: write a random permutation of the sub-paths' numbers for one iteration to order [pool->n]. */
void light_pool_shuffle(const struct light_pool *pool, const struct tile_pass *pass, long iteration, int *order);

/* A light vertex that can be connected to. It represents the sub-path that ends there. */
struct candidate {
    const struct vertex *y;
    int s;    /* vertices of that sub-path */
    double L; /* luminance(beta) */
};

struct candidates {
    struct candidate *item; /* [n], in the order of tracing; owned by the pool */
    int n;
};

/* candidates_find: all connectible y_1, y_2 ... of the pool. */
struct candidates candidates_find(struct light_pool *pool);

/* A pixel of a tile in an iteration, with its eye sub-path. */
struct pooled_pixel {
    struct pixel_sample sample;
    const struct vertex *eye; /* [n] */
    int n, number;            /* number: of the pixel within the tile, in row order */
    const struct vertex *light; /* [n_light] the light sub-path that it splats, times `scale`; NULL: none */
    int n_light;
    double scale;
    struct sampler draws;     /* random numbers for the choice */
};

/* The criterion by which `pool` chooses a light sub-path. `vertices` chooses by the luminance of beta at the vertex,
 * times the importance of its place if the criterion is METRIC_IMPORTANCE. */
enum metric {
    METRIC_CONSTANT,   /* the same for all: BDPT */
    METRIC_THROUGHPUT, /* the dissertation's: mean over RGB of beta at the furthest vertex */
    METRIC_IMPORTANCE  /* how much of it the camera can use, importance.h */
};
extern const char *const METRICS[];

/* pooled_join: join the pixel's eye vertex z = z_{t-1} to a candidate, unless the path would be too long. */
static inline void pooled_join(struct pooled_pixel *p, const struct candidate *c, const struct vertex *z, int t,
                               struct choice choice)
{
    if (c->s + t <= p->sample.max_depth + 2)
        pixel_sum_pair(&p->sample, c->y, c->s, z, t, choice);
}

/* The steps of pooled_render: fill the pool for an iteration; trace a pixel's eye sub-path; add s >= 2, t >= 2 with
 * what the method draws; splat the pixel's light sub-path and end the sample. */
void pooled_fill(const struct preparation *m, const struct tile_pass *pass, long iteration);
struct pooled_pixel pooled_begin(const struct preparation *m, const struct tile_pass *pass, int x, int y, int number,
                                 long iteration);
void pooled_connect(const struct preparation *m, const struct tile_pass *pass, struct pooled_pixel *p);
void pooled_end(struct pooled_pixel *p);

/* pooled_render: the `render` of a pooled method. */
void pooled_render(const struct preparation *m, const struct tile_pass *pass);

#endif
