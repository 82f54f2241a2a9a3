/* pairs.c: see pairs.h. */
#include "tables/pairs.h"

#include <stdbool.h>
#include <stdlib.h>

#include "base/alias.h"

static const double KAPPA = 4; /* trials of mean weight that the pair above counts for */

void pair_sums_init(struct pair_sums *s, const struct regions *eye, const struct regions *light)
{
    memset(s, 0, sizeof *s);
    s->worth.columns = s->weight.columns = light->n;
    sums_row(&s->worth, eye->n - 1);
    sums_row(&s->weight, eye->n - 1);
}

/* The pair above: both one level up, or the finer one alone until they are of the same level. False at the top. */
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
        sums_row(&s->worth, e)[y] += w * x;
        sums_row(&s->weight, e)[y] += w;
    } while (pair_above(eye, light, &e, &y));
}

/* m(e,l) of all pairs into `m`, by eye and light region. A pair comes after the one above it. */
static void shrink(struct pair_sums *s, const struct regions *eye, const struct regions *light, struct row_sums *m)
{
    sums_row(m, eye->n - 1);
    double prior = s->trials > 0 ? KAPPA * s->weight.x[0] / s->trials : 1; /* all trials count in the pair on top */
    for (int e = 0; e < eye->n; e++)
        for (int y = 0; y < light->n; y++) {
            int e_above = e, y_above = y;
            double above = pair_above(eye, light, &e_above, &y_above) ? sums_row(m, e_above)[y_above] : 0;
            sums_row(m, e)[y] = (sums_row(&s->worth, e)[y] + prior * above) / (sums_row(&s->weight, e)[y] + prior);
        }
}

struct pairs pairs_build(struct pair_sums *s, const struct regions *eye, const struct regions *light,
                         const struct row_sums *vertices, double delta)
{
    struct row_sums m = {.columns = light->n};
    double all = sum_of(vertices->x, vertices->rows);
    shrink(s, eye, light, &m);
    for (int e = 0; e < eye->n; e++) {
        double *row = sums_row(&m, e), mean = 0;
        for (int y = 0; y < vertices->rows; y++)
            mean += vertices->x[y] * row[y];
        for (int y = 0; y < light->n; y++)
            row[y] = mean > 0 ? (1 - delta) * row[y] / mean + delta / all : all > 0 ? 1 / all : 1;
    }
    free(s->worth.x);
    free(s->weight.x);
    struct pairs p = {eye->n, light->n, m.x};
    return p;
}

struct pairs pairs_from_row(double *row, int n_light)
{
    struct pairs p = {1, n_light, row};
    return p;
}
