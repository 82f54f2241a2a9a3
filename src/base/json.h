/* json.h: writing JSON, a value at a time; commas and indentation come by themselves.                       [RFC 8259]
 *
 *     struct json j = json_start(stdout);
 *     json_open(&j, NULL, '{');
 *     json_text(&j, "name", name);
 *     json_open(&j, "seeds", '[');  json_count(&j, NULL, 3);  json_count(&j, NULL, 4);  json_close(&j);
 *     json_close(&j);
 * Tests: test_file.c. */
#ifndef ASBDPT_JSON_H
#define ASBDPT_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { JSON_DEPTH = 16 };

struct json {
    FILE *file; /* borrowed; look at ferror in the end */
    int depth;
    char closing[JSON_DEPTH]; /* bracket of every open object and array */
    bool empty; /* the innermost holds nothing yet */
};

struct json json_start(FILE *file);

/* json_open: begin an object '{' or an array '['; `name` is NULL but within an object. json_close ends the innermost
 * one; the last ends the line. */
void json_open(struct json *j, const char *name, char kind);
void json_close(struct json *j);

/* json_number: with 17 digits, so that it is read back as it was; null if it is not finite. json_numbers: an array [n]
 * of these on one line. json_text: quoted; a byte that is no part of UTF-8 becomes U+FFFD. NULL becomes null.
 * json_word: not quoted, as true. */
void json_number(struct json *j, const char *name, double value);
void json_numbers(struct json *j, const char *name, const double *values, int n);
void json_count(struct json *j, const char *name, uint64_t value); /* with all its digits */
void json_text(struct json *j, const char *name, const char *text);
void json_word(struct json *j, const char *name, const char *word);

#endif
