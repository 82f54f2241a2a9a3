/* family.h: methods compared at equal time (equal.h): what `asbdpt-lab equal-time` and `family` write.
 *
 * Files: a page of Markdown with the ratios to the first method and their intervals, the same with curves and pictures
 * as report.html (page.h), runs.csv with every picture's errors, and of few methods images/SCENE.png with all pictures.
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_FAMILY_H
#define ASBDPT_FAMILY_H

#include "lab/results.h"

void family_tables(FILE *f, const struct results *r); /* Markdown */

/* family_write: all files, into the plan's directory, what `page` writes by that name. False with a message. */
bool family_write(const struct results *r, const char *name, void (*page)(FILE *, const struct results *),
                  struct error *err);

#endif
