/* light_pool.c: the light sub-paths of a tile, shared by all its pixels; see select.h. Used by: pool, vertices. */
#include <stdlib.h>

#include "select.h"
#include "trace.h"

struct light_pool *light_pool_new(int max_depth)
{
    enum { CAPACITY = TILE_SIZE * TILE_SIZE };
    struct light_pool *pool = mem_alloc(1, sizeof *pool);
    pool->stride = max_depth + 1;
    pool->vertex = mem_alloc((size_t)CAPACITY * (size_t)pool->stride, sizeof *pool->vertex);
    pool->length = mem_alloc(CAPACITY, sizeof *pool->length);
    return pool;
}

void light_pool_free(struct light_pool *pool)
{
    arena_free(&pool->arena);
    free(pool->vertex);
    free(pool->length);
    free(pool);
}

void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct mis_counts *counts,
                     long iteration)
{
    arena_reset(&pool->arena);
    pool->n = 0;
    for (int y = pass->rect.y0; y < pass->rect.y1; y++)
        for (int x = pass->rect.x0; x < pass->rect.x1; x++, pool->n++) {
            struct vertex *path = &pool->vertex[(size_t)pool->n * (size_t)pool->stride];
            pool->length[pool->n] = trace_light(pass, counts, x, y, (uint64_t)iteration, &pool->arena, path);
        }
}

double select_throughput(const struct vertex *light, int n) { return n < 1 ? 0 : rgb_mean(light[n - 1].beta); }
