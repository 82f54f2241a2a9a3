/* tables.h: the tables of an experiment: which results each shows, beside which published numbers; written as HTML or
 * as Markdown from the same cells.
 *
 * Tests: test_report.c (cells equal a direct computation).
 */
#ifndef ASBDPT_TABLES_H
#define ASBDPT_TABLES_H

#include "lab/results.h"

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

enum table_kind {
    TABLE_SETUP, /* of all scenes together */
    TABLE_ALL_RMSE,
    TABLE_ALL_EQUAL_TIME,
    TABLE_RMSE, /* of one scene */
    TABLE_PUBLISHED,
    TABLE_EQUAL_TIME,
    TABLE_BIAS,
    TABLE_PATHS,
    TABLE_RESTART,
    N_TABLES
};

/* table_make:
 *   s  the scene; not looked at for the tables of all
 * Returns false when the experiment has nothing to show in it (then nothing needs release). */
bool table_make(const struct results *r, const struct scene_results *s, enum table_kind which, struct table *out);
void table_free(struct table *t);

size_t table_rows(const struct table *t);

/* tables_write: all tables of a scene, or of all scenes for NULL. */
void tables_write(FILE *f, const struct results *r, const struct scene_results *s, bool html);

#endif
