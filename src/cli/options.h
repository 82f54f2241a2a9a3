/* options.h: one reader for the options of every subcommand, driven by tables.
 *
 * A table is an array of rows: what an option is called, which kind of value it takes, within which range, where in the
 * subcommand's struct the value goes, and a line of help. The reader, the help and the tests go by the same rows. The
 * row that ends a table, without a name, may lead on to a table that several subcommands share.
 *
 *     --name VALUE, --name=VALUE, -n VALUE, -nVALUE    an option; given twice, the later one counts
 *     WORD                                             an operand: a row whose name has no dash in front
 *
 * How a value is called says how it is read: words in capitals are numbers, with what stands between them.
 *
 *     WIDTHxHEIGHT, X,Y     several numbers, up to four
 *     FIRST:END             the first less than the second
 *     X0 X1 Y0 Y1           a blank is the next argument, or a comma; pairs, each the lesser first
 *     WIDTH[xHEIGHT]        what is in brackets may be left out, and is 0 then
 *     TIME                  seconds, or with a unit: 90s, 5m, 1h
 *     NAME=VALUE            of texts: something, = and anything
 *     FILE...               of texts: all arguments up to the next option
 *
 * An empty value is always a mistake, of a script for example whose variable is not set.
 *
 * Tests: test_options.c, test/cli.sh.
 */
#ifndef ASBDPT_OPTIONS_H
#define ASBDPT_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

enum option_kind {  /* type of the target */
    OPTION_ON,      /* bool: becomes true; no value */
    OPTION_INTEGER, /* int, or int[]; each from low to high */
    OPTION_NUMBER,  /* double, or double[]; each from low to high */
    OPTION_SEED,    /* uint64_t, any */
    OPTION_TEXT,    /* const char *, borrowed from the arguments */
    OPTION_TEXTS    /* struct texts: one more each time */
};

/* What is done with a file that a text names (names.h); FILE_KEPT: it is read if it is there, and written. */
enum option_file { FILE_NONE, FILE_READ, FILE_WRITTEN, FILE_KEPT };

/* What an option that may be repeated collects. */
struct texts {
    const char **item; /* [n], owned array of borrowed strings */
    int n;
    size_t capacity;
};

struct option {
    const char *name;            /* "--spp"; without a dash an operand, then of kind OPTION_TEXT or OPTION_TEXTS */
    const char *value;           /* what the help calls its value, see above; NULL: it has none */
    enum option_kind kind;
    size_t offset;               /* of the target in the subcommand's struct */
    double low, high;            /* range of numbers; of texts: low 1 if one must be given */
    const char *alias;           /* another name, or NULL */
    const char *fallback;        /* text of the default; NULL: the target stays zero */
    const char *help;            /* where one must be given: what it is, with an article */
    enum option_file file;
    const char *with;            /* the option without which this one has no effect, or NULL */
    const char *without;         /* options that would have no effect beside it, with blanks between them, or NULL */
    const struct option *others; /* in the row without a name: the table that goes on, or NULL */
};

/* options_next: the row after this one, also in the tables that follow; NULL after the last. */
const struct option *options_next(const struct option *option);

/* options_read: set every fallback, then read the arguments.
 *   table   not empty
 *   argv    [argc]; argv[0] is the subcommand's name
 *   target  the subcommand's struct, all zeros
 * Returns false with a message on wrong usage. Either way options_free releases what the target's lists hold. */
bool options_read(const struct option *table, int argc, char **argv, void *target, struct error *err);
void options_free(const struct option *table, void *target);

/* options_texts: the texts that an option has in `target`, *n of them. */
const char *const *options_texts(const struct option *option, void *target, int *n);

/* options_print: the help of every row. */
void options_print(const struct option *table);

/* print_wrapped: words in lines of at most 100 columns, all but the first moved in by `indent`.
 *   column  where the first line is */
void print_wrapped(const char *text, int column, int indent);

void texts_add(struct texts *texts, const char *text);

#endif
