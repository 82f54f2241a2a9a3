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

/* "FILE:LINE:COL: message"; returns where the message begins. */
static size_t write_message(struct writer *w, struct source_position at, const char *format, va_list args)
{
    write_text(w, "%s:%d:%d: ", at.file->path, at.line, at.column);
    size_t begin = w->used;
    write_args(w, format, args);
    return begin;
}

/* How many of these texts are equal to this one. */
static int count_equal(char *const *known, int n, const char *text)
{
    int equal = 0;
    for (int i = 0; i < n; i++)
        equal += strcmp(known[i], text) == 0;
    return equal;
}

bool source_error(struct messages *m, struct source_position at, const char *format, ...)
{
    struct error full;
    struct writer w = {full.text, 0, sizeof full.text};
    va_list args;
    va_start(args, format);
    const char *sentence = full.text + write_message(&w, at, format, args);
    va_end(args);
    if (m->n_errors == MOST_ERRORS || count_equal(m->error, m->n_errors, sentence) == MOST_LIKE) {
        m->more_errors++;
        return false;
    }
    m->error[m->n_errors++] = mem_copy_text(sentence);
    if (at.file->is_scene)
        write_excerpt(&w, at);
    write_includes(&w, at.file);
    if (m->err != NULL && m->n_errors == 1)
        *m->err = full;
    if (m->sink != NULL && m->sink->error != NULL)
        m->sink->error(m->sink->context, full.text);
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
    if (count_equal(m->warning, m->n_warnings, sentence) > 0)
        return;
    if (m->n_warnings == MOST_WARNINGS) {
        m->more_warnings++;
        return;
    }
    m->warning[m->n_warnings++] = mem_copy_text(sentence);
    if (m->sink != NULL && m->sink->warn != NULL)
        m->sink->warn(m->sink->context, text);
}

bool messages_suggest(struct messages *m)
{
    m->n_suggestions += m->n_suggestions < MOST_SUGGESTIONS + 1;
    return m->n_suggestions <= MOST_SUGGESTIONS;
}

void messages_report(struct messages *m)
{
    m->error[m->n_errors++] = mem_copy_text("");
    if (m->sink != NULL && m->sink->error != NULL && m->err != NULL)
        m->sink->error(m->sink->context, m->err->text);
}

void messages_end(struct messages *m)
{
    char text[64];
    snprintf(text, sizeof text, "and %ld more warnings", m->more_warnings);
    if (m->more_warnings > 0 && m->sink != NULL && m->sink->warn != NULL)
        m->sink->warn(m->sink->context, text);
    snprintf(text, sizeof text, "and %ld more errors", m->more_errors);
    if (m->more_errors > 0 && m->sink != NULL && m->sink->error != NULL)
        m->sink->error(m->sink->context, text);
    for (int i = 0; i < m->n_errors; i++)
        free(m->error[i]);
    for (int i = 0; i < m->n_warnings; i++)
        free(m->warning[i]);
    memset(m, 0, sizeof *m);
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
