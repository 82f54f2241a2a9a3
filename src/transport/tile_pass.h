/* tile_pass.h: the unit of work of a render: one tile of pixels, a block of consecutive iterations.
 *
 * A tile pass depends only on the fields below, so passes may run on any thread, in any order.
 */
#ifndef ASBDPT_TRANSPORT_TILE_PASS_H
#define ASBDPT_TRANSPORT_TILE_PASS_H

#include "scene/film.h"
#include "transport/pool.h"

struct observer;

/* pbrt-v3's lightsamplestrategy: how s = 1 chooses lights. SPATIAL: by region, if the method learns that; else, and
 * where light sub-paths start, by power. UNIFORM is of the scene (scene_uniform). */
enum light_strategy { LIGHTS_SPATIAL, LIGHTS_POWER, LIGHTS_UNIFORM };

/* The parameters of a render, which do not change while it runs. */
struct render_job {
    const struct scene *scene;
    struct pixel_rect film_rect; /* the crop in pixels */
    uint64_t seed;
    uint64_t eye_seed; /* of eye sub-paths; equal to `seed` except in measurements */
    int max_depth;
    int n_threads;
    double rr_threshold; /* of Russian roulette, see path.h */
    enum light_strategy strategy;
    /* A method calls this from time to time while it prepares, one call at a time, with the number of sub-paths that it
     * has traced. If it returns false, the method stops preparing and uses the result so far. May be NULL. */
    bool (*watch)(void *context, double traced);
    void *watch_context;
    bool (*enough)(void *context); /* see pass_enough; NULL: never */
    void *enough_context;
};

/* How a method divides its work into tile passes. */
struct pass_size {
    int block;  /* iterations; 0: any number */
    int tile;   /* pixels along the side, at most MAX_TILE_SIZE */
    int spread; /* tiles that are interleaved on each axis, so that errors that pixels share form no squares */
};
enum { LONGEST_BLOCK = 32, DEFAULT_TILE_SIZE = 16, POOL_SPREAD = 4 };

/* Memory of one thread, which all its tile passes use. */
struct workspace {
    struct arena arena; /* of one sample */
    struct vertex *eye; /* [max_depth + 2], owned */
    struct pool pool;
};

struct workspace *workspaces_new(int n, int max_depth);
void workspaces_free(struct workspace *work, int n);

/* One tile, iterations [first, end). */
struct tile_pass {
    const struct render_job *job;
    long first, end;
    struct tile *tile; /* started; receives the result */
    struct workspace *work;
    const struct observer *observer; /* sample.h; NULL: none */
};

/* pass_enough: should the tile pass stop early? Every method asks before each of its samples. After the first yes the
 * answer stays yes, and the tile is discarded.
 * pass_pixel: pixel i of the tile; false if there are not so many, and if the pass should stop, except for pixel 0. */
static inline bool pass_enough(const struct render_job *job)
{
    return job->enough != NULL && job->enough(job->enough_context);
}

static inline bool pass_pixel(const struct tile_pass *pass, int i, int *x, int *y)
{
    const struct tile *tile = pass->tile;
    if (i >= tile->n_pixels || (i > 0 && pass_enough(pass->job)))
        return false;
    *x = tile->pixel[i][0];
    *y = tile->pixel[i][1];
    return true;
}

#endif
