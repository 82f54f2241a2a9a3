/* sums.h: sums by row and column; a row comes into being, all zeros, when it is first asked for. */
#ifndef ASBDPT_TABLES_SUMS_H
#define ASBDPT_TABLES_SUMS_H

#include <string.h>

#include "base/mem.h"

struct row_sums {
    double *x; /* [rows * columns], owned: free(x) releases it */
    int rows, columns;
    size_t capacity;
};

/* sums_row: the sums of a row, [columns]; valid until the next row comes. */
static inline double *sums_row(struct row_sums *s, int row)
{
    size_t columns = (size_t)s->columns, had = (size_t)s->rows * columns, need = ((size_t)row + 1) * columns;
    if (row >= s->rows) {
        s->x = mem_grow(s->x, &s->capacity, need, sizeof *s->x);
        memset(s->x + had, 0, (need - had) * sizeof *s->x);
        s->rows = row + 1;
    }
    return s->x + (size_t)row * columns;
}

#endif
