/* columns.h: the light cells (light.h) in groups, the columns of a table that cannot have one for each of a million.
 * Within a column cells are chosen by power.
 *
 * Tests: test_learning.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_COLUMNS_H
#define ASBDPT_TABLES_COLUMNS_H

#include "scene/light.h"

/* The cells of a light set in columns of equal length, the last one perhaps shorter. */
struct light_columns {
    int n, cells_each;
    double *power;  /* [n], probability of the column when cells are chosen by power; owned */
    double *before; /* [cells], probability by power of the cells before this one in its column; owned */
};

/* light_columns_new: at most `most` of them; none if there is no light. light_columns_free releases them. */
struct light_columns light_columns_new(const struct light_set *lights, int most);
void light_columns_free(struct light_columns *c);

/* light_columns_draw: *column by a table, and a cell of it by power, both with the uniform number u.
 *   before  [n + 1] of the table: sums over the columns before each, and over all; > 0 for each column of power > 0 */
int light_columns_draw(const struct light_columns *c, const struct light_set *lights, const double *before, double u,
                       int *column);

#endif
