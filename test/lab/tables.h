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
    TABLE_ALL_COST,
    TABLE_RMSE, /* of one scene */
    TABLE_PRINTED,
    TABLE_COST,
    TABLE_BIAS,
    TABLE_SWEEP, /* and one more for each other sweep */
};

/* table_make: table number `which`, an enum table_kind.
 *   s  the scene; not looked at for the tables of all
 * Returns false when the experiment has nothing to show in it (then nothing needs release). */
bool table_make(const struct results *r, const struct scene_results *s, int which, struct table *out);

/* tables_write: all tables of a scene, or of all scenes for NULL, as Markdown. */
void tables_write(FILE *f, const struct results *r, const struct scene_results *s);

#endif
