/* source_position.h: where something stands in a scene file, and messages that point there.
 *
 * Every token knows its position, so every message can say FILE:LINE:COL, show the line and put a caret under the
 * column. It points into the text of the file, which is there while the file is read.
 * Tests: test_parser.c. */
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

/* One reading of a file. */
struct source_file {
    const char *path;
    const char *text, *end;  /* end[0] is a zero byte that does not belong to the file */
    struct source_position included_at; /* the Include directive; included_at.file is NULL for the main file */
    bool quotable; /* being read, and the main file or one that begins with a directive. Messages quote no line of
                    * another: it may be a file that is none of the scene's business */
};

/* Functions that receive each warning (one line) and each error (with its excerpt), without newline at the end, and the
 * place of each directive before it is carried out; `context` is passed through. Each may be NULL. */
struct message_sink {
    void (*warn)(void *context, const char *text);
    void (*error)(void *context, const char *text);
    void (*place)(void *context, struct source_position at);
    void *context;
};

enum { MOST_ERRORS = 20, MOST_WARNINGS = 100, MOST_ALIKE = 3 };

/* The messages that have been given, and how many were not. */
struct given {
    char *text[MOST_WARNINGS];      /* [n], owned */
    ptrdiff_t place[MOST_WARNINGS]; /* [n], how many characters say where it is */
    int n;
    long more;
};

/* Where messages go while one scene is read: each sentence for up to MOST_ALIKE places, up to MOST_ERRORS errors and
 * MOST_WARNINGS warnings. */
struct messages {
    struct error *err;               /* the first error; may be NULL */
    const struct message_sink *sink; /* may be NULL */
    struct given errors, warnings;   /* all zeros at first */
};

/* source_error: "FILE:LINE:COL: message", the line, a caret under the column, and from where the file was included.
 * Returns false, always. source_warn: the first line of such a message. */
bool source_error(struct messages *m, struct source_position at, const char *format, ...);
void source_warn(struct messages *m, struct source_position at, const char *format, ...);

/* messages_report: an error that has been put into m->err already, without a place of its own, goes to the sink. */
void messages_report(struct messages *m);

/* messages_end: say how many more there were, and release what is owned. */
void messages_end(struct messages *m);

#endif
