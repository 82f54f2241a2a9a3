/* light_pool.c: the light sub-paths of a tile, shared by all its pixels; see select.h. Used by: pool, vertices. */
#include <stdlib.h>

#include "integrators/select.h"
#include "transport/trace.h"

void light_pool_free(struct light_pool *pool)
{
    arena_free(&pool->arena);
    free(pool->vertex);
}

void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct mis_counts *counts,
                     int path_pixels, long iteration)
{
    size_t longest = (size_t)pass->job->max_depth + 1;
    int number = 0;
    arena_reset(&pool->arena);
    pool->n = 0;
    pool->used = 0;
    for (int y = pass->rect.y0; y < pass->rect.y1; y++)
        for (int x = pass->rect.x0; x < pass->rect.x1; x++, number++) {
            if (number % path_pixels != 0)
                continue;
            pool->vertex = mem_grow(pool->vertex, &pool->capacity, pool->used + longest, sizeof *pool->vertex);
            struct vertex *path = &pool->vertex[pool->used];
            pool->start[pool->n] = pool->used;
            pool->length[pool->n] = trace_light(pass, counts, x, y, (uint64_t)iteration, &pool->arena, path);
            pool->used += (size_t)pool->length[pool->n];
            pool->n++;
        }
}

double select_throughput(const struct vertex *light, int n) { return n < 1 ? 0 : rgb_mean(light[n - 1].beta); }
