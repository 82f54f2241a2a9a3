/* options.h: one reader for the options of every subcommand, driven by tables.
 *
 * A table is an array of rows: what an option is called, which kind of value it takes, within which range, where in the
 * subcommand's struct the value goes, and a line of help. The reader, the help and the tests go by the same rows. The
 * row that ends a table, without a name, may lead on to a table that several subcommands share.
 *
 *     --name VALUE, --name=VALUE, -n VALUE, -nVALUE    an option; given twice, the later one counts
 *     WORD                                             an operand: a row whose name has no dash in front
 *
 * An empty value is always a mistake, of a script for example whose variable is not set.
 * Tests: test_options.c, test/run/cli.sh. */
#ifndef ASBDPT_OPTIONS_H
#define ASBDPT_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "base/near.h"
#include "base/settings.h"

/* What a value is, and what it becomes. Numbers are from low to high. */
enum option_kind {
    OPTION_ON,      /* bool: becomes true; no value */
    OPTION_ELSEWHERE, /* none: it is refused with its line of help, which `help` leaves out */
    OPTION_INTEGER, /* int */
    OPTION_NUMBER,  /* double */
    OPTION_TIME,    /* double: seconds, or with a unit: 90s, 5m, 1h */
    OPTION_PIXEL,   /* int[2]: X,Y */
    OPTION_WIDTH,   /* int[2]: WIDTHxHEIGHT, of a picture that can be; xHEIGHT may be left out, and is 0 then */
    OPTION_RANGE,   /* int[2]: FIRST:END, the first less than the second */
    OPTION_LENGTHS, /* double[2]: so, too */
    OPTION_WINDOW,  /* double[4]: X0 X1 Y0 Y1 in four arguments, or with commas between; pairs, each the lesser first */
    OPTION_SEED,    /* uint64_t, any */
    OPTION_WORD,    /* const char *: one of `words`, which the help lists */
    OPTION_TEXT,    /* const char *, borrowed from the arguments */
    OPTION_PAIRS,   /* struct settings: one more each time, something, = and anything */
    OPTION_TEXTS,   /* struct texts: one more each time */
    OPTION_LIST     /* so, too: all arguments up to the next option */
};

/* What an option that may be repeated collects. */
struct texts {
    const char **item; /* [n], owned array of borrowed strings */
    int n;
};

struct option {
    const char *name;            /* "--spp"; without a dash an operand, then OPTION_TEXT or OPTION_TEXTS */
    const char *value;           /* what the help calls its value; NULL: it has none */
    enum option_kind kind;
    size_t offset;               /* of the target in the subcommand's struct */
    double low, high;            /* range of numbers; of texts: low 1 if one must be given */
    const char *alias;           /* another name, or NULL */
    const char *fallback;        /* text of the default; NULL: the target stays zero */
    const char *help;            /* where one must be given: what it is, with an article */
    bool written;                /* its texts name files that are written */
    const char *const *words;    /* of an OPTION_WORD: all there are, ended by NULL */
    const char *(*list)(char text[NAMES_TEXT]); /* what its help ends with, or NULL */
    const struct option *others; /* in the row without a name: the table that goes on, or NULL */
};

/* options_next: the row after this one, also in the tables that follow; NULL after the last. */
const struct option *options_next(const struct option *option);

/* options_read: set every fallback, then read the arguments.
 *   table   not empty
 *   argv    [argc]; argv[0] is the subcommand's name
 *   target  the subcommand's struct, all zeros
 * Returns false with a message on wrong usage. Either way options_free releases what the target's lists hold.
 * options_add: read arguments over what is there already; nothing needs to be given. */
bool options_add(const struct option *table, int argc, char **argv, void *target, struct error *err);
bool options_read(const struct option *table, int argc, char **argv, void *target, struct error *err);
void options_free(const struct option *table, void *target);

/* options_written: append the names of all rows that are `written`. options_print: the help of every row. */
void options_written(const struct option *table, void *target, struct texts *names);
void options_print(const struct option *table);

/* print_wrapped: words in lines of at most 100 columns; the first begins at `column`, the others at `indent`. */
void print_wrapped(const char *text, int column, int indent);

/* texts_differ: is no text there twice? False with a message on an output that has another file's name. */
void texts_add(struct texts *texts, const char *text);
bool texts_differ(const struct texts *outputs, struct error *err);

#endif
