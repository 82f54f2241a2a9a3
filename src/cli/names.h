/* names.h: all files that a command reads and writes, so that no output takes the place of another file.
 *
 * Two names are the same file if they are spelled alike. Only one option can read standard input, and only one can
 * write standard output; a command that prints does so itself. Tests: test/outputs.sh. */
#ifndef ASBDPT_NAMES_H
#define ASBDPT_NAMES_H

#include "base/error.h"
#include "cli/options.h"

struct names {
    struct name *item; /* [n], owned */
    int n;
};

/* names_add: one more, given by `what`, an option for example. False with a message if the table has the name already
 * and one of the two is written. Files that are read and written in turn (FILE_KEPT) may have the same name.
 * names_add_options: all that the rows of a table of options say are files, of a target after options_read. */
bool names_add(struct names *all, enum option_file use, const char *what, const char *path, struct error *err);
bool names_add_options(struct names *all, const struct option *table, void *target, struct error *err);
void names_free(struct names *all);

#endif
