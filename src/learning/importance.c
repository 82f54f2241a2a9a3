/* importance.c: see importance.h. */
#include "learning/importance.h"

#include <stdlib.h>
#include <string.h>

void importance_free(struct importance *g)
{
    free(g->E);
    free(g->vertices);
    memset(g, 0, sizeof *g);
}

static double *add_to(double *sum, int *n, size_t *capacity, int region, double x)
{
    sum = mem_grow(sum, capacity, (size_t)region + 1, sizeof *sum);
    for (; *n <= region; ++*n)
        sum[*n] = 0;
    sum[region] += x;
    return sum;
}

void importance_add(struct importance *g, int region, double luminance)
{
    g->E = add_to(g->E, &g->n, &g->capacity, region, luminance);
}

void importance_add_light(struct importance *g, int region, double count)
{
    g->vertices = add_to(g->vertices, &g->n_vertices, &g->vertices_capacity, region, count);
}

double importance_in(const struct importance *g, int region) { return region < g->n ? g->E[region] : 0; }

double importance_of_path(const struct importance *g, const struct vertex *light, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        if (vertex_connectible(&light[i]))
            sum += rgb_luminance(light[i].beta) * importance_in(g, light[i].light_region);
    return sum;
}
