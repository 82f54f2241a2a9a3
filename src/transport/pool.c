/* pool.c: see pool.h. */
#include "transport/pool.h"

#include <stdlib.h>

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
        for (int i = 1; i < p->length[k]; i++)
            if (vertex_connectible(&path[i]))
                p->candidate[p->n_candidates++] = &path[i];
    }
}
