/* guide.c: see guide.h. */
#include "learning/guide.h"

#include <stdlib.h>
#include <string.h>

#include "base/cumulative.h"
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
    free(g->before);
    light_columns_free(&g->columns);
    memset(g, 0, sizeof *g);
}

/* t of every region, each from that of the region above it, region 0 from its own lessons. K is SMOOTHING times the
 * number of columns that the region above effectively has [Kish 1965]: the more there are, the more contributions it
 * takes to tell them apart. */
static double *shares_of_regions(const struct guide_lessons *l, const struct regions *regions)
{
    const double SMOOTHING = 16;
    size_t n = (size_t)l->columns.n;
    double *t = mem_alloc((size_t)l->n * n, sizeof *t);
    double all = sum_of(arrived_in(l, 0), l->columns.n);
    for (size_t c = 0; c < n; c++)
        t[c] = all > 0 ? arrived_in(l, 0)[c] / all : l->columns.power[c];
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

void guide_build(struct guide *g, struct guide_lessons *l, const struct regions *regions,
                 const struct light_set *lights, double delta)
{
    make_room(l, regions->n);
    int n = l->columns.n;
    double *t = shares_of_regions(l, regions);
    guide_free(g);
    g->columns = light_columns_new(lights, GUIDE_COLUMNS);
    g->n = l->n;
    g->before = mem_alloc((size_t)l->n * (size_t)(n + 1), sizeof *g->before);
    for (int i = 0; i < l->n; i++) {
        double *before = &g->before[(size_t)i * (size_t)(n + 1)];
        for (int c = 0; c < n; c++)
            before[c + 1] =
                before[c] + delta * l->columns.power[c] + (1 - delta) * t[(size_t)i * (size_t)n + (size_t)c];
    }
    free(t);
}

/* --- use --------------------------------------------------------------------------------------------- */

/* The sums of a region; NULL: there is no table for it. */
static const double *row_of(const struct guide *g, int region)
{
    if (g == NULL || region >= g->n)
        return NULL;
    const double *before = &g->before[(size_t)region * (size_t)(g->columns.n + 1)];
    return before[g->columns.n] > 0 ? before : NULL;
}

static double pmf_of_column(const struct guide *g, const double *before, int column)
{
    return (before[column + 1] - before[column]) / before[g->columns.n];
}

int guide_choose(const struct guide *g, const struct light_set *lights, int region, double u, double *pmf)
{
    const double *before = row_of(g, region);
    if (lights->choice.n == 0)
        return -1;
    if (before == NULL)
        return alias_sample(&lights->choice, u, pmf, NULL);
    double target = u * before[g->columns.n];
    int column = cumulative_find(before, g->columns.n, target);
    double q = pmf_of_column(g, before, column);
    if (g->columns.cells_each == 1) {
        *pmf = q;
        return column;
    }
    double rest = below_one((target - before[column]) / (before[column + 1] - before[column]));
    int cell = light_columns_cell(&g->columns, lights, column, rest);
    *pmf = q * alias_pmf(&lights->choice, cell) / g->columns.power[column];
    return cell;
}

static double ratio_of_cell(const struct guide *g, const double *before, int cell)
{
    double e = g->columns.power[cell / g->columns.cells_each];
    return e > 0 ? pmf_of_column(g, before, cell / g->columns.cells_each) / e : 0;
}

double guide_ratio(const struct guide *g, const struct light_set *lights, int region, int cell, vec3 w)
{
    const double *before = row_of(g, region);
    if (before == NULL)
        return 1;
    if (cell >= 0 && !(lights->n_infinite > 1 && lights->light[lights->light_of_cell[cell]].kind == LIGHT_INFINITE))
        return ratio_of_cell(g, before, cell);
    /* An escaping ray cannot tell infinite lights apart: their densities are added (light.h). */
    double guided = 0, by_power = 0;
    for (int i = 0; i < lights->n_infinite; i++) {
        double pdf = light_pdf_towards(lights, lights->infinite[i], w, &cell);
        by_power += pdf;
        guided += pdf * ratio_of_cell(g, before, cell);
    }
    return by_power > 0 ? guided / by_power : 0;
}
