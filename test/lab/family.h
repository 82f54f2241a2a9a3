/* family.h: all methods beside each other at equal time (equal_time.h): what `asbdpt-lab family` writes.
 *
 * Files: family.md has the tables, family.csv every render, family.svg ratios to the first method with their
 * intervals, family.png crops of all pictures.
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_FAMILY_H
#define ASBDPT_FAMILY_H

#include "lab/equal_time.h"

void family_tables(FILE *f, const struct equal_time *e); /* Markdown */
void family_figure(FILE *f, const struct equal_time *e); /* SVG: a row for each method, a column for each scene */

/* family_strip: family.png, crops of the pictures that equal_run has kept. False with a message. */
bool family_strip(const struct equal_time *e, struct error *err);

/* family_write: all files, into plan->directory, from pictures that equal_run has kept. Returns false with a
 * message. */
bool family_write(const struct equal_time *e, struct error *err);

#endif
