/* markup.h: text and pictures as XML and HTML want them.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_MARKUP_H
#define ASBDPT_MARKUP_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* xml_text: text with the characters that XML and HTML reserve escaped. */
void xml_text(FILE *f, const char *text);

/* xml_print: printf for markup: what stands for %s is escaped, the format is not. Beside %s it knows %d, %ld, %f, %g
 * with flags, width and precision, and no %%. */
void xml_print(FILE *f, const char *format, ...);

/* base64: bytes as text [RFC 4648 4]. */
void base64(FILE *f, const uint8_t *data, size_t size);

#endif
