/* pool.h: light sub-paths that the pixels of a tile share in one iteration, and their vertices. */
#ifndef ASBDPT_POOL_H
#define ASBDPT_POOL_H

#include "base/alias.h"
#include "transport/path.h"

enum { MAX_TILE_SIZE = 32, POOL_PATHS = MAX_TILE_SIZE * MAX_TILE_SIZE };

/* Vertices of a light sub-path: those of numbers [first, end). */
struct drawn {
    const struct vertex *path; /* the light sub-path, from y_0 on */
    int first, end;
    double pmf; /* probability of their choice; 1: there was no choice */
};

/* drawn_vertex: light vertex y alone. The sub-path that ends there is in front of it in memory. */
static inline struct drawn drawn_vertex(const struct vertex *y, double pmf)
{
    int i = 0;
    while (y[-i].kind != VERTEX_LIGHT)
        i++;
    return (struct drawn){y - i, i, i + 1, pmf};
}

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
