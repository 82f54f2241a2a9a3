/* guide.c: see guide.h. */
#include "transport/guide.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

void guide_lessons_init(struct guide_lessons *l, const struct light_set *lights, int cells)
{
    memset(l, 0, sizeof *l);
    l->lights = lights;
    grid_init(&l->grid, lights->center, lights->radius, cells);
}

void guide_lessons_free(struct guide_lessons *l)
{
    grid_free(&l->grid);
    free(l->arrived);
    free(l->samples);
    memset(l, 0, sizeof *l);
}

uint64_t guide_key(const struct grid *grid, vec3 p, vec3 ng) { return grid_key(grid, p, grid_face(ng)); }

static double *arrived_in(const struct guide_lessons *l, int region)
{
    return &l->arrived[(size_t)region * (size_t)l->lights->n_cells];
}

void guide_lessons_add(struct guide_lessons *l, uint64_t key, int cell, double value)
{
    if (!(value > 0))
        return;
    size_t cells = (size_t)l->lights->n_cells, known = (size_t)l->grid.n;
    int i = grid_insert(&l->grid, key);
    if ((size_t)l->grid.n > known) {
        l->arrived = mem_grow(l->arrived, &l->arrived_capacity, (known + 1) * cells, sizeof *l->arrived);
        l->samples = mem_grow(l->samples, &l->samples_capacity, known + 1, sizeof *l->samples);
        memset(arrived_in(l, i), 0, cells * sizeof *l->arrived);
        l->samples[i] = 0;
    }
    arrived_in(l, i)[cell] += value;
    l->samples[i]++;
}

/* --- the tables -------------------------------------------------------------------------------------- */

void guide_free(struct guide *g)
{
    for (int i = 0; g->table != NULL && i < g->grid.n; i++)
        alias_free(&g->table[i]);
    free(g->table);
    grid_free(&g->grid);
    memset(g, 0, sizeof *g);
}

static double sum_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    return sum;
}

/* Shares of the cells over all regions, times the number of samples: a region counts by its samples, not by how bright
 * it is. Returns that number. */
static double all_regions(const struct guide_lessons *l, double *all)
{
    int n = l->lights->n_cells;
    double total = 0;
    for (int i = 0; i < l->grid.n; i++) {
        double share = l->samples[i] / sum_of(arrived_in(l, i), n);
        for (int c = 0; c < n; c++)
            all[c] += arrived_in(l, i)[c] * share;
        total += l->samples[i];
    }
    return total;
}

void guide_build(struct guide *g, const struct guide_lessons *l, double delta)
{
    const double K = 32; /* contributions after which a region's own shares count half */
    int n = l->lights->n_cells;
    double *all = mem_alloc((size_t)n, sizeof *all), *q = mem_alloc((size_t)n, sizeof *q);
    double total = all_regions(l, all);
    guide_free(g);
    grid_copy(&g->grid, &l->grid);
    g->table = mem_alloc((size_t)l->grid.n, sizeof *g->table);
    for (int i = 0; i < l->grid.n; i++) {
        const double *arrived = arrived_in(l, i), samples = l->samples[i];
        double own = samples / (samples + K) / sum_of(arrived, n), others = K / (samples + K) / total;
        for (int c = 0; c < n; c++)
            q[c] = delta * alias_pmf(&l->lights->choice, c) + (1 - delta) * (own * arrived[c] + others * all[c]);
        alias_build(&g->table[i], q, n); /* lessons are positive and finite, so are the shares */
    }
    free(q);
    free(all);
}

const struct alias_table *guide_table(const struct guide *g, const struct light_set *lights, vec3 p, vec3 ng)
{
    int i = g == NULL ? -1 : grid_find(&g->grid, guide_key(&g->grid, p, ng));
    return i < 0 ? &lights->choice : &g->table[i];
}

double guide_ratio(const struct light_set *lights, const struct alias_table *table, int cell, vec3 w)
{
    if (table == &lights->choice)
        return 1;
    /* Infinite lights are told apart by nobody who meets them: their densities are added (light.h). */
    if (cell < 0 || (lights->several_infinite && lights->light[lights->light_of_cell[cell]].kind == LIGHT_INFINITE))
        return light_choice_ratio(lights, table, w);
    double e = alias_pmf(&lights->choice, cell);
    return e > 0 ? alias_pmf(table, cell) / e : 0;
}
