/* error.h: one line about what went wrong, carried upwards to main.
 *
 * A function that can fail because of what the user gave it (a file, a scene, a number) returns bool and
 * takes a `struct error *err`; on false it has filled err. Only main.c prints it and leaves the program, so
 * every such function can be tested in-process.
 *
 * Used by: every module that reads or writes something.
 */
#ifndef ASBDPT_ERROR_H
#define ASBDPT_ERROR_H

#include <stdbool.h>

enum { ERROR_TEXT_SIZE = 1024 };

struct error {
    char text[ERROR_TEXT_SIZE]; /* the whole message without the leading "asbdpt: "; may hold several lines */
};

/* error_set: write a message, printf style, cutting it at the buffer's end.
 *   err  out, may be NULL (then nothing is written)
 * Returns false, always, so that a failing function can `return error_set(err, ...)`. */
bool error_set(struct error *err, const char *format, ...);

#endif
