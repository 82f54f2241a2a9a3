/* manual.c: see manual.h. */
#include "cli/manual.h"

#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "render/parameters.h"

static void print_parameters(const struct method_parameter *p)
{
    char fallback[64];
    for (; p != NULL && p->name != NULL; p++) {
        parameter_fallback(p, fallback, sizeof fallback);
        printf("             %-12s %-10s %s\n", p->name, fallback, p->help);
    }
}

/* "asbdpt -P select=bins", or "bdpt". */
static void name_method(const struct method *m, char *out, size_t size)
{
    snprintf(out, size, m->select != NULL ? "%s -P select=%s" : "%s", m->name, m->select);
}

void manual_print_integrators(void)
{
    char name[64];
    printf("integrators and their parameters (-P NAME=VALUE, or in the scene's Integrator directive;\n"
           "of what is given twice, an option like --maxdepth counts before -P, and -P before the scene):\n    all\n");
    print_parameters(parameters_common());
    for (const struct method *const *m = method_list(); *m != NULL; m++) {
        name_method(*m, name, sizeof name);
        printf("    %-8s %s\n", name, (*m)->help);
        print_parameters((*m)->parameters);
    }
}

/* --- the man page ------------------------------------------------------------------------------------- */

/* A hyphen is one that can be searched for, a backslash itself, and no line is taken for a request. */
static void roff(const char *text)
{
    for (; *text != '\0'; text++)
        if (*text == '-' || *text == '\\')
            printf(*text == '-' ? "\\-" : "\\e");
        else
            putchar(*text);
}

static void man_option(const struct option *o)
{
    printf(".TP\n\\fB");
    roff(o->name);
    printf("\\fR");
    if (o->alias != NULL) {
        printf(", \\fB");
        roff(o->alias);
        printf("\\fR");
    }
    if (o->value != NULL) {
        printf(" \\fI");
        roff(o->value);
        printf("\\fR");
    }
    printf("\n\\&");
    roff(o->help);
    if (o->fallback != NULL && o->fallback[0] != '\0') {
        printf(" (default ");
        roff(o->fallback);
        printf(")");
    }
    printf("\n");
}

static void man_command(const struct command *c)
{
    printf(".SS ");
    roff(c->name);
    printf("\n\\&");
    roff(c->help);
    printf("\n");
    for (int i = 0; c->usage[i] != NULL; i++) {
        printf(".PP\n.B %s %s\n\\&", program.name, c->name);
        roff(c->usage[i]);
        printf("\n");
    }
    for (const struct option *o = c->options; o != NULL; o = options_next(o))
        man_option(o);
}

static void man_parameters(void)
{
    char text[64];
    for (const struct method *const *m = method_list(); *m != NULL; m++) {
        name_method(*m, text, sizeof text);
        printf(".TP\n\\fB");
        roff(text);
        printf("\\fR\n\\&");
        roff((*m)->help);
        printf("\n");
        for (const struct method_parameter *p = (*m)->parameters; p != NULL && p->name != NULL; p++) {
            parameter_fallback(p, text, sizeof text);
            printf(".RS\n.TP\n\\fB%s\\fR (", p->name);
            roff(text);
            printf(")\n\\&");
            roff(p->help);
            printf("\n.RE\n");
        }
    }
}

static void print_man(const char *version)
{
    printf(".TH ");
    roff(program.name);
    printf(" 1 \"\" \"%s\" \"User Commands\"\n.SH NAME\n", version);
    roff(program.name);
    printf(" \\- ");
    roff(program.title);
    printf("\n.SH SYNOPSIS\n.B %s\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n", program.name);
    roff(program.about);
    printf("\n.SH COMMANDS\n");
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        man_command(*c);
    printf(".SH INTEGRATORS\nParameters are set by \\fB\\-P\\fR \\fINAME=VALUE\\fR or by the scene; defaults stand in "
           "brackets.\n");
    man_parameters();
    printf(".SH EXIT STATUS\n0 success, 1 the job failed, 2 wrong usage; 128 and the number of a signal that ended "
           "it.\n");
}

/* --- completion ---------------------------------------------------------------------------------------- */

/* The options of a command with their aliases, each after a blank. */
static void list_options(const struct command *c)
{
    for (const struct option *o = c->options; o != NULL; o = options_next(o))
        if (o->name[0] == '-')
            printf(" %s%s%s", o->name, o->alias != NULL ? " " : "", o->alias != NULL ? o->alias : "");
    printf(" --help");
}

static void print_bash(void)
{
    printf("# completion of %s for bash\n_%s()\n{\n    local words=\n    case \"${COMP_WORDS[1]}\" in\n", program.name,
           program.name);
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        printf("    %s) words=\"", (*c)->name);
        list_options(*c);
        printf("\" ;;\n");
    }
    printf("    esac\n    [ \"$COMP_CWORD\" = 1 ] && words=\"help");
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        printf(" %s", (*c)->name);
    printf("\"\n    case \"${COMP_WORDS[COMP_CWORD-1]}\" in\n    --integrator) words=\"");
    for (const struct method *const *m = method_list(); *m != NULL; m++)
        printf(" %s", (*m)->name);
    printf("\" ;;\n    esac\n"
           "    COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
           "complete -o default -F _%s %s\n", program.name, program.name);
}

/* In single quotes, without what has a meaning in the descriptions of _arguments. */
static void zsh_text(const char *text)
{
    for (; *text != '\0'; text++)
        if (strchr("'[]:\\", *text) == NULL)
            putchar(*text);
}

static void zsh_option(const struct option *o, const char *name)
{
    printf(" \\\n            '*%s[", name);
    zsh_text(o->help);
    printf("]");
    if (o->value != NULL) {
        printf(":");
        zsh_text(o->value);
        printf(":_files");
    }
    printf("'");
}

static void print_zsh(void)
{
    printf("#compdef %s\n# completion of %s for zsh\nif (( CURRENT == 2 )); then\n"
           "    local -a commands=(\n        'help:all commands and options'\n", program.name, program.name);
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        printf("        '%s:", (*c)->name);
        zsh_text((*c)->help);
        printf("'\n");
    }
    printf("    )\n    _describe command commands\nelse\n    case $words[2] in\n");
    for (const struct command *const *c = program.commands; *c != NULL; c++) {
        printf("    %s)\n        _arguments", (*c)->name);
        for (const struct option *o = (*c)->options; o != NULL; o = options_next(o))
            if (o->name[0] == '-') {
                zsh_option(o, o->name);
                if (o->alias != NULL)
                    zsh_option(o, o->alias);
            }
        printf(" \\\n            '*:file:_files'\n        ;;\n");
    }
    printf("    esac\nfi\n");
}

bool manual_print(const char *topic, const char *version)
{
    if (strcmp(topic, "man") == 0)
        print_man(version);
    else if (strcmp(topic, "bash") == 0)
        print_bash();
    else if (strcmp(topic, "zsh") == 0)
        print_zsh();
    else
        return false;
    return true;
}
