/* markup.h: text and numbers as XML, HTML, JSON and CSV want them.
 *
 * Used by: plot, table, results_file, report. Tests: test_report.c.
 */
#ifndef ASBDPT_MARKUP_H
#define ASBDPT_MARKUP_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* xml_text: text with the characters that XML and HTML reserve escaped. */
void xml_text(FILE *f, const char *text);

/* json_text: a JSON string with its quotes. */
void json_text(FILE *f, const char *text);

/* json_number: nine digits; null for what is not finite.  csv_number: the same, an empty field instead of null. */
void json_number(FILE *f, double v);
void csv_number(FILE *f, double v);

/* base64: bytes as text [RFC 4648 4]. */
void base64(FILE *f, const uint8_t *data, size_t size);

#endif
