/* cmd_progress.c: asbdpt-lab progress: the bar (base/progress.h) of a script, which prints a line for each part of its
 * work that is done, into a pipe to this command. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "lab/commands.h"

struct progress_options {
    int parts;
    bool quiet;
};

#define AT(member) offsetof(struct progress_options, member)
static const struct option OPTIONS[] = {
    {"--parts", "N", OPTION_INTEGER, AT(parts), 1, 1e9, .fallback = "100",
     .help = "how many lines the script will print"},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "show nothing"},
    {.name = NULL},
};

static int run(void *options)
{
    const struct progress_options *o = options;
    enum { NAME = 14 };
    char line[256];
    struct progress bar;
    progress_start(&bar, o->quiet);
    for (double done = 0; fgets(line, sizeof line, stdin) != NULL;) {
        size_t n = strcspn(line, "\n");
        snprintf(bar.note, sizeof bar.note, ", %.*s", NAME < (int)n ? NAME : (int)n, line);
        done += line[n] == '\n'; /* else a piece of a longer line */
        progress_update(&bar, fmin(done / o->parts, 1));
    }
    progress_end(&bar);
    return EXIT_OK;
}

const struct command command_progress = {
    "progress", "how far a script is that prints a line for each part of its work", {"[--parts N] [--quiet]"}, OPTIONS,
    sizeof(struct progress_options), run, false, "progress --parts 280"};
