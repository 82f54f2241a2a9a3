/* command.c: see command.h. */
#include "cli/command.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/near.h"
#include "base/version.h"
#include "integrators/method.h"
#include "render/job.h"

/* --- messages ----------------------------------------------------------------------------------------- */

int fail(const struct error *err)
{
    say_line("asbdpt: %s", err->text);
    return err->usage ? EXIT_USAGE : EXIT_JOB;
}

int usage_error(const struct command *command, const char *format, ...)
{
    struct error err;
    va_list args;
    va_start(args, format);
    vsnprintf(err.text, sizeof err.text, format, args);
    va_end(args);
    size_t n = strlen(err.text);
    say_line("asbdpt: %s%s try %s %s%s--help", err.text, n > 0 && err.text[n - 1] == '?' ? "" : ";", program.name,
             command != NULL ? command->name : "", command != NULL ? " " : "");
    return EXIT_USAGE;
}

int job_failed(const struct error *err) { return err->text[0] != '\0' ? fail(err) : EXIT_JOB; }

/* --- help --------------------------------------------------------------------------------------------- */

static void print_command(const struct command *c)
{
    printf("%s %s: ", program.name, c->name);
    print_wrapped(c->help, (int)(strlen(program.name) + strlen(c->name)) + 3, 4);
    for (int i = 0; c->usage[i] != NULL; i++)
        printf("%s %s %s %s\n", i == 0 ? "usage:" : "   or:", program.name, c->name, c->usage[i]);
    printf(" e.g.: %s %s\n", program.name, c->example);
    options_print(c->options);
}

static void print_parameters(const struct field *p)
{
    enum { HELP = 36 };
    char fallback[64];
    for (; p->name != NULL; p++) {
        field_fallback(p, fallback, sizeof fallback);
        printf("    %-20s %-10s ", p->name, fallback);
        print_wrapped(p->help, HELP, HELP);
    }
}

/* What the parameter `race` is about. */
static void print_runners(void)
{
    printf("\n");
    print_wrapped("Runners: ways to render. With race=on each takes a few samples that no image uses, and the one with "
                  "the least variance times price renders, one of the last two only if it is less than three quarters "
                  "of the others'. None gives light up. asbdpt-lab info --race SCENE.pbrt shows "
                  "what was found.", 0, 0);
    static const char *const HELPS[RUNNERS] = {
        "as the parameters say: pathpixels, connections, later, lightpoints",
        "a light sub-path for four times as many pixels",
        "light sub-paths in one of 32 iterations of a tile; none where all is diffuse",
        "so, too; one light point for each eye vertex"};
    for (int i = 0; i < RUNNERS; i++) {
        printf("    %-20s ", runner_name(i));
        print_wrapped(HELPS[i], 25, 25);
    }
}

/* Rows of the table with the same name are one integrator, and as many selections. */
static void print_integrators(void)
{
    const char *before = "";
    printf("Integrators (--integrator NAME) and their parameters with defaults: -P NAME=VALUE, or in the\n"
           "scene's Integrator directive. If one is given twice, an option such as --maxdepth overrides -P, and\n"
           "-P overrides the scene.\n\nall\n");
    print_parameters(job_common());
    for (const struct method *const *m = method_rows; *m != NULL; before = (*m++)->name) {
        if (strcmp((*m)->name, before) != 0)
            printf("\n%s\n", (*m)->name);
        if ((*m)->select != NULL)
            printf("  -P select=%s\n", (*m)->select);
        printf("    ");
        print_wrapped((*m)->help, 4, 4);
        if ((*m)->parameters != NULL)
            print_parameters((*m)->parameters);
        if ((*m)->own != NULL)
            print_parameters((*m)->own);
    }
    print_runners();
}

static void print_help(void)
{
    printf("%s: %s\n\n", VERSION, program.title);
    print_wrapped(program.about, 0, 0);
    printf("\n");
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        printf("    %-12s ", (*c)->name);
        print_wrapped((*c)->help, 17, 17);
    }
    printf("\n%s COMMAND --help        show its options, their defaults and an example\n"
           "%s help integrators      show the integrators and their parameters\n", program.name, program.name);
    if (program.unnamed != NULL)
        printf("%s SCENE.pbrt ...        the same as %s %s SCENE.pbrt ...\n", program.name, program.name,
               program.unnamed->name);
    printf("exit status: 0 success, 1 the job failed, 2 wrong usage, 128 + N stopped by signal N\n");
}

/* All that there is, as for a man page. */
static void print_all(void)
{
    print_help();
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        printf("\n");
        print_command(*c);
    }
    printf("\n");
    print_integrators();
}

/* --- the command line --------------------------------------------------------------------------------- */

static bool asks_for_help(const char *word) { return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0; }

/* Does every output have a name of its own? */
static bool outputs_differ(const struct command *c, void *options, struct error *err)
{
    struct texts names = {0};
    if (c->prints)
        texts_add(&names, "-");
    options_written(c->options, options, &names);
    bool ok = texts_differ(&names, err);
    free(names.item);
    return ok;
}

static int run(const struct command *c, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (asks_for_help(argv[i])) {
            print_command(c);
            return EXIT_OK;
        }
    struct error err;
    void *options = mem_alloc(1, c->size);
    bool ok = options_read(c->options, argc, argv, options, &err) && outputs_differ(c, options, &err);
    int status = ok ? c->run(options) : usage_error(c, "%s", err.text);
    options_free(c->options, options);
    free(options);
    return status;
}

/* Which command, or word that may stand in its place, was meant by one that is none. */
static struct near near_command(const char *name, const char *const *others)
{
    struct near near = near_of(name, others);
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        near_try(&near, (*c)->name);
    return near;
}

/* help, help COMMAND, help integrators, help all */
static int help(const char *topic)
{
    static const char *const TOPICS[] = {"integrators", "all", NULL};
    for (const struct command *const *c = program.commands; topic != NULL && *c != NULL; c++)
        if (strcmp(topic, (*c)->name) == 0) {
            print_command(*c);
            return EXIT_OK;
        }
    if (topic == NULL)
        print_help();
    else if (strcmp(topic, "integrators") == 0)
        print_integrators();
    else if (strcmp(topic, "all") == 0)
        print_all();
    else
        return usage_error(NULL, "there is no help on %s%s", topic, near_command(topic, TOPICS).text);
    return EXIT_OK;
}

/* What the arguments ask for. */
static int obey(int argc, char **argv)
{
    if (argc < 2)
        return usage_error(NULL, "which command?");
    if (asks_for_help(argv[1]) || strcmp(argv[1], "help") == 0)
        return help(argc > 2 ? argv[2] : NULL);
    if (strcmp(argv[1], "--version") == 0) {
        printf("%s\n", VERSION);
        return EXIT_OK;
    }
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        if (strcmp(argv[1], (*c)->name) == 0)
            return run(*c, argc - 1, argv + 1);
    if (program.unnamed != NULL && (argv[1][0] == '-' || file_has_extension(argv[1], ".pbrt")))
        return run(program.unnamed, argc, argv);
    struct near near = near_command(argv[1], (const char *const[]){"help", NULL});
    return usage_error(NULL, "unknown command %s%s", argv[1], near.name != NULL ? near.text : program.elsewhere);
}

int command_line(int argc, char **argv)
{
    int status = obey(argc, argv);
    struct error err;
    errno = 0;
    if (fflush(stdout) == 0 && ferror(stdout) == 0)
        return status;
    error_set(&err, "standard output: cannot be written: %s", errno != 0 ? strerror(errno) : "write error");
    return fail(&err);
}
