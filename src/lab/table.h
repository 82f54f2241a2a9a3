/* table.h: a table for readers, written as HTML or as Markdown from the same cells.
 *
 * Used by: tables, report, summary. Tests: test_report.c.
 */
#ifndef ASBDPT_TABLE_H
#define ASBDPT_TABLE_H

#include <stddef.h>
#include <stdio.h>

enum { TABLE_MAX_COLUMNS = 20, TABLE_CELL = 256 };

struct table_cell {
    char text[TABLE_CELL];
    double value; /* what sorting goes by; NaN: the text */
};

struct table {
    char caption[512];
    char head[TABLE_MAX_COLUMNS][TABLE_CELL];
    int columns;
    struct table_cell *cell; /* [rows * columns], row by row, owned */
    size_t n_cells, capacity;
};

/* table_begin: an empty table; the columns follow. */
void table_begin(struct table *t, const char *caption);
void table_column(struct table *t, const char *head);

/* table_add: the next cell, rows being filled from left to right. printf style. */
void table_add(struct table *t, double value, const char *format, ...);

/* table_add_estimate: "mean +- error" with as many digits as the error deserves; "-" for NaN. */
void table_add_estimate(struct table *t, double mean, double error);

/* table_add_interval: "value [low, high]"; without the brackets when they are unknown. */
void table_add_interval(struct table *t, double value, double low, double high);

/* table_rows: rows that are complete. */
size_t table_rows(const struct table *t);

void table_html(FILE *f, const struct table *t);
void table_markdown(FILE *f, const struct table *t);
void table_free(struct table *t);

#endif
