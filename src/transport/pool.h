/* pool.h: light sub-paths that the pixels of a tile share in one iteration, and their vertices. */
#ifndef ASBDPT_POOL_H
#define ASBDPT_POOL_H

#include "base/alias.h"
#include "transport/path.h"

enum { MAX_TILE_SIZE = 32, POOL_PATHS = MAX_TILE_SIZE * MAX_TILE_SIZE };

struct pool {
    struct arena arena;    /* of this iteration: lobes, and what methods make of the sub-paths */
    struct vertex *vertex; /* [used], owned */
    size_t used, capacity;
    size_t start[POOL_PATHS]; /* first vertex of path k */
    int length[POOL_PATHS];   /* vertices of path k */
    int n;                    /* K */
    const struct vertex **candidate; /* [n_candidates], see pool_find_candidates; in the arena */
    int n_candidates;
    struct alias_table alias;    /* for those who draw by one; owned */
};

/* pool_clear: begin an iteration.
 * pool_room: room for one more sub-path of at most so many vertices. pool_add: so many of them have become one. */
void pool_clear(struct pool *p);
struct vertex *pool_room(struct pool *p, size_t max_vertices);
void pool_add(struct pool *p, int n);
void pool_free(struct pool *p);

static inline const struct vertex *pool_path(const struct pool *p, int k) { return &p->vertex[p->start[k]]; }

/* pool_find_candidates: all light vertices y_1, y_2 ... that can be connected to, in the order of tracing. Methods
 * draw by the luminance of beta, or by products with it, and need sums that are finite and not 0. So vertices whose
 * luminance is 0, not a number, or too large are left out here. No sub-path may be added afterwards. */
void pool_find_candidates(struct pool *p);

#endif
