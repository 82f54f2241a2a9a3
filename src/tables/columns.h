/* columns.h: groups of light cells (light.h). A table cannot have a column for each of a million cells, so it has one
 * for each group. Within a column, cells are chosen by power.
 *
 * Tests: test_learning.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_COLUMNS_H
#define ASBDPT_TABLES_COLUMNS_H

#include "scene/light.h"

/* The cells of a light set in columns of equal length; the last column may be shorter. */
struct light_columns {
    int n, cells_each;
    double *power;  /* [n], probability of the column if cells are chosen by power; owned */
    double *before; /* [cells], probability by power of the cells before this cell in its column; owned */
};

/* light_columns_new: at most `most` columns; none if there is no light. light_columns_free releases them. */
struct light_columns light_columns_new(const struct light_set *lights, int most);
void light_columns_free(struct light_columns *c);

/* light_columns_draw: draw *column by a table, and one of its cells by power, both with the uniform number u.
 *   before  [n + 1], cumulative sums of the table over the columns, which are > 0 for each column of power > 0 */
int light_columns_draw(const struct light_columns *c, const struct light_set *lights, const double *before, double u,
                       int *column);

#endif
