/* tables.h: the tables of an experiment: which results each shows, beside which published numbers.
 *
 * Tests: test_report.c (cells equal a direct computation).
 */
#ifndef ASBDPT_TABLES_H
#define ASBDPT_TABLES_H

#include "lab/table.h"

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

/* tables_write: all tables of a scene, or of all scenes for NULL. */
void tables_write(FILE *f, const struct results *r, const struct scene_results *s, bool html);

#endif
