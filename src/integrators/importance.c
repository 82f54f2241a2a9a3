/* importance.c: see importance.h. */
#include "integrators/importance.h"

#include <stdlib.h>
#include <string.h>

void importance_free(struct importance *g)
{
    free(g->E);
    free(g->vertices);
    memset(g, 0, sizeof *g);
}

void importance_add(struct importance *g, int region, double luminance)
{
    g->E = mem_grow(g->E, &g->capacity, (size_t)region + 1, sizeof *g->E);
    for (; g->n <= region; g->n++)
        g->E[g->n] = 0;
    g->E[region] += luminance;
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
