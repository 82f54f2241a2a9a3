/* guide.c: see guide.h. */
#include "learning/guide.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

/* --- lessons ----------------------------------------------------------------------------------------- */

void guide_lessons_init(struct guide_lessons *l, const struct light_set *lights)
{
    memset(l, 0, sizeof *l);
    l->columns = light_columns_new(lights, GUIDE_COLUMNS);
}

void guide_lessons_free(struct guide_lessons *l)
{
    light_columns_free(&l->columns);
    free(l->arrived);
    free(l->samples);
    memset(l, 0, sizeof *l);
}

static double *arrived_in(const struct guide_lessons *l, int region)
{
    return &l->arrived[(size_t)region * (size_t)l->columns.n];
}

/* Room for all regions met so far. */
static void make_room(struct guide_lessons *l, int n)
{
    size_t columns = (size_t)l->columns.n;
    l->arrived = mem_grow(l->arrived, &l->arrived_capacity, (size_t)n * columns, sizeof *l->arrived);
    l->samples = mem_grow(l->samples, &l->samples_capacity, (size_t)n, sizeof *l->samples);
    for (; l->n < n; l->n++) {
        memset(arrived_in(l, l->n), 0, columns * sizeof *l->arrived);
        l->samples[l->n] = 0;
    }
}

void guide_lessons_add(struct guide_lessons *l, const struct regions *regions, int region, int cell, double value)
{
    make_room(l, regions->n);
    for (int r = region; r >= 0; r = regions->region[r].above) {
        arrived_in(l, r)[cell / l->columns.cells_each] += value;
        l->samples[r]++;
    }
}

/* --- the tables -------------------------------------------------------------------------------------- */

void guide_free(struct guide *g)
{
    for (int i = 0; i < g->n; i++)
        alias_free(&g->table[i]);
    free(g->table);
    light_columns_free(&g->columns);
    memset(g, 0, sizeof *g);
}

static double sum_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    return sum;
}

/* t of region 0: every region right below it counts by its samples, not by how bright it is. */
static void shares_of_scene(const struct guide_lessons *l, const struct regions *regions, double *t)
{
    double total = 0;
    for (int i = 1; i < l->n; i++) {
        double sum = sum_of(arrived_in(l, i), l->columns.n);
        if (regions->region[i].above != 0 || !(sum > 0))
            continue;
        for (int c = 0; c < l->columns.n; c++)
            t[c] += arrived_in(l, i)[c] * l->samples[i] / sum;
        total += l->samples[i];
    }
    for (int c = 0; c < l->columns.n; c++)
        t[c] = total > 0 ? t[c] / total : l->columns.power[c];
}

/* t of every region, each from that of the region above it. K is SMOOTHING times the number of columns that the region
 * above effectively has [Kish 1965]: the more there are, the more contributions it takes to tell them apart. */
static double *shares_of_regions(const struct guide_lessons *l, const struct regions *regions)
{
    const double SMOOTHING = 16;
    size_t n = (size_t)l->columns.n;
    double *t = mem_alloc((size_t)l->n * n, sizeof *t);
    shares_of_scene(l, regions, t);
    for (int i = 1; i < l->n; i++) {
        const double *above = &t[(size_t)regions->region[i].above * n], *arrived = arrived_in(l, i);
        double samples = l->samples[i], sum = sum_of(arrived, l->columns.n), square = 0;
        for (size_t c = 0; c < n; c++)
            square += above[c] * above[c];
        double K = SMOOTHING / square;
        double own = sum > 0 ? samples / (samples + K) / sum : 0, others = K / (samples + K);
        for (size_t c = 0; c < n; c++)
            t[(size_t)i * n + c] = own * arrived[c] + others * above[c];
    }
    return t;
}

void guide_start(struct guide *g, const struct light_set *lights)
{
    guide_free(g);
    g->columns = light_columns_new(lights, GUIDE_COLUMNS);
}

void guide_build(struct guide *g, struct guide_lessons *l, const struct regions *regions,
                 const struct light_set *lights, double delta)
{
    make_room(l, regions->n);
    int n = l->columns.n;
    double *t = shares_of_regions(l, regions), *q = mem_alloc((size_t)n, sizeof *q);
    guide_start(g, lights);
    g->n = l->n;
    g->table = mem_alloc((size_t)l->n, sizeof *g->table);
    for (int i = 0; i < l->n; i++) {
        for (int c = 0; c < n; c++)
            q[c] = delta * l->columns.power[c] + (1 - delta) * t[(size_t)i * (size_t)n + (size_t)c];
        alias_build(&g->table[i], q, n);
    }
    free(q);
    free(t);
}

/* --- use --------------------------------------------------------------------------------------------- */

static const struct alias_table *table_of(const struct guide *g, int region)
{
    return g == NULL || region >= g->n || g->table[region].n == 0 ? NULL : &g->table[region];
}

int guide_choose(const struct guide *g, const struct light_set *lights, int region, double u, double *pmf)
{
    const struct alias_table *table = table_of(g, region);
    if (lights->choice.n == 0)
        return -1;
    if (table == NULL)
        return alias_sample(&lights->choice, u, pmf, NULL);
    double q, rest;
    int column = alias_sample(table, u, &q, &rest);
    if (g->columns.cells_each == 1) {
        *pmf = q;
        return column;
    }
    int cell = light_columns_cell(&g->columns, lights, column, rest);
    *pmf = q * alias_pmf(&lights->choice, cell) / g->columns.power[column];
    return cell;
}

static double ratio_of_cell(const struct guide *g, const struct alias_table *table, int cell)
{
    double e = g->columns.power[cell / g->columns.cells_each];
    return e > 0 ? alias_pmf(table, cell / g->columns.cells_each) / e : 0;
}

double guide_ratio(const struct guide *g, const struct light_set *lights, int region, int cell, vec3 w)
{
    const struct alias_table *table = table_of(g, region);
    if (table == NULL)
        return 1;
    if (cell >= 0 && !(lights->several_infinite && lights->light[lights->light_of_cell[cell]].kind == LIGHT_INFINITE))
        return ratio_of_cell(g, table, cell);
    /* An escaping ray cannot tell infinite lights apart: their densities are added (light.h). */
    double guided = 0, by_power = 0;
    for (int i = 0; i < lights->n; i++)
        if (lights->light[i].kind == LIGHT_INFINITE) {
            double pdf = light_pdf_towards(lights, i, w, &cell);
            by_power += pdf;
            guided += pdf * ratio_of_cell(g, table, cell);
        }
    return by_power > 0 ? guided / by_power : 0;
}
