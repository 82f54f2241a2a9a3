/* importance.c: see importance.h. */
#include "learning/importance.h"

#include <stdlib.h>
#include <string.h>

void importance_free(struct importance *importance)
{
    free(importance->E);
    free(importance->vertices);
    memset(importance, 0, sizeof *importance);
}

static double *add_to(double *sum, int *n, size_t *capacity, int region, double x)
{
    sum = mem_grow(sum, capacity, (size_t)region + 1, sizeof *sum);
    for (; *n <= region; ++*n)
        sum[*n] = 0;
    sum[region] += x;
    return sum;
}

void importance_add(struct importance *importance, int region, double luminance)
{
    importance->E = add_to(importance->E, &importance->n, &importance->capacity, region, luminance);
}

void importance_add_light(struct importance *importance, int region, double count)
{
    importance->vertices =
        add_to(importance->vertices, &importance->n_vertices, &importance->vertices_capacity, region, count);
}

double importance_in(const struct importance *importance, int region)
{
    return region < importance->n ? importance->E[region] : 0;
}

double importance_of_path(const struct importance *importance, const struct vertex *light, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        if (vertex_connectible(&light[i]))
            sum += rgb_luminance(light[i].beta) * importance_in(importance, light[i].light_region);
    return sum;
}
