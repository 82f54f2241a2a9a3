/* report.h: the results as one self-contained page, report.html, and as Markdown.
 *
 * The page holds its pictures, plots, style and program in itself: it works from the file system without a network,
 * without its program (then as a static page), on paper, on a phone, in light and dark. Its sentences come from
 * findings.h, its tables from tables.h: nothing in it that depends on the results is typed in.
 *
 * Used by: output. Tests: test_report.c, test/report_browser.sh (in a browser).
 */
#ifndef ASBDPT_REPORT_H
#define ASBDPT_REPORT_H

#include <stdio.h>

#include "lab/results.h"

/* report_html: the pictures must have been written (pictures.h). Returns false with a message when one is missing.
 */
bool report_html(FILE *f, const struct results *r, struct error *err);

/* report_markdown: sentences and tables only. */
void report_markdown(FILE *f, const struct results *r);

/* report_style / report_script: the page's CSS and JavaScript. */
void report_style(FILE *f);
void report_script(FILE *f);

#endif
