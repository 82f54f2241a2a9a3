/* text.c: see text.h. */
#include "lab/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool text_add(char *text, size_t size, const char *format, ...)
{
    size_t n = strlen(text);
    va_list args;
    va_start(args, format);
    int wanted = vsnprintf(text + n, size - n, format, args);
    va_end(args);
    return wanted >= 0 && (size_t)wanted < size - n;
}

/* --- tables of Markdown --------------------------------------------------------------------------------------- */

struct md_table md_begin(FILE *f, const char *caption, ...)
{
    struct md_table t = {f, 0, 0};
    va_list args;
    va_start(args, caption);
    vfprintf(f, caption, args);
    va_end(args);
    fputs("\n\n|", f);
    return t;
}

/* A bar or a backslash of the text does not end the cell. */
static void put(FILE *f, const char *format, va_list args)
{
    char text[512];
    vsnprintf(text, sizeof text, format, args);
    fputs(text[0] != '\0' ? " " : "", f);
    for (const char *c = text; *c != '\0'; c++)
        fprintf(f, *c == '|' || *c == '\\' ? "\\%c" : "%c", *c);
    fputs(" |", f);
}

void md_column(struct md_table *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    put(t->f, format, args);
    va_end(args);
    t->columns++;
}

static void rule(const struct md_table *t)
{
    fputs("\n|---|", t->f);
    for (int i = 1; i < t->columns; i++)
        fputs("---:|", t->f);
}

void md_add(struct md_table *t, const char *format, ...)
{
    va_list args;
    if (t->cells == 0)
        rule(t);
    fputs(t->cells++ % t->columns == 0 ? "\n|" : "", t->f);
    va_start(args, format);
    put(t->f, format, args);
    va_end(args);
}

void md_end(struct md_table *t)
{
    if (t->cells == 0)
        rule(t);
    fputs("\n\n", t->f);
}

void md_add_missing(struct md_table *t, int n)
{
    for (int i = 0; i < n; i++)
        md_add(t, "-");
}

void md_add_interval(struct md_table *t, struct interval i, const char *mark)
{
    const char *blank = mark[0] != '\0' ? " " : "";
    if (!isfinite(i.value))
        md_add(t, "-%s%s", blank, mark);
    else if (!isfinite(i.low) || !isfinite(i.high))
        md_add(t, "%.3f%s%s", i.value, blank, mark);
    else
        md_add(t, i.high > 100 * i.value ? "%.3f [%.2g, %.2g]%s%s" : "%.3f [%.3f, %.3f]%s%s", i.value, i.low, i.high,
                  blank, mark);
}
