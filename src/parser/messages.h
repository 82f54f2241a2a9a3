/* messages.h: where messages about a scene go, and the positions in its files that they begin with.
 *
 * Every token knows its position, so every message begins with FILE:LINE:COL.
 * Tests: test_parser.c. */
#ifndef ASBDPT_MESSAGES_H
#define ASBDPT_MESSAGES_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

/* One reading of a file. */
struct source_file {
    const char *path;
    char *text;      /* released by the lexer that has entered the file (lexer.h); places need the path alone */
    const char *end; /* of the text: a zero byte that does not belong to the file */
    bool is_scene;   /* the main file, or one that begins with a directive */
};

/* A column of a line of a file. */
struct source_position {
    const struct source_file *file;
    int line, column; /* from 1; a tab counts as one column */
};

/* Who hears each error and each warning, one line without newline at the end. */
struct message_sink {
    void (*hear)(void *context, bool is_error, const char *text);
    void *context;
};

enum { MOST_ERRORS = 20, MOST_WARNINGS = 100, MOST_ALIKE = 3 };

/* The messages that have been given, and how many were not. */
struct given {
    char *sentence[MOST_WARNINGS]; /* [n], without their places; owned */
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

/* source_error: "FILE:LINE:COL: message". Returns false, always. source_warn: the same as a warning. */
bool source_error(struct messages *m, struct source_position at, const char *format, ...);
void source_warn(struct messages *m, struct source_position at, const char *format, ...);

/* messages_report: an error that has been put into m->err already, without a place of its own, goes to the sink. */
void messages_report(struct messages *m);

/* messages_end: say how many more there were, and release what is owned. */
void messages_end(struct messages *m);

#endif
