/* guide.c: see guide.h. */
#include "tables/guide.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"

/* --- sums -------------------------------------------------------------------------------------------- */

void guide_sums_init(struct guide_sums *s, const struct light_set *lights, const struct regions *regions)
{
    s->columns = light_columns_new(lights, GUIDE_COLUMNS);
    s->arrived = mem_alloc((size_t)regions->limit * ((size_t)s->columns.n + 1), sizeof *s->arrived);
}

static double *arrived_in(const struct guide_sums *s, int region)
{
    return &s->arrived[(size_t)region * ((size_t)s->columns.n + 1)];
}

void guide_sums_add(struct guide_sums *s, const struct regions *regions, int region, int cell, double value)
{
    for (int r = region; r >= 0; r = regions->region[r].above) {
        double *arrived = arrived_in(s, r);
        arrived[cell / s->columns.cells_each] += value;
        arrived[s->columns.n]++;
    }
}

/* --- the tables -------------------------------------------------------------------------------------- */

/* Replace the sums of every region by its t, computed from the t of the region above. */
static void find_shares(const struct guide_sums *s, const struct regions *regions)
{
    const double K = 8;
    int n = s->columns.n;
    for (int i = 0; i < regions->n; i++) {
        double *t = arrived_in(s, i), samples = t[n], sum = sum_of(t, n);
        const double *above = i > 0 ? arrived_in(s, regions->region[i].above) : s->columns.power;
        double own = sum > 0 ? samples / (samples + K) / sum : 0, others = sum > 0 ? K / (samples + K) : 1;
        for (int c = 0; c < n; c++)
            t[c] = own * t[c] + others * above[c];
    }
}

struct guide guide_build(struct guide_sums *s, const struct regions *regions, double delta)
{
    struct guide g = {s->columns, NULL, regions->n};
    int n = g.columns.n;
    find_shares(s, regions);
    g.before = mem_alloc((size_t)g.n * (size_t)(n + 1), sizeof *g.before);
    for (int i = 0; i < g.n; i++) {
        const double *t = arrived_in(s, i);
        double *before = &g.before[(size_t)i * (size_t)(n + 1)];
        for (int c = 0; c < n; c++)
            before[c + 1] = before[c] + delta * g.columns.power[c] + (1 - delta) * t[c];
    }
    free(s->arrived);
    return g;
}

void guide_free(struct guide *g)
{
    free(g->before);
    light_columns_free(&g->columns);
}

/* --- use --------------------------------------------------------------------------------------------- */

/* The cumulative sums of a region; NULL if the table is empty. */
static const double *row_of(const struct guide *g, int region)
{
    if (region >= g->n)
        return NULL;
    const double *before = &g->before[(size_t)region * (size_t)(g->columns.n + 1)];
    return before[g->columns.n] > 0 ? before : NULL;
}

static double pmf_of_column(const struct guide *g, const double *before, int column)
{
    return (before[column + 1] - before[column]) / before[g->columns.n];
}

int guide_draw(const struct guide *g, const struct light_set *lights, int region, double u, double *pmf)
{
    const double *before = row_of(g, region);
    if (lights->choice.n == 0)
        return -1;
    if (before == NULL)
        return alias_sample(&lights->choice, u, pmf, NULL);
    int column, cell = light_columns_draw(&g->columns, lights, before, u, &column);
    *pmf = pmf_of_column(g, before, column) * (alias_pmf(&lights->choice, cell) / g->columns.power[column]);
    return cell;
}

static double ratio_of_cell(const struct guide *g, const double *before, int cell)
{
    double e = g->columns.power[cell / g->columns.cells_each];
    return e > 0 ? pmf_of_column(g, before, cell / g->columns.cells_each) / e : 0;
}

double guide_density(const struct guide *g, const struct light_set *lights, int region, int cell, vec3 w)
{
    const double *before = row_of(g, region);
    if (before == NULL)
        return 1;
    if (cell >= 0 && !(lights->n_infinite > 1 && lights->light[lights->light_of_cell[cell]].kind == LIGHT_INFINITE))
        return ratio_of_cell(g, before, cell);
    /* An escaping ray meets all infinite lights: their densities add up (light.h). */
    double guided = 0, by_power = 0;
    for (int i = 0; i < lights->n_infinite; i++) {
        double pdf = light_pdf_towards(lights, lights->infinite[i], w, &cell);
        by_power += pdf;
        guided += pdf * ratio_of_cell(g, before, cell);
    }
    return by_power > 0 ? guided / by_power : 0;
}
