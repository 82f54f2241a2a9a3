/* table.h: a table of Markdown, written to a file cell by cell.
 *
 * Tests: test_report.c, test_equal_time.c.
 */
#ifndef ASBDPT_TABLE_H
#define ASBDPT_TABLE_H

#include <stdio.h>

#include "lab/results.h"

struct table {
    FILE *f;
    int columns, cells; /* written so far */
};

/* table_begin: write the caption, a paragraph before the table. table_column: the name of one more column. table_add:
 * the next cell; a row is complete when it has as many cells as there are columns. All three print like printf.
 * table_end: after the last cell. */
struct table table_begin(FILE *f, const char *caption, ...);
void table_column(struct table *t, const char *format, ...);
void table_add(struct table *t, const char *format, ...);
void table_end(struct table *t);

/* table_add_missing: n cells without a value. table_add_interval: a ratio with its interval, as far as they are known,
 * and a word or "" behind it. */
void table_add_missing(struct table *t, int n);
void table_add_interval(struct table *t, struct interval i, const char *mark);

#endif
