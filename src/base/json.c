/* json.c: see json.h. */
#include "base/json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

struct json json_start(FILE *file)
{
    struct json j;
    memset(&j, 0, sizeof j);
    j.file = file;
    j.empty = true;
    return j;
}

/* Bytes of the UTF-8 character that the text begins with: 0 if it is none [RFC 3629 4]. */
static int utf8_length(const unsigned char *c)
{
    if (c[0] < 0x80)
        return 1;
    int n = c[0] >= 0xc2 && c[0] < 0xe0 ? 2 : c[0] >= 0xe0 && c[0] < 0xf0 ? 3 : c[0] >= 0xf0 && c[0] < 0xf5 ? 4 : 0;
    for (int i = 1; i < n; i++)
        if ((c[i] & 0xc0) != 0x80)
            return 0;
    bool longer = (c[0] == 0xe0 && c[1] < 0xa0) || (c[0] == 0xf0 && c[1] < 0x90);
    bool surrogate = c[0] == 0xed && c[1] >= 0xa0, beyond = c[0] == 0xf4 && c[1] >= 0x90;
    return longer || surrogate || beyond ? 0 : n;
}

static void quote(struct json *j, const char *text)
{
    fputc('"', j->file);
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(j->file, "\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            fprintf(j->file, "\\u%04x", (unsigned)c);
        else if (utf8_length((const unsigned char *)text) == 0)
            fputs("\\ufffd", j->file);
        else
            text += fwrite(text, 1, (size_t)utf8_length((const unsigned char *)text), j->file) - 1;
    }
    fputc('"', j->file);
}

static void new_line(struct json *j)
{
    fprintf(j->file, "\n%*s", 2 * j->depth, "");
}

/* What stands before a value: comma, line, name. */
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
    if (j->depth == JSON_DEPTH)
        return; /* callers nest less */
    fputc(kind == '{' ? '{' : '[', j->file);
    j->closing[j->depth++] = kind == '{' ? '}' : ']';
    j->empty = true;
}

void json_close(struct json *j)
{
    if (j->depth == 0)
        return;
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

void json_text(struct json *j, const char *name, const char *text)
{
    begin(j, name);
    if (text != NULL)
        quote(j, text);
    else
        fputs("null", j->file);
}

void json_bool(struct json *j, const char *name, bool value)
{
    begin(j, name);
    fputs(value ? "true" : "false", j->file);
}
