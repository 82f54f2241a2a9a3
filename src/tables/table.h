/* table.h: what the columns of a table are worth to its rows, learnt from samples; choices by it, and their density.
 *
 * A row is a place where an eye vertex may be. A column is what it can choose: the place of a light vertex, or a light
 * cell. (The table of rays that leave lights has one row.)
 *
 * A sample of row r and column c has the worth x >= 0 and the weight w > 0. The mean worth m(r,c) is learnt for more
 * pairs than there are samples. So the mean of a pair is regularised towards that of the pair above it:
 *     m(r,c) = (sum of w x + PRIOR w_mean m(r',c')) / (sum of w + PRIOR w_mean),      PRIOR = 4 samples.
 * Rows and columns may be nodes of trees, in which a node contains those below it: places on several levels, parts of a
 * light. In the pair above, both nodes are one level up, or the finer one alone. The top pair is regularised towards
 * the mean of all samples.
 *
 * Let base(c) be the probability of a column if nothing were learnt. A choice by row r has the probability
 *     base(c) ratio(r,c),      ratio(r,c) = (1 - delta) m(r,c) / sum_c base(c) m(r,c) + delta,
 * a defensive mixture [Hesterberg 1995]. The MIS weights need the ratio. Columns are drawn by inversion of cumulative
 * sums, which keeps strata and low discrepancy.
 *
 * The tables of a render do not change while it takes samples, so every choice is unbiased, and every strategy finds
 * the same ratios for a path. An empty table chooses by base: all ratios are 1.
 *
 * Tests: test_table.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_TABLE_H
#define ASBDPT_TABLES_TABLE_H

#include <stdbool.h>
#include <stddef.h>

/* The nodes of a tree; 0 is the top. Without `above` there is no tree: all n nodes are on one level, below nothing. */
struct axis {
    int n;
    int *above; /* [n] the node that contains it, of a lower number; NULL: no tree */
    int *level; /* [n] 0: the finest; the top has the highest */
};

struct table {
    int rows, columns; /* rows 0: the table is empty; so it is while it is learnt */
    double *ratio;     /* [rows*columns], > 0; while it is learnt the sums of w x; owned */
    double *weight;    /* while it is learnt: the sums of w; owned */
    double samples;    /* their number */
    double *before;    /* [rows*(columns+1)] cumulative probabilities; NULL if nobody draws by it; owned */
};

/* table_learn: begin to learn, with room for so many rows and columns; table_free releases the table.
 * table_add: add a sample, which counts in all pairs above, too.
 * table_build: make the sums ratios. Without samples the table is empty.
 *   row     a tree, or one row
 *   base    [column.n], probabilities; 0: the column is never drawn
 *   delta   (0,1]
 *   root    use the square root of the mean, for samples whose worths are squares
 *   drawn   make what table_draw needs */
struct table table_learn(int rows, int columns);
void table_add(struct table *t, struct axis row, struct axis column, int r, int c, double x, double w);
void table_build(struct table *t, struct axis row, struct axis column, const double *base, double delta, bool root,
                 bool drawn);
void table_free(struct table *t);

/* table_of_row: a table of one row, by these mean worths [n]; empty if m is NULL. */
struct table table_of_row(const double *m, const double *base, int n, double delta);

/* table_row: the ratios of a row, [columns]; a table of one row has it for all. table_ratio: one of them; 1 if the
 * table is empty. */
static inline const double *table_row(const struct table *t, int r)
{
    return &t->ratio[t->rows > 1 ? (size_t)r * (size_t)t->columns : 0];
}
static inline double table_ratio(const struct table *t, int r, int c)
{
    return t->rows > 0 ? table_row(t, r)[c] : 1;
}

/* table_draw: draw one of n groups of `each` columns, of which `first` is the first, with the uniform number u; returns
 * its number. The table is not empty, and one of these columns can be drawn.
 *   pmf   out: its probability among them
 *   left  out: what is left of u, uniform in [0,1) */
int table_draw(const struct table *t, int r, int first, int n, int each, double u, double *pmf, double *left);

#endif
