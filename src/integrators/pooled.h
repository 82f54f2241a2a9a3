/* pooled.h: methods whose pixels choose from the light sub-paths of their tile: pool, vertices, subspaces, and others.
 *
 * In every iteration the pixels of a tile trace light sub-paths, one for every path_pixels of them; each pixel traces
 * its eye sub-path, takes the strategies s = 0 and s = 1 as BDPT does, and is joined to what its method draws; every
 * light sub-path is splat once (t = 1), whether drawn or not.
 */
#ifndef ASBDPT_POOLED_H
#define ASBDPT_POOLED_H

#include "integrators/method.h"

/* The light sub-paths of one tile and iteration, in row order of their pixels, packed one behind the other. The scratch
 * of a pooled method begins with it. */
struct light_pool {
    struct arena arena;                  /* their lobes, and what a method makes of them: until the next are traced */
    struct vertex *vertex;               /* [used], grows to the longest need; owned */
    size_t used, capacity;
    size_t start[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* first vertex of path k */
    int length[MAX_TILE_SIZE * MAX_TILE_SIZE];   /* vertices of path k */
    int n;                                       /* K */
};

/* light_pool_free: release what the pool owns, which starts as zeros: the `scratch_free` where it is all that is owned.
 */
void light_pool_free(void *pool);

/* light_pool_fill: trace the sub-paths of the tile's pixels 0, path_pixels, 2 path_pixels ... for one iteration. */
void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct frozen *f, long iteration);

static inline const struct vertex *light_pool_path(const struct light_pool *pool, int k)
{
    return &pool->vertex[pool->start[k]];
}

/* light_pool_shuffle: a random permutation of the sub-paths' numbers for one iteration into order [pool->n]. */
void light_pool_shuffle(const struct light_pool *pool, const struct tile_pass *pass, long iteration, int *order);

/* A light vertex that can be connected to: it stands for the sub-path that leads to it. */
struct candidate {
    const struct vertex *y;
    int s;    /* vertices of that sub-path */
    double L; /* luminance(beta) */
};

struct candidates {
    struct candidate *item; /* [n], in the order they were traced; the pool's */
    int n;
};

/* candidates_find: all connectible y_1, y_2 ... of the pool. */
struct candidates candidates_find(struct light_pool *pool);

/* A pixel of a tile and iteration, its eye sub-path traced. */
struct pooled_pixel {
    struct pixel_sample sample;
    const struct vertex *eye; /* [n] */
    int n, number;            /* which pixel of the tile, in row order */
    const struct vertex *light; /* [n_light] the light sub-path that it is to splat, times `scale`; NULL: none */
    int n_light;
    double scale;
    struct sampler draws;     /* random numbers for the choice */
};

/* What `pool` chooses a light sub-path by. `vertices` goes by the luminance of beta at the vertex, and with the last by
 * its importance, too. */
enum metric {
    METRIC_CONSTANT,   /* every sub-path alike: BDPT */
    METRIC_THROUGHPUT, /* the dissertation's: mean over RGB of beta at the furthest vertex */
    METRIC_IMPORTANCE  /* what the camera can use of it, importance.h */
};
extern const char *const METRICS[];

/* pooled_join: the pixel's eye vertex z = z_{t-1} and a candidate, unless the path would be too long. */
static inline void pooled_join(struct pooled_pixel *p, const struct candidate *c, const struct vertex *z, int t,
                               struct choice choice)
{
    if (c->s + t <= p->sample.max_depth + 2)
        pixel_sum_pair(&p->sample, c->y, c->s, z, t, choice);
}

/* What pooled_render does, step by step: fill the pool for an iteration; trace a pixel's eye sub-path; sum s >= 2,
 * t >= 2 with what the method draws; splat the pixel's light sub-path, and end the sample. */
void pooled_fill(const struct preparation *m, const struct tile_pass *pass, long iteration);
struct pooled_pixel pooled_begin(const struct preparation *m, const struct tile_pass *pass, int x, int y, int number,
                                 long iteration);
void pooled_connect(const struct preparation *m, const struct tile_pass *pass, struct pooled_pixel *p);
void pooled_end(struct pooled_pixel *p);

/* pooled_render: the `render` of a pooled method. */
void pooled_render(const struct preparation *m, const struct tile_pass *pass);

#endif
