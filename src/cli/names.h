/* names.h: all files that a command reads and writes, so that none of them takes another one's place.
 *
 * Names are compared by what they lead to, not by how they are spelled: a file that is there by its device and number,
 * one that is not by its directory and its name in that. Devices and pipes may have several names; standard input can
 * be read by one only, and standard output written by one, which a command that prints is itself.
 * Tests: test/outputs.sh. */
#ifndef ASBDPT_NAMES_H
#define ASBDPT_NAMES_H

#include "base/error.h"
#include "cli/options.h"

struct names {
    struct name *item; /* [n], owned */
    int n;
};

/* names_add: one more, given by `what`, an option for example. False with a message if another one of the table is the
 * same file, and one of the two is written. Files that are read and written in turn (FILE_KEPT) may be the same.
 * names_add_options: all that the rows of a table of options say are files, of a target after options_read. */
bool names_add(struct names *all, enum option_file use, const char *what, const char *path, struct error *err);
bool names_add_options(struct names *all, const struct option *table, void *target, struct error *err);
void names_free(struct names *all);

/* names_same: do both lead to the same file, be it there or not? */
bool names_same(const char *a, const char *b);

#endif
