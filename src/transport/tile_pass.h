/* tile_pass.h: the unit of work of a render: one tile of pixels, a block of consecutive iterations.
 *
 * A tile pass depends only on the fields below, so passes may run on any thread, in any order.
 */
#ifndef ASBDPT_TRANSPORT_TILE_PASS_H
#define ASBDPT_TRANSPORT_TILE_PASS_H

#include "transport/pool.h"
#include "transport/render_job.h"

struct observer;

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
    bool trial; /* no picture has it: it ends at CANCEL_BLOCK, too */
    bool taken; /* some of it is in the film already: it must be rendered to its end */
};

/* pass_cancelled: should the tile pass stop early? Every method asks before each of its samples. After the first yes
 * the answer stays yes, and the tile is discarded.
 * pass_pixel: pixel i of the tile; false if there are not so many, and if the pass should stop, except for
 * pixel 0: then a pool has a sub-path at least. */
static inline bool pass_cancelled(const struct tile_pass *pass)
{
    return !pass->taken && job_cancelled(pass->job) >= (pass->trial ? CANCEL_BLOCK : CANCEL_NOW);
}

static inline bool pass_pixel(const struct tile_pass *pass, int i, int *x, int *y)
{
    const struct tile *tile = pass->tile;
    if (i >= tile->n_pixels || (i > 0 && pass_cancelled(pass)))
        return false;
    *x = tile->pixel[i][0];
    *y = tile->pixel[i][1];
    return true;
}

#endif
