/* tables.h: the tables of an experiment: which results each shows, beside which published numbers.
 *
 * Used by: report, summary. Tests: test_report.c (cells equal a direct computation).
 */
#ifndef ASBDPT_TABLES_H
#define ASBDPT_TABLES_H

#include "lab/results.h"
#include "lab/table.h"

/* Of one scene. */
enum scene_table {
    TABLE_RMSE,
    TABLE_PUBLISHED,
    TABLE_EQUAL_TIME,
    TABLE_BIAS,
    TABLE_PATHS,
    TABLE_RESTART,
    N_SCENE_TABLES
};

/* tables_scene: make one. Returns false when the experiment has nothing to show in it (then nothing needs release).
 */
bool tables_scene(const struct results *r, const struct scene_results *s, enum scene_table which,
                  struct table *out);

/* Of all scenes together. */
enum total_table { TOTAL_SETUP, TOTAL_RMSE, TOTAL_EQUAL_TIME, N_TOTAL_TABLES };
void tables_total(const struct results *r, enum total_table which, struct table *out);

#endif
