/* guide.c: see guide.h. */
#include "guide.h"

#include <stdlib.h>
#include <string.h>

#include "mem.h"

void guide_init(struct guide *g, const struct light_set *lights, int cells)
{
    memset(g, 0, sizeof *g);
    g->lights = lights;
    grid_init(&g->grid, lights->center, lights->radius, cells);
}

void guide_free(struct guide *g)
{
    for (int i = 0; i < g->grid.n; i++) {
        free(g->region[i].arrived);
        alias_free(&g->region[i].table);
    }
    free(g->region);
    grid_free(&g->grid);
    memset(g, 0, sizeof *g);
}

uint64_t guide_key(const struct guide *g, vec3 p, vec3 ng) { return grid_key(&g->grid, p, grid_face(ng)); }

void guide_add(struct guide *g, uint64_t key, int cell, double value)
{
    if (!(value > 0))
        return;
    int known = g->grid.n, i = grid_insert(&g->grid, key);
    if (i == known) {
        g->region = mem_grow(g->region, &g->capacity, (size_t)i + 1, sizeof *g->region);
        memset(&g->region[i], 0, sizeof g->region[i]);
        g->region[i].arrived = mem_alloc((size_t)g->lights->n_cells, sizeof(double));
    }
    g->region[i].arrived[cell] += value;
    g->region[i].samples++;
}

/* Scale an array to sum to 1; zeros stay. */
static void normalise(double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    for (int i = 0; i < n && sum > 0; i++)
        x[i] /= sum;
}

void guide_finish(struct guide *g, double delta)
{
    const double K = 32; /* contributions after which a region's own shares count half */
    int n = g->lights->n_cells;
    double *all = mem_alloc((size_t)n, sizeof *all), *q = mem_alloc((size_t)n, sizeof *q);
    for (int i = 0; i < g->grid.n; i++) {
        normalise(g->region[i].arrived, n);
        for (int c = 0; c < n; c++)
            all[c] += g->region[i].arrived[c] * g->region[i].samples;
    }
    normalise(all, n);
    for (int i = 0; i < g->grid.n; i++) {
        struct guide_region *r = &g->region[i];
        for (int c = 0; c < n; c++)
            q[c] = delta * alias_pmf(&g->lights->choice, c) +
                   (1 - delta) * (r->samples * r->arrived[c] + K * all[c]) / (r->samples + K);
        alias_build(&r->table, q, n);
        free(r->arrived);
        r->arrived = NULL;
    }
    free(q);
    free(all);
}

const struct alias_table *guide_table(const struct guide *g, const struct light_set *lights, vec3 p, vec3 ng)
{
    int i = g == NULL ? -1 : grid_find(&g->grid, guide_key(g, p, ng));
    return i < 0 ? &lights->choice : &g->region[i].table;
}

double guide_ratio(const struct light_set *lights, const struct alias_table *table, int cell, vec3 w)
{
    if (table == &lights->choice)
        return 1;
    if (cell >= 0 && lights->light[lights->light_of_cell[cell]].kind != LIGHT_INFINITE) {
        double e = alias_pmf(&lights->choice, cell);
        return e > 0 ? alias_pmf(table, cell) / e : 0;
    }
    /* Infinite lights are told apart by nobody who meets them: their densities are added (light.h). */
    double e = light_pdf_environment(lights, &lights->choice, w);
    return e > 0 ? light_pdf_environment(lights, table, w) / e : 0;
}
