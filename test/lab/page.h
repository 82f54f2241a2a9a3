/* page.h: the CSS and the JavaScript of the report's page.
 *
 * Tests: test/report_browser.sh (in a browser).
 */
#ifndef ASBDPT_PAGE_H
#define ASBDPT_PAGE_H

#include <stdio.h>

/* page_style, page_script: the contents of the style and script elements; errors stick to the stream. */
void page_style(FILE *f);
void page_script(FILE *f);

#endif
