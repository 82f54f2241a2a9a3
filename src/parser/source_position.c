/* source_position.c: see source_position.h. */
#include "parser/source_position.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

enum { SHOWN_COLUMNS = 110 };

/* Append to a text [ERROR_TEXT_SIZE]. */
static void append_args(char *text, const char *format, va_list args)
{
    size_t used = strlen(text);
    vsnprintf(text + used, ERROR_TEXT_SIZE - used, format, args);
    error_clean(text + used);
}

static void append(char *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    append_args(text, format, args);
    va_end(args);
}

/* The only line breaks of a message are these: error_clean takes all others. */
static void append_line_break(char *text) { strncat(text, "\n  ", ERROR_TEXT_SIZE - 1 - strlen(text)); }

/* The part of the line around the column, and a caret under it. Tabs and the like become one blank each; bytes outside
 * ASCII are written, and so cleaned, one by one, whereby one byte stays one column. */
static void append_excerpt(char *text, struct source_position at)
{
    const char *begin = at.line_start, *caret = at.line_start + (at.column - 1);
    if (caret - begin > SHOWN_COLUMNS * 3 / 4)
        begin = caret - SHOWN_COLUMNS / 2;
    const char *end = begin;
    while (end < at.file->end && *end != '\n' && *end != '\r' && end - begin < SHOWN_COLUMNS)
        end++;
    append_line_break(text);
    for (const char *p = begin; p < end; p++)
        append(text, "%c", (unsigned char)*p < ' ' ? ' ' : *p);
    append_line_break(text);
    append(text, "%*s^", (int)(caret - begin), "");
}

static void append_includes(char *text, const struct source_file *file)
{
    for (; file->included_at.file != NULL; file = file->included_at.file) {
        append_line_break(text);
        append(text, "included from %s:%d", file->included_at.file->path, file->included_at.line);
    }
}

/* Is this text to be given, whose sentence begins after its place? */
static bool is_new(struct given *g, int most, const char *text, const char *sentence)
{
    int alike = g->n == most ? MOST_ALIKE : 0;
    for (int i = 0; i < g->n && alike < MOST_ALIKE; i++)
        alike = strcmp(g->text[i], text) == 0 ? MOST_ALIKE : alike + (strcmp(g->text[i] + g->place[i], sentence) == 0);
    if (alike == MOST_ALIKE) {
        g->more++;
        return false;
    }
    g->place[g->n] = sentence - text;
    g->text[g->n++] = mem_copy_text(text);
    return true;
}

static void tell(const struct messages *m, bool error, const char *text)
{
    const struct message_sink *to = m->sink;
    void (*say)(void *context, const char *text) = to == NULL ? NULL : error ? to->error : to->warn;
    if (say != NULL)
        say(to->context, text);
}

/* "FILE:LINE:COL: message" to text [ERROR_TEXT_SIZE]. Is this sentence to be given? */
static bool begin(struct given *g, int most, struct source_position at, const char *format, va_list args, char *text)
{
    text[0] = '\0';
    append(text, "%s:%d:%d: ", at.file->path, at.line, at.column);
    const char *sentence = text + strlen(text);
    append_args(text, format, args);
    return is_new(g, most, text, sentence);
}

bool source_error(struct messages *m, struct source_position at, const char *format, ...)
{
    struct error full = {.usage = false};
    va_list args;
    va_start(args, format);
    bool new = begin(&m->errors, MOST_ERRORS, at, format, args, full.text);
    va_end(args);
    if (!new)
        return false;
    if (at.file->quotable)
        append_excerpt(full.text, at);
    append_includes(full.text, at.file);
    if (m->err != NULL && m->errors.n == 1)
        *m->err = full;
    tell(m, true, full.text);
    return false;
}

void source_warn(struct messages *m, struct source_position at, const char *format, ...)
{
    char text[ERROR_TEXT_SIZE];
    va_list args;
    va_start(args, format);
    bool new = begin(&m->warnings, MOST_WARNINGS, at, format, args, text);
    va_end(args);
    if (new)
        tell(m, false, text);
}

void messages_report(struct messages *m)
{
    is_new(&m->errors, MOST_ERRORS, m->err->text, m->err->text);
    tell(m, true, m->err->text);
}

static void end(const struct messages *m, struct given *g, bool error)
{
    char text[64];
    snprintf(text, sizeof text, "and %ld more %s", g->more, error ? "errors" : "warnings");
    if (g->more > 0)
        tell(m, error, text);
    while (g->n > 0)
        free(g->text[--g->n]);
}

void messages_end(struct messages *m)
{
    end(m, &m->warnings, false);
    end(m, &m->errors, true);
}
