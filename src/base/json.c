/* json.c: see json.h. */
#include "base/json.h"

#include <assert.h>
#include <inttypes.h>
#include <math.h>

#include "base/error.h"

struct json json_start(FILE *file) { return (struct json){.file = file, .empty = true}; }

static void quote(struct json *j, const char *text)
{
    fputc('"', j->file);
    for (int n; *text != '\0'; text += n > 0 ? n : 1) {
        unsigned char c = (unsigned char)*text;
        n = printable_length(text);
        if (c == '"' || c == '\\')
            fprintf(j->file, "\\%c", c);
        else if (n > 0)
            fwrite(text, 1, (size_t)n, j->file);
        else
            fprintf(j->file, "\\u%04x", c < 0x80 ? c : 0xfffdu);
    }
    fputc('"', j->file);
}

static void new_line(struct json *j) { fprintf(j->file, "\n%*s", 2 * j->depth, ""); }

/* The text before a value: comma, line, name. */
static void begin(struct json *j, const char *name)
{
    if (j->depth > 0 && !j->empty)
        fputc(',', j->file);
    if (j->depth > 0)
        new_line(j);
    j->empty = false;
    if (name == NULL)
        return;
    quote(j, name);
    fputs(": ", j->file);
}

void json_open(struct json *j, const char *name, char kind)
{
    begin(j, name);
    assert(j->depth < JSON_DEPTH);
    fputc(kind, j->file);
    j->closing[j->depth++] = kind == '{' ? '}' : ']';
    j->empty = true;
}

void json_close(struct json *j)
{
    j->depth--;
    if (!j->empty)
        new_line(j);
    fputc(j->closing[j->depth], j->file);
    j->empty = false;
    if (j->depth == 0)
        fputc('\n', j->file);
}

static void put_number(struct json *j, double value)
{
    if (isfinite(value))
        fprintf(j->file, "%.17g", value);
    else
        fputs("null", j->file);
}

void json_number(struct json *j, const char *name, double value)
{
    begin(j, name);
    put_number(j, value);
}

void json_numbers(struct json *j, const char *name, const double *values, int n)
{
    begin(j, name);
    fputc('[', j->file);
    for (int i = 0; i < n; i++) {
        fputs(i > 0 ? ", " : "", j->file);
        put_number(j, values[i]);
    }
    fputc(']', j->file);
}

void json_count(struct json *j, const char *name, uint64_t value)
{
    begin(j, name);
    fprintf(j->file, "%" PRIu64, value);
}

void json_word(struct json *j, const char *name, const char *word)
{
    begin(j, name);
    fputs(word, j->file);
}

void json_text(struct json *j, const char *name, const char *text)
{
    if (text == NULL) {
        json_word(j, name, "null");
        return;
    }
    begin(j, name);
    quote(j, text);
}
