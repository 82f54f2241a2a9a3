/* command.c: see command.h. */
#include "cli/command.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int fail(const struct error *err)
{
    bool option = strncmp(err->text, "--", 2) == 0 || strncmp(err->text, "-P:", 3) == 0 ||
                  strncmp(err->text, "-o ", 3) == 0;
    fprintf(stderr, "asbdpt: %s\n", err->text);
    return option ? EXIT_USAGE : EXIT_JOB;
}

int command_end(int status)
{
    struct error err;
    errno = 0;
    if (fflush(stdout) == 0 && ferror(stdout) == 0)
        return status;
    error_set(&err, "standard output: cannot be written: %s", errno != 0 ? strerror(errno) : "write error");
    return fail(&err);
}

int usage_error(const struct command *command, const char *format, ...)
{
    struct error err;
    va_list args;
    va_start(args, format);
    vsnprintf(err.text, sizeof err.text, format, args);
    va_end(args);
    error_clean(err.text);
    fprintf(stderr, "asbdpt: %s; try %s %s%s--help\n", err.text, program.name, command != NULL ? command->name : "",
            command != NULL ? " " : "");
    return EXIT_USAGE;
}
