/* source_position.c: see source_position.h. */
#include "parser/source_position.h"

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"

enum { SHOWN_COLUMNS = 110 };

/* A growing message in a buffer of fixed size. */
struct writer {
    char *text;
    size_t used, size;
};

static void write_args(struct writer *w, const char *format, va_list args)
{
    int n = vsnprintf(w->text + w->used, w->size - w->used, format, args);
    error_clean(w->text + w->used);
    if (n > 0)
        w->used += (size_t)n < w->size - w->used ? (size_t)n : w->size - w->used - 1;
}

static void write_text(struct writer *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_args(w, format, args);
    va_end(args);
}

/* The only line breaks of a message are these: error_clean takes all others. */
static void write_line_break(struct writer *w)
{
    for (const char *p = "\n  "; *p != '\0' && w->used + 1 < w->size; p++)
        w->text[w->used++] = *p;
    w->text[w->used] = '\0';
}

/* The part of the line around the column, and a caret under it. Tabs and the like become one blank each; bytes outside
 * ASCII are written, and so cleaned, one by one, whereby one byte stays one column. */
static void write_excerpt(struct writer *w, struct source_position at)
{
    const char *begin = at.line_start, *caret = at.line_start + (at.column - 1);
    if (caret - begin > SHOWN_COLUMNS * 3 / 4)
        begin = caret - SHOWN_COLUMNS / 2;
    const char *end = begin;
    while (end < at.file->end && *end != '\n' && *end != '\r' && end - begin < SHOWN_COLUMNS)
        end++;
    write_line_break(w);
    for (const char *p = begin; p < end; p++)
        write_text(w, "%c", (unsigned char)*p < ' ' ? ' ' : *p);
    write_line_break(w);
    write_text(w, "%*s^", (int)(caret - begin), "");
}

static void write_includes(struct writer *w, const struct source_file *file)
{
    for (; file->included_at.file != NULL; file = file->included_at.file) {
        write_line_break(w);
        write_text(w, "included from %s:%d", file->included_at.file->path, file->included_at.line);
    }
}

/* "FILE:LINE:COL: message"; returns where the message begins. */
static size_t write_message(struct writer *w, struct source_position at, const char *format, va_list args)
{
    write_text(w, "%s:%d:%d: ", at.file->path, at.line, at.column);
    size_t begin = w->used;
    write_args(w, format, args);
    return begin;
}

/* Is this sentence to be given? */
static bool is_new(struct given *g, int most, const char *sentence)
{
    bool known = g->n == most;
    for (int i = 0; i < g->n && !known; i++)
        known = strcmp(g->sentence[i], sentence) == 0;
    if (known)
        g->more++;
    else
        g->sentence[g->n++] = mem_copy_text(sentence);
    return !known;
}

static void tell_error(const struct messages *m, const char *text)
{
    if (m->sink != NULL && m->sink->error != NULL)
        m->sink->error(m->sink->context, text);
}

static void tell_warning(const struct messages *m, const char *text)
{
    if (m->sink != NULL && m->sink->warn != NULL)
        m->sink->warn(m->sink->context, text);
}

bool source_error(struct messages *m, struct source_position at, const char *format, ...)
{
    struct error full;
    struct writer w = {full.text, 0, sizeof full.text};
    va_list args;
    va_start(args, format);
    const char *sentence = full.text + write_message(&w, at, format, args);
    va_end(args);
    if (!is_new(&m->errors, MOST_ERRORS, sentence))
        return false;
    if (at.file->quotable)
        write_excerpt(&w, at);
    write_includes(&w, at.file);
    if (m->err != NULL && m->errors.n == 1)
        *m->err = full;
    tell_error(m, full.text);
    return false;
}

void source_warn(struct messages *m, struct source_position at, const char *format, ...)
{
    char text[ERROR_TEXT_SIZE];
    struct writer w = {text, 0, sizeof text};
    va_list args;
    va_start(args, format);
    const char *sentence = text + write_message(&w, at, format, args);
    va_end(args);
    if (is_new(&m->warnings, MOST_WARNINGS, sentence))
        tell_warning(m, text);
}

void messages_report(struct messages *m)
{
    is_new(&m->errors, MOST_ERRORS, m->err->text);
    tell_error(m, m->err->text);
}

static void forget(struct given *g)
{
    while (g->n > 0)
        free(g->sentence[--g->n]);
}

void messages_end(struct messages *m)
{
    char text[64];
    snprintf(text, sizeof text, "and %ld more warnings", m->warnings.more);
    if (m->warnings.more > 0)
        tell_warning(m, text);
    snprintf(text, sizeof text, "and %ld more errors", m->errors.more);
    if (m->errors.more > 0)
        tell_error(m, text);
    forget(&m->warnings);
    forget(&m->errors);
}

void source_position_text(struct source_position at, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s:%d:%d", at.file->path, at.line, at.column);
}

char *text_read(const char *path, size_t *size, struct error *err)
{
    uint8_t *data;
    bool ok = file_read(path, &data, size, NULL);
    int reason = ok ? 0 : errno;
    if (ok && *size < INT32_MAX)
        return (char *)data;
    free(data);
    error_set(err, "%s: cannot %s the file: %s", path, reason != 0 && reason != EISDIR ? "open" : "read",
              reason != 0 ? strerror(reason) : "it is larger than 2 GiB");
    return NULL;
}
