/* report.h: everything an experiment leaves in its directory with its runs: numbers, pictures, plots, and the tables
 * with all these as one page of Markdown, which doc/html.sh makes HTML of.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_REPORT_H
#define ASBDPT_REPORT_H

#include "lab/results.h"

/* report_write: images/, plots/, runs.csv and results.md in plan->directory. False with a message. */
bool report_write(const struct results *r, struct error *err);

#endif
