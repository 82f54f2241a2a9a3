/* table.c: see table.h. */
#include "tables/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alias.h"
#include "base/mem.h"
#include "base/number.h"

static const double PRIOR = 4; /* samples of mean weight that the pair above counts as */

struct table table_learn(int rows, int columns)
{
    size_t n = (size_t)rows * (size_t)columns;
    return (struct table){.columns = columns, .ratio = mem_alloc(n, sizeof(double)),
                          .weight = mem_alloc(n, sizeof(double))};
}

static size_t at(const struct table *t, int r, int c) { return (size_t)r * (size_t)t->columns + (size_t)c; }

/* The pair above: both nodes one level up; if their levels differ, only the finer one. False at the top. */
static bool pair_above(struct axis row, struct axis column, int *r, int *c)
{
    bool row_moves = row.above != NULL && *r > 0, column_moves = column.above != NULL && *c > 0;
    int lead = row_moves && column_moves ? row.level[*r] - column.level[*c] : 0;
    if (row_moves && lead <= 0)
        *r = row.above[*r];
    if (column_moves && lead >= 0)
        *c = column.above[*c];
    return row_moves || column_moves;
}

void table_add(struct table *t, struct axis row, struct axis column, int r, int c, double x, double w)
{
    t->samples++;
    do {
        t->ratio[at(t, r, c)] += w * x;
        t->weight[at(t, r, c)] += w;
    } while (pair_above(row, column, &r, &c));
}

/* Replace the sums of w x by m(r,c), in an order in which the pair above comes first. */
static void find_means(const struct table *t, struct axis row, struct axis column)
{
    int tops = column.above == NULL ? column.n : 1; /* pairs without one above */
    double worth = sum_of(t->ratio, tops), weight = sum_of(t->weight, tops), prior = PRIOR * weight / t->samples;
    for (int r = 0; r < row.n; r++)
        for (int c = 0; c < column.n; c++) {
            int r_above = r, c_above = c;
            double *m = &t->ratio[at(t, r, c)];
            bool has_above = pair_above(row, column, &r_above, &c_above);
            double above = has_above ? t->ratio[at(t, r_above, c_above)] : worth / weight;
            *m = (*m + prior * above) / (t->weight[at(t, r, c)] + prior);
        }
}

/* Replace a row of means by its ratios; all 1 if no column that can be chosen is worth anything. */
static void find_ratios(double *m, const double *base, int n, double delta, bool root)
{
    double sum = 0;
    for (int c = 0; c < n; c++)
        sum += base[c] * (m[c] = root ? sqrt(m[c]) : m[c]);
    for (int c = 0; c < n; c++)
        m[c] = sum > 0 ? (1 - delta) * m[c] / sum + delta : 1;
}

void table_build(struct table *t, struct axis row, struct axis column, const double *base, double delta, bool root,
                 bool drawn)
{
    size_t n = (size_t)column.n;
    t->rows = t->samples > 0 ? row.n : 0;
    if (t->rows > 0)
        find_means(t, row, column);
    t->before = drawn && t->rows > 0 ? mem_alloc((size_t)row.n * (n + 1), sizeof *t->before) : NULL;
    for (int r = 0; r < t->rows; r++) {
        double *ratio = &t->ratio[(size_t)r * n];
        find_ratios(ratio, base, column.n, delta, root);
        for (size_t c = 0; c < n && drawn; c++)
            t->before[(size_t)r * (n + 1) + c + 1] = t->before[(size_t)r * (n + 1) + c] + base[c] * ratio[c];
    }
    free(t->weight);
    t->weight = NULL;
}

struct table table_of_row(const double *m, const double *base, int n, double delta)
{
    struct table t = {.rows = m != NULL, .columns = n};
    if (m != NULL) {
        t.ratio = mem_alloc((size_t)n, sizeof *t.ratio);
        memcpy(t.ratio, m, (size_t)n * sizeof *m);
        find_ratios(t.ratio, base, n, delta, false);
    }
    return t;
}

void table_free(struct table *t)
{
    free(t->ratio);
    free(t->weight);
    free(t->before);
}

/* Rounding may move the target to the end of the sums or beyond. Then this is the last group that can be drawn. */
int table_draw(const struct table *t, int r, int first, int n, int each, double u, double *pmf, double *left)
{
    const double *before = &t->before[(size_t)r * (size_t)(t->columns + 1) + (size_t)first];
    double total = before[n * each] - before[0], target = before[0] + u * total;
    int group = cumulative_find(before, n * each, target) / each;
    while (group > 0 && before[(group + 1) * each] == before[group * each])
        group--;
    double own = before[(group + 1) * each] - before[group * each];
    *pmf = own / total;
    *left = below_one((target - before[group * each]) / own);
    return group;
}
