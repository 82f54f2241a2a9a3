/* command.h: what a subcommand of the command line is, and a program that is made of some.
 *
 * A subcommand names its options (options.h) and does its work on the struct that they fill. Its exit status is the
 * program's. Messages go to stderr through the helpers here. */
#ifndef ASBDPT_COMMAND_H
#define ASBDPT_COMMAND_H

#include <stddef.h>

#include "base/error.h"
#include "library/options.h"

enum { EXIT_OK = 0, EXIT_JOB = 1, EXIT_USAGE = 2 }; /* success, failure of the job, wrong usage */

struct command {
    const char *name, *help;
    const char *usage[4];         /* its forms after its name, ended by NULL */
    const struct option *options; /* table */
    size_t size;                  /* of the struct that the options fill */
    int (*run)(void *options);    /* returns the exit status */
    bool prints;                  /* to standard output, which no file of its options can be then */
    const char *example;          /* what follows the program's name */
};

extern const struct command command_render, command_merge, command_convert;

/* A program: its name and its commands. Shared code takes all names from here. asbdpt has its own in
 * program.c, the laboratory another one. */
struct program {
    const char *name;
    const char *title, *about;             /* a line and a paragraph for the help */
    const struct command *const *commands; /* ended by NULL */
    const struct command *unnamed;         /* meant where none of them is named, or NULL */
    const char *elsewhere;                 /* "; PROGRAM has more", or "" */
};
extern const struct program program;

/* fail / usage_error: print "asbdpt: message" and return EXIT_JOB / EXIT_USAGE; of a message about a word of the
 * command line (error.h) fail returns EXIT_USAGE, too.
 *   command  whose help the message points to; NULL: everybody's */
int fail(const struct error *err);
int usage_error(const struct command *command, const char *format, ...);

/* job_failed: say why a scene cannot be loaded, unless that has been said; returns the exit status. */
int job_failed(const struct error *err);

/* command_line: what the program does with its arguments, argv[0] being its own name. Returns the exit status, which is
 * EXIT_JOB with a message where something that was printed could not be written. */
int command_line(int argc, char **argv);

#endif
