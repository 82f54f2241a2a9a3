/* render.h: from a prepared scene to a film: cut the work into tile passes and run them on threads.
 *
 * The frame (or its crop) is cut into tiles, the iterations into blocks, of sizes the method may choose. Tile passes
 * depend on nothing but the pixel and the iteration (of `bins`: the block), and the film's sums are exact, so the same
 * scene, seed and range of iterations give the same bytes for any number of threads, stopped and continued anywhere or
 * in parts.
 *
 * Tests: test_render.c.
 */
#ifndef ASBDPT_RENDER_H
#define ASBDPT_RENDER_H

#include <stdint.h>

#include "base/error.h"
#include "render/job.h"
#include "transport/sample.h"

/* Who looks on: an observer for each tile pass. So many passes for each thread are under way or wait for their turn. */
enum { OBSERVED_SLOTS = 2 };
struct observers {
    void *context;
    /* The observer of a pass, whose result will wait in this slot; called by any thread.
     *   tile  empty, of the pass */
    struct observer (*begin)(void *context, int slot, const struct tile *tile);
    /* The tile has gone into the film: in the order of passes, one call at a time. */
    void (*end)(void *context, int slot);
};

/* render_scene: render into a film.
 *   job   settled, its scene prepared
 *   p     its method, which learns now unless it has learnt already; what it learns is in it afterwards
 *   film  initialised by film_init for job->film_rect, possibly holding earlier iterations already, and
 *         film->passes tile passes of the block that begins at job->first
 * Returns false with a message when the film and the job do not fit together. */
bool render_scene(struct render_job *job, struct prepared *p, struct film *film, struct error *err);

/* tiling_of: a film in tiles as a method wants them. tiling_count: how many; tiling_pixels: number 0 <= i < count. The
 * first few lie all over the film: they show what it is of, and how long the others will take. */
struct tiling {
    struct pixel_rect film;
    struct pass_size size;
    int nx, ny;   /* tiles */
    int64_t step; /* from one to the next, row by row */
};
struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size);
static inline int64_t tiling_count(const struct tiling *t) { return (int64_t)t->nx * t->ny; }
struct tile_pixels tiling_pixels(const struct tiling *t, int64_t i);

#endif
