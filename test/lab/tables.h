/* tables.h: the tables of an experiment, with the dissertation's numbers.
 *
 * Tests: test_report.c (cells equal a direct computation).
 */
#ifndef ASBDPT_TABLES_H
#define ASBDPT_TABLES_H

#include "lab/results.h"

/* tables_write: all tables of a scene, or of all scenes for NULL, as Markdown. */
void tables_write(FILE *f, const struct results *r, const struct scene_results *s);

#endif
