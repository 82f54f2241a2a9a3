/* dispatch.c: see dispatch.h. */
#include "cli/dispatch.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/version.h"
#include "cli/command.h"
#include "cli/manual.h"
#include "cli/names.h"
#include "parser/symbols.h"

/* --- help --------------------------------------------------------------------------------------------- */

/* Does this table lead on to those rows? */
static bool leads_to(const struct option *table, const struct option *rows)
{
    while (table != NULL && table != rows)
        table = options_next(table);
    return table != NULL;
}

/* Options that are the first subcommand's, too, are told there. */
static void print_command(const struct command *c, bool alone)
{
    printf("%s %s: %s\n", program.name, c->name, c->help);
    for (int i = 0; c->usage[i] != NULL; i++)
        printf("%s %s %s %s\n", i == 0 ? "usage:" : "   or:", program.name, c->name, c->usage[i]);
    for (const struct option *table = c->options; table != NULL;) {
        if (!alone && c != program.commands[0] && leads_to(program.commands[0]->options, table)) {
            printf("    and the options of %s, from %s on\n", program.commands[0]->name, table->name);
            break;
        }
        table = options_print(table);
    }
}

static void print_help(void)
{
    printf("%s: %s\n\n", VERSION, program.title);
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        print_command(*c, false);
        printf("\n");
    }
    manual_print_integrators();
    printf("\n%s help man, bash, zsh: a man page, completions\n"
           "exit status: 0 success, 1 the job failed, 2 wrong usage\n", program.name);
}

static bool asks_for_help(const char *word) { return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0; }

/* --- the command line --------------------------------------------------------------------------------- */

/* Do results stay beyond a double's bits until they are stored, as on the x87? (C99's FLT_EVAL_METHOD says so too, but
 * not all compilers have it.) */
static bool keeps_more_bits(void)
{
    volatile double one = 1, tiny = DBL_EPSILON / 4;
    return one + tiny - one != 0;
}

/* Is every file of the command line another one? */
static bool files_apart(const struct command *c, void *options, struct error *err)
{
    struct names all = {0};
    bool ok = (!c->prints || names_add(&all, FILE_WRITTEN, "what it prints to", "-", err)) &&
              names_add_options(&all, c->options, options, err);
    names_free(&all);
    return ok;
}

static int run(const struct command *c, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (asks_for_help(argv[i])) {
            print_command(c, true);
            return EXIT_OK;
        }
    struct error err;
    void *options = mem_alloc(1, c->size);
    bool ok = options_read(c->options, argc, argv, options, &err) && files_apart(c, options, &err);
    int status = ok ? c->run(options) : usage_error(c, "%s", err.text);
    options_free(c->options, options);
    free(options);
    return status;
}

/* help, help COMMAND, help man|bash|zsh */
static int help(const char *topic)
{
    if (topic == NULL) {
        print_help();
        return EXIT_OK;
    }
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        if (strcmp(topic, (*c)->name) == 0) {
            print_command(*c, true);
            return EXIT_OK;
        }
    return manual_print(topic, VERSION) ? EXIT_OK : usage_error(NULL, "there is no help on %s", topic);
}

int command_line(int argc, char **argv)
{
    if (argc < 2)
        return usage_error(NULL, "which command?");
    if (asks_for_help(argv[1]) || strcmp(argv[1], "help") == 0)
        return help(argc > 2 ? argv[2] : NULL);
    if (strcmp(argv[1], "--version") == 0) {
        printf("%s\n", VERSION);
        if (keeps_more_bits())
            printf("built for arithmetic that keeps more bits than a double has (FLT_EVAL_METHOD is not 0): pictures "
                   "differ in their last bits from those of other builds\n");
        return EXIT_OK;
    }
    struct suggestion s = suggest_start(argv[1]);
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        if (strcmp(argv[1], (*c)->name) == 0)
            return run(*c, argc - 1, argv + 1);
        suggest_offer(&s, (*c)->name);
    }
    if (s.name == NULL)
        return usage_error(NULL, "unknown command %s", argv[1]);
    return usage_error(NULL, "unknown command %s (did you mean %s?)", argv[1], s.name);
}
