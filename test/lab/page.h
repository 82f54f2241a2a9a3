/* page.h: report.html, what experiment, equal-time and family leave for the eye: one file that needs no other.
 *
 * It holds the page of Markdown that lies next to it, and for each scene the curves of error over CPU time and over
 * samples on logarithmic axes, and every compared method's picture with its errors as colours. The script of the page
 * makes tables, curves and colours of what is in it: text, numbers and PNGs.
 *
 * Tests: test_report.c, test_equal_time.c, test/run/report.sh.
 */
#ifndef ASBDPT_LAB_PAGE_H
#define ASBDPT_LAB_PAGE_H

#include "lab/results.h"

/* page_write: report.html, and images/SCENE--METHOD.png of all that it shows, into the plan's directory.
 *   title     of the page
 *   markdown  name of the page of Markdown, which is there already; "## SCENE" heads what belongs to a scene
 *   printed   what the dissertation printed of this scene, method and number of samples, or NaN; NULL: nothing
 * Returns false with a message. */
bool page_write(const struct results *r, const char *title, const char *markdown,
                double (*printed)(const char *scene, const char *method, long spp), struct error *err);


#endif
