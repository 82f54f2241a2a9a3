/* text.h: text of reports: pieces in memory of a fixed size, and tables of Markdown, written to a file cell by cell.
 *
 * Tests: test_report.c, test_equal_time.c, test/run/lab.sh.
 */
#ifndef ASBDPT_LAB_TEXT_H
#define ASBDPT_LAB_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "lab/results.h"

/* text_add: write behind the end of a text, printf style. size: of its memory, in bytes. False if it does not fit: then
 * as much is there as fits, and it ends with 0. */
bool text_add(char *text, size_t size, const char *format, ...);

struct md_table {
    FILE *f;
    int columns, cells; /* written so far */
};

/* md_begin: write the caption, a paragraph before the table. md_column: the name of one more column. md_add:
 * the next cell; a row is complete when it has as many cells as there are columns. All three print like printf.
 * md_end: after the last cell. */
struct md_table md_begin(FILE *f, const char *caption, ...);
void md_column(struct md_table *t, const char *format, ...);
void md_add(struct md_table *t, const char *format, ...);
void md_end(struct md_table *t);

/* md_add_missing: n cells without a value. md_add_interval: a ratio with its interval, as far as they are known,
 * and a word or "" behind it. */
void md_add_missing(struct md_table *t, int n);
void md_add_interval(struct md_table *t, struct interval i, const char *mark);

#endif
