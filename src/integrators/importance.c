/* importance.c: see importance.h. */
#include "integrators/importance.h"

#include <stdlib.h>
#include <string.h>

void importance_init(struct importance *g, const struct light_set *lights, int cells)
{
    memset(g, 0, sizeof *g);
    grid_init(&g->grid, lights->center, lights->radius, cells);
}

void importance_free(struct importance *g)
{
    grid_free(&g->grid);
    free(g->E);
    memset(g, 0, sizeof *g);
}

uint64_t importance_key(const struct importance *g, vec3 p, vec3 ng)
{
    return grid_key(&g->grid, p, grid_face(ng));
}

void importance_add(struct importance *g, uint64_t key, double luminance)
{
    int known = g->grid.n, i = grid_insert(&g->grid, key);
    if (i == known) {
        g->E = mem_grow(g->E, &g->capacity, (size_t)i + 1, sizeof *g->E);
        g->E[i] = 0;
    }
    g->E[i] += luminance;
}

double importance_at(const struct importance *g, vec3 p, vec3 ng)
{
    int i = grid_find(&g->grid, importance_key(g, p, ng));
    return i < 0 ? 0 : g->E[i];
}

double importance_of_path(const struct importance *g, const struct vertex *light, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        if (vertex_connectible(&light[i]))
            sum += rgb_luminance(light[i].beta) * importance_at(g, light[i].p, light[i].ng);
    return sum;
}
