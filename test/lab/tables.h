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

/* Root mean square errors that the dissertation printed of one scene, on the 8-bit scale, against 16384 samples of
 * pbrt-v3's bdpt, in Bitterli's models, after 32, 64 ... 512 samples per pixel.                              [S24 4] */
enum { PUBLISHED_STEPS = 5 };
struct published {
    const char *scene; /* our name of the same situation */
    double asbdpt[PUBLISHED_STEPS], bdpt[PUBLISHED_STEPS];
};

/* published_find: by scene name; NULL for a scene the dissertation does not have. */
const struct published *published_find(const char *scene);

#endif
