/* pool.h: light sub-paths that the pixels of a tile share in one iteration, and their vertices. */
#ifndef ASBDPT_POOL_H
#define ASBDPT_POOL_H

#include "base/alias.h"
#include "transport/path.h"

enum { MAX_TILE_SIZE = 32, POOL_PATHS = MAX_TILE_SIZE * MAX_TILE_SIZE };

/* Vertices of a light sub-path: those of numbers [first, end). */
struct drawn {
    const struct vertex *light; /* the sub-path, from y_0 on */
    int first, end;
    double pmf; /* probability of their choice; 1: there was no choice */
};

/* A light vertex that can be connected to. It represents the sub-path that ends there. */
struct candidate {
    struct drawn drawn; /* it alone */
    double L;           /* luminance(beta) */
};
static inline const struct vertex *candidate_vertex(const struct candidate *c)
{
    return &c->drawn.light[c->drawn.first];
}

struct pool {
    struct arena arena;    /* of this iteration: lobes, and what methods make of the sub-paths */
    struct vertex *vertex; /* [used], owned */
    size_t used, capacity;
    size_t start[POOL_PATHS]; /* first vertex of path k */
    int length[POOL_PATHS];   /* vertices of path k */
    int n;                    /* K */
    struct candidate *candidate; /* [n_candidates] see pool_find_candidates; in the arena */
    int n_candidates;
    struct alias_table alias;    /* for those who draw by one; owned */
};

/* pool_clear: begin an iteration. pool_room: room for one more sub-path of at most so many vertices at the end of
 * pool->vertex. pool_add: so many have become a sub-path. */
void pool_clear(struct pool *p);
struct vertex *pool_room(struct pool *p, size_t max_vertices);
void pool_add(struct pool *p, int n);
void pool_free(struct pool *p);

static inline const struct vertex *pool_path(const struct pool *p, int k) { return &p->vertex[p->start[k]]; }

/* pool_find_candidates: all connectible y_1, y_2 ... in the order of tracing. No sub-path may be added afterwards. */
void pool_find_candidates(struct pool *p);

#endif
