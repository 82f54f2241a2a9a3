/* messages.c: see messages.h. */
#include "parser/messages.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

/* Is this sentence to be given once more? */
static bool is_new(struct given *g, int most, const char *sentence)
{
    int alike = 0;
    for (int i = 0; i < g->n; i++)
        alike += strcmp(g->sentence[i], sentence) == 0;
    if (g->n == most || alike == MOST_ALIKE) {
        g->more++;
        return false;
    }
    g->sentence[g->n++] = mem_copy_text(sentence);
    return true;
}

static void tell(const struct messages *m, bool error, const char *text)
{
    if (m->sink != NULL)
        m->sink->hear(m->sink->context, error, text);
}

static void give(struct messages *m, bool error, struct source_position at, const char *format, va_list args)
{
    char sentence[ERROR_TEXT_SIZE];
    struct error full;
    vsnprintf(sentence, sizeof sentence, format, args);
    if (!is_new(error ? &m->errors : &m->warnings, error ? MOST_ERRORS : MOST_WARNINGS, sentence))
        return;
    error_set(&full, "%s:%d:%d: %s", at.file->path, at.line, at.column, sentence);
    if (error && m->err != NULL && m->errors.n == 1)
        *m->err = full;
    tell(m, error, full.text);
}

bool source_error(struct messages *m, struct source_position at, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    give(m, true, at, format, args);
    va_end(args);
    return false;
}

void source_warn(struct messages *m, struct source_position at, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    give(m, false, at, format, args);
    va_end(args);
}

void messages_report(struct messages *m)
{
    is_new(&m->errors, MOST_ERRORS, m->err->text);
    tell(m, true, m->err->text);
}

static void end(const struct messages *m, struct given *g, bool error)
{
    char text[64];
    snprintf(text, sizeof text, "and %ld more %s", g->more, error ? "errors" : "warnings");
    if (g->more > 0)
        tell(m, error, text);
    while (g->n > 0)
        free(g->sentence[--g->n]);
}

void messages_end(struct messages *m)
{
    end(m, &m->warnings, false);
    end(m, &m->errors, true);
}
