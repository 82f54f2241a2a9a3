/* source_position.h: where something stands in a scene file, and messages that point there.
 *
 * Every token knows its position, so every message can say FILE:LINE:COL, show the line and put a caret under the
 * column. Texts of files are kept until the parse is over; positions point into them.
 *
 * Tests: test_parser.c.
 */
#ifndef ASBDPT_SOURCE_POSITION_H
#define ASBDPT_SOURCE_POSITION_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

struct source_file;

/* A column of a line of a file. */
struct source_position {
    const struct source_file *file;
    const char *line_start; /* first character of the line, inside file->text */
    int line, column;       /* from 1; a tab counts as one column */
};

/* One reading of a file. A file included twice is two of these that share a text. */
struct source_file {
    const char *path;
    const char *text, *end;  /* end[0] is a zero byte that does not belong to the file */
    struct source_position included_at; /* the Include directive; included_at.file is NULL for the main file */
};

/* A function that receives each warning, one line without newline; `context` is passed through. */
struct warning_sink {
    void (*warn)(void *context, const char *text);
    void *context;
};

/* Where messages go while one scene is read. */
struct messages {
    struct error *err;               /* the first error; may be NULL */
    const struct warning_sink *sink; /* may be NULL */
    const char **given;              /* [n_given] kinds of warnings that were given already, owned */
    size_t n_given, capacity;
};

/* source_error: "FILE:LINE:COL: message", the line, a caret under the column, and from where the file was included.
 * Returns false, always. */
bool source_error(struct messages *m, struct source_position at, const char *format, ...);

/* source_warn: the same on one line, to the sink, once per kind. `kind` must be a string constant. */
void source_warn(struct messages *m, struct source_position at, const char *kind, const char *format, ...);

/* source_position_text: "FILE:LINE:COL" into the buffer, cut at its end. */
void source_position_text(struct source_position at, char *buffer, size_t size);

void messages_free(struct messages *m);

/* text_read: a whole file as a zero-terminated text, to be given to free(); NULL with a message (path and reason).
 *   size  out: bytes without the zero */
char *text_read(const char *path, size_t *size, struct error *err);

#endif
