/* report.h: everything an experiment leaves in its directory with its runs: numbers, pictures, and a page of Markdown
 * with the tables.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_REPORT_H
#define ASBDPT_REPORT_H

#include "lab/results.h"

/* report_write: images/, runs.csv and results.md in plan->directory. False with a message. */
bool report_write(const struct results *r, struct error *err);

#endif
