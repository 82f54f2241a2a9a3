/* error.h: one line about what went wrong, carried upwards to main.
 *
 * A function that can fail because of what the user gave it (a file, a scene, a number) returns bool and
 * takes a `struct error *err`; on false it has filled err. Only main.c prints it and leaves the program, so
 * every such function can be tested in-process. Tests: test_file.c, test_parser.c. */
#ifndef ASBDPT_ERROR_H
#define ASBDPT_ERROR_H

#include <stdbool.h>

enum { ERROR_TEXT_SIZE = 1024 };

struct error {
    char text[ERROR_TEXT_SIZE]; /* the whole message without the leading "asbdpt: "; may hold several lines */
    bool usage;                 /* it is about a word of the command line */
};

/* error_set: write a message of one line, printf style, cleaned (see below) and cut at the buffer's end; `err` may be
 * NULL. error_usage: the same about a word of the command line. Both return false, always, so that a failing function
 * can `return error_set(err, ...)`. */
#define error_set(err, ...) error_write(err, false, __VA_ARGS__)
#define error_usage(err, ...) error_write(err, true, __VA_ARGS__)
bool error_write(struct error *err, bool usage, const char *format, ...);

/* error_clean: make text that may come from a damaged or hostile file fit for a terminal, in place: every byte that is
 * no part of a printable character becomes '?'. printable_length: bytes of the printable character, in UTF-8, that a
 * text begins with; 0 if there is none. */
void error_clean(char *text);
int printable_length(const char *text);

/* say_line: a line on stderr, printf style, cleaned: what it quotes may be a file's. All messages go through it. */
void say_line(const char *format, ...);

#endif
