/* table.h: a table as rows of cells, written as Markdown.
 *
 * A row is complete when it has as many cells as there are columns; the next cell begins another.
 *
 * Tests: test_report.c, test_equal_time.c.
 */
#ifndef ASBDPT_TABLE_H
#define ASBDPT_TABLE_H

#include <stddef.h>
#include <stdio.h>

#include "lab/results.h"

enum { TABLE_MAX_COLUMNS = 2 * METHODS_MAX + 4, TABLE_CELL = 256 };

struct table_cell {
    char text[TABLE_CELL];
    double value; /* NaN: none but the text */
};

struct table {
    char caption[512];
    char head[TABLE_MAX_COLUMNS][TABLE_CELL];
    size_t columns;
    struct table_cell *cell; /* [n_cells], row by row, owned */
    size_t n_cells, capacity;
};

/* table_begin: an empty table. table_column: one more column, named in its head. table_add: the next cell. All three
 * print like printf and cut what is too long. table_free releases what the table owns. */
void table_begin(struct table *t, const char *caption, ...);
void table_column(struct table *t, const char *format, ...);
void table_add(struct table *t, double value, const char *format, ...);
void table_free(struct table *t);

/* table_add_missing: n cells without a value. table_add_interval: a ratio with its interval, as far as they are
 * known. table_add_marked: the same, with a word or "" behind it. */
void table_add_missing(struct table *t, int n);
void table_add_interval(struct table *t, struct interval i);
void table_add_marked(struct table *t, struct interval i, const char *mark);

/* table_markdown: the caption is the paragraph before the table. */
void table_markdown(FILE *f, const struct table *t);

#endif
