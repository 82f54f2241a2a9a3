/* report.h: everything an experiment leaves in its directory with its runs: numbers, a page of Markdown with the
 * tables, and the same with curves and pictures as report.html.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_REPORT_H
#define ASBDPT_REPORT_H

#include "lab/results.h"

/* report_write: runs.csv, results.md, report.html and its images/ in plan->directory. False with a message. */
bool report_write(const struct results *r, struct error *err);

#endif
