/* pool.c: see pool.h. */
#include "transport/pool.h"

#include <stdlib.h>

static const double MOST_LUMINANCE = 1e100;

void pool_clear(struct pool *p)
{
    arena_reset(&p->arena);
    p->n = p->n_candidates = 0;
    p->used = 0;
}

struct vertex *pool_room(struct pool *p, size_t max_vertices)
{
    p->vertex = mem_grow(p->vertex, &p->capacity, p->used + max_vertices, sizeof *p->vertex);
    return &p->vertex[p->used];
}

void pool_add(struct pool *p, int n)
{
    p->start[p->n] = p->used;
    p->length[p->n++] = n;
    p->used += (size_t)n;
}

void pool_free(struct pool *p)
{
    arena_free(&p->arena);
    free(p->vertex);
    alias_free(&p->alias);
}

void pool_find_candidates(struct pool *p)
{
    p->candidate = arena_alloc(&p->arena, p->used * sizeof *p->candidate);
    for (int k = 0; k < p->n; k++) {
        const struct vertex *path = pool_path(p, k);
        for (const struct vertex *y = path + 1; y < path + p->length[k]; y++) {
            double L = rgb_worth(y->beta);
            if (vertex_connectible(y) && L > 0 && L < MOST_LUMINANCE) /* not if NaN */
                p->candidate[p->n_candidates++] = y;
        }
    }
}
