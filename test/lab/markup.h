/* markup.h: text as XML wants it.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_MARKUP_H
#define ASBDPT_MARKUP_H

#include <stdio.h>

/* xml_print: printf for markup: the text for %s is escaped, the format is not. It also knows %d, %ld, %f, %g
 * with flags, width and precision, and no %%. */
void xml_print(FILE *f, const char *format, ...);

#endif
