/* tiling.h: how a film is cut into tiles: squares, or squares of pixels that are interleaved with those of others.
 *
 * Tests: test_render.c.
 */
#ifndef ASBDPT_TILING_H
#define ASBDPT_TILING_H

#include "transport/tile_pass.h"

struct tiling {
    struct pixel_rect film;
    struct pass_size size;
    int nx, ny; /* tiles */
};

/* tiling_of: as a method wants it. tiling_count: how many tiles; tiling_rect: number 0 <= i < count, row by row. */
struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size);
static inline int64_t tiling_count(const struct tiling *t) { return (int64_t)t->nx * t->ny; }
struct pixel_rect tiling_rect(const struct tiling *t, int64_t i);

#endif
