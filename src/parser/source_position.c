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

enum { SHOWN_COLUMNS = 110, SHOWN_INCLUDES = 4 };

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
    for (int i = 0; file->included_at.file != NULL; i++, file = file->included_at.file) {
        write_line_break(w);
        if (i == SHOWN_INCLUDES) {
            write_text(w, "...");
            return;
        }
        write_text(w, "included from %s:%d", file->included_at.file->path, file->included_at.line);
    }
}

bool source_error(struct messages *m, struct source_position at, const char *format, ...)
{
    if (m->err == NULL)
        return false;
    struct writer w = {m->err->text, 0, sizeof m->err->text};
    write_text(&w, "%s:%d:%d: ", at.file->path, at.line, at.column);
    va_list args;
    va_start(args, format);
    write_args(&w, format, args);
    va_end(args);
    write_excerpt(&w, at);
    write_includes(&w, at.file);
    return false;
}

void source_warn(struct messages *m, struct source_position at, const char *kind, const char *format, ...)
{
    for (size_t i = 0; i < m->n_given; i++)
        if (strcmp(m->given[i], kind) == 0)
            return;
    m->given = mem_grow(m->given, &m->capacity, m->n_given + 1, sizeof *m->given);
    m->given[m->n_given++] = kind;
    if (m->sink == NULL)
        return;
    char text[ERROR_TEXT_SIZE];
    struct writer w = {text, 0, sizeof text};
    write_text(&w, "%s:%d:%d: ", at.file->path, at.line, at.column);
    va_list args;
    va_start(args, format);
    write_args(&w, format, args);
    va_end(args);
    m->sink->warn(m->sink->context, text);
}

void source_position_text(struct source_position at, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s:%d:%d", at.file->path, at.line, at.column);
}

void messages_free(struct messages *m)
{
    free(m->given);
    m->given = NULL;
    m->n_given = m->capacity = 0;
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
