/* tile_pass.h: the unit of work of a render: one tile of pixels, a block of consecutive iterations. What it makes
 * depends on the fields below and on the method alone, so passes may run on any thread, in any order. */
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
    const struct counts *counts; /* of the method */
    long first, end;
    struct tile *tile; /* started; receives the result */
    struct workspace *work;
    const struct observer *observer; /* sample.h; NULL: none */
    enum cancel ends_at; /* always set: the least answer of job_cancelled at which it ends early: CANCEL_NOW; of a pass
                          * that no picture has CANCEL_BLOCK */
};

/* pass_cancelled: should the tile pass end early? After the first yes the answer stays yes, and the tile is discarded.
 * pass_goes_on: is there a pixel i of the tile, and should the pass go on? Every method asks before each of its
 * samples. Pixel 0 always has its sample, so that a pool has a sub-path. */
static inline bool pass_cancelled(const struct tile_pass *pass)
{
    return !pass->tile->taken && job_cancelled(pass->job) >= pass->ends_at;
}

static inline bool pass_goes_on(const struct tile_pass *pass, int i)
{
    return i < pass->tile->n_pixels && (i == 0 || !pass_cancelled(pass));
}

#endif
