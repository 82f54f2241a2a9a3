/* emission.c: see emission.h. */
#include "tables/emission.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"
#include "base/number.h"

enum { SIDE = 8, LEAVES = SIDE * SIDE };

/* Nodes of a cell: the cell, 2 x 2, 4 x 4 and 8 x 8 parts, one level behind the other. */
enum { LEVELS = 4, NODES = 1 + 4 + 16 + LEAVES, FIRST_LEAF = NODES - LEAVES };

struct axis emission_axis_new(const struct light_set *lights, double **base)
{
    size_t n = 1 + (size_t)lights->n_cells * NODES;
    struct axis a = {(int)n, mem_alloc(n, sizeof *a.above), mem_alloc(n, sizeof *a.level)};
    *base = mem_alloc(n, sizeof **base);
    a.level[0] = LEVELS;
    for (int cell = 0; cell < lights->n_cells; cell++)
        for (int side = 1, level = LEVELS - 1, node = 1 + cell * NODES, wider = 0; level >= 0; level--) {
            for (int i = 0; i < side * side; i++) {
                a.above[node + i] = side == 1 ? 0 : wider + i / side / 2 * (side / 2) + i % side / 2;
                a.level[node + i] = level;
                (*base)[node + i] = side == SIDE ? alias_pmf(&lights->choice, cell) / LEAVES : 0;
            }
            wider = node;
            node += side * side;
            side *= 2;
        }
    return a;
}

void emission_axis_free(struct axis *a, double *base)
{
    free(a->above);
    free(a->level);
    free(base);
}

int emission_column(int cell, const double square[2])
{
    int i = int_within(square[0] * SIDE, 0, SIDE - 1), j = int_within(square[1] * SIDE, 0, SIDE - 1);
    return 1 + cell * NODES + FIRST_LEAF + i * SIDE + j;
}

int emission_column_of(const struct light_set *lights, const struct light_point *y0, vec3 p, vec3 w)
{
    double u[2];
    light_emission_numbers(lights, y0, p, w, u);
    return emission_column(y0->cell, u);
}

rgb emission_sample(const struct table *t, const struct light_set *lights, const struct geometry *geo,
                    const double u[3], const double direction[2], struct light_point *at, struct ray *ray, double *pdf,
                    int *column)
{
    double in_cell[3] = {0, u[1], u[2]}, in_square[2] = {direction[0], direction[1]}, pmf;
    int cell;
    *pdf = 0;
    *column = 0;
    if (lights->choice.n == 0)
        return rgb_black();
    if (t->rows == 0) {
        cell = alias_sample(&lights->choice, u[0], &pmf, &in_cell[0]);
        *column = emission_column(cell, direction);
    } else {
        cell = table_draw(t, 0, 1, lights->n_cells, NODES, u[0], &pmf, &in_cell[0]);
        int leaf = 1 + cell * NODES + FIRST_LEAF; /* its row, then its column, each by a number of its own */
        for (int i = 0, each = SIDE; i < 2; i++, each = 1) {
            int part = table_draw(t, 0, leaf, SIDE, each, direction[i], &pmf, &in_square[i]);
            in_square[i] = below_one((part + in_square[i]) / SIDE);
            leaf += part * each;
        }
        *column = leaf;
    }
    if (!light_sample_cell(lights, geo, cell, in_cell, at))
        return rgb_black();
    rgb emitted = light_sample_emission(lights, at, in_square, ray, pdf);
    *pdf *= table_ratio(t, 0, *column);
    return emitted;
}

double emission_pdf(const struct table *t, const struct light_set *lights, const struct light_point *y0, vec3 p,
                    vec3 w)
{
    double pdf = light_pdf_emission(lights, y0, w);
    return pdf > 0 && t->rows > 0 ? pdf * table_ratio(t, 0, emission_column_of(lights, y0, p, w)) : pdf;
}
