/* columns.c: see columns.h. */
#include "tables/columns.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"

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

/* The last one that begins at or before u times the column's probability. */
int light_columns_cell(const struct light_columns *c, const struct light_set *lights, int column, double u)
{
    int low = column * c->cells_each, high = low + c->cells_each;
    high = high < lights->n_cells ? high : lights->n_cells;
    low += cumulative_find(&c->before[low], high - low, u * c->power[column]);
    while (low > column * c->cells_each && alias_pmf(&lights->choice, low) == 0)
        low--; /* rounding at the end of the column */
    return low;
}
