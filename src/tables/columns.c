/* columns.c: see columns.h. */
#include "tables/columns.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"
#include "base/number.h"

struct light_columns light_columns_new(const struct light_set *lights, int most)
{
    struct light_columns c = {0};
    c.cells_each = (lights->n_cells + most - 1) / most;
    c.n = c.cells_each > 0 ? (lights->n_cells + c.cells_each - 1) / c.cells_each : 0;
    c.power = mem_alloc((size_t)c.n, sizeof *c.power);
    c.before = mem_alloc((size_t)lights->n_cells, sizeof *c.before);
    for (int i = 0; i < lights->n_cells; i++) {
        c.before[i] = c.power[i / c.cells_each];
        c.power[i / c.cells_each] += alias_pmf(&lights->choice, i);
    }
    return c;
}

void light_columns_free(struct light_columns *c)
{
    free(c->power);
    free(c->before);
}

/* Rounding may move a target to the end of the sums or beyond. Then the result is the last column or cell of power >
 * 0. */
int light_columns_draw(const struct light_columns *c, const struct light_set *lights, const double *before, double u,
                       int *column)
{
    double target = u * before[c->n];
    int k = cumulative_find(before, c->n, target);
    while (c->power[k] == 0)
        k--;
    double within = below_one((target - before[k]) / (before[k + 1] - before[k]));
    int first = k * c->cells_each, left = lights->n_cells - first, n = left < c->cells_each ? left : c->cells_each;
    int cell = first + cumulative_find(&c->before[first], n, within * c->power[k]);
    while (cell > first && alias_pmf(&lights->choice, cell) == 0)
        cell--;
    *column = k;
    return cell;
}
