/* pairs.c: see pairs.h. */
#include "tables/pairs.h"

#include <stdbool.h>
#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"

static const double KAPPA = 4; /* number of trials of mean weight that the pair above counts as */

void pair_sums_init(struct pair_sums *s, const struct regions *eye, const struct regions *light)
{
    size_t n = (size_t)eye->n * (size_t)light->n;
    s->worth = mem_alloc(n, sizeof *s->worth);
    s->weight = mem_alloc(n, sizeof *s->weight);
    s->trials = 0;
}

static size_t number_of(const struct regions *light, int e, int y) { return (size_t)e * (size_t)light->n + (size_t)y; }

/* The pair above: both regions one level up; if their levels differ, only the finer one. False at the top. */
static bool pair_above(const struct regions *eye, const struct regions *light, int *e, int *y)
{
    const struct region *re = &eye->region[*e], *ry = &light->region[*y];
    if (*e == 0 && *y == 0)
        return false;
    if (re->level <= ry->level && *e != 0)
        *e = re->above;
    if (ry->level <= re->level && *y != 0)
        *y = ry->above;
    return true;
}

void pair_sums_add(struct pair_sums *s, const struct regions *eye, const struct regions *light, int e, int y, double x,
                   double w)
{
    s->trials++;
    do {
        s->worth[number_of(light, e, y)] += w * x;
        s->weight[number_of(light, e, y)] += w;
    } while (pair_above(eye, light, &e, &y));
}

/* Replace the sums of w x by m(e,l), in an order in which the pair above comes first. */
static void find_means(const struct pair_sums *s, const struct regions *eye, const struct regions *light)
{
    double *m = s->worth, prior = s->trials > 0 ? KAPPA * s->weight[0] / s->trials : 1; /* all are in the top pair */
    for (int e = 0; e < eye->n; e++)
        for (int y = 0; y < light->n; y++) {
            int e_above = e, y_above = y;
            size_t i = number_of(light, e, y);
            double above = pair_above(eye, light, &e_above, &y_above) ? m[number_of(light, e_above, y_above)] : 0;
            m[i] = (s->worth[i] + prior * above) / (s->weight[i] + prior);
        }
}

struct pairs pairs_build(struct pair_sums *s, const struct regions *eye, const struct regions *light,
                         const double *vertices, double delta)
{
    double all = sum_of(vertices, light->n);
    find_means(s, eye, light);
    for (int e = 0; e < eye->n; e++) {
        double *row = &s->worth[number_of(light, e, 0)], mean = 0;
        for (int y = 0; y < light->n; y++)
            mean += vertices[y] * row[y];
        for (int y = 0; y < light->n; y++)
            row[y] = mean > 0 ? (1 - delta) * row[y] / mean + delta / all : all > 0 ? 1 / all : 1;
    }
    free(s->weight);
    struct pairs p = {eye->n, light->n, s->worth};
    return p;
}

struct pairs pairs_from_row(double *row, int n_light)
{
    struct pairs p = {1, n_light, row};
    return p;
}
