/* report.h: everything an experiment leaves in its directory: pictures, plots, numbers, and the results as one
 * self-contained page, report.html, and as Markdown.
 *
 * The page holds its pictures, plots, style and program in itself: it works from the file system without a network,
 * without its program (then as a static page), on paper, on a phone, in light and dark. Its sentences come from
 * findings.h, its tables from tables.h: nothing in it that depends on the results is typed in.
 *
 * Tests: test_report.c, test/report_browser.sh (in a browser).
 */
#ifndef ASBDPT_REPORT_H
#define ASBDPT_REPORT_H

#include "lab/results.h"

/* report_write: images, plots, results.csv, runs.csv, results.md and report.html in plan->directory. Returns false with
 * a message. */
bool report_write(const struct results *r, struct error *err);

#endif
