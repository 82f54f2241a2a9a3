/* table.c: see table.h. */
#include "lab/table.h"

#include <math.h>
#include <stdarg.h>

struct table table_begin(FILE *f, const char *caption, ...)
{
    struct table t = {f, 0, 0};
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

void table_column(struct table *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    put(t->f, format, args);
    va_end(args);
    t->columns++;
}

static void rule(const struct table *t)
{
    fputs("\n|---|", t->f);
    for (int i = 1; i < t->columns; i++)
        fputs("---:|", t->f);
}

void table_add(struct table *t, const char *format, ...)
{
    va_list args;
    if (t->cells == 0)
        rule(t);
    fputs(t->cells++ % t->columns == 0 ? "\n|" : "", t->f);
    va_start(args, format);
    put(t->f, format, args);
    va_end(args);
}

void table_end(struct table *t)
{
    if (t->cells == 0)
        rule(t);
    fputs("\n\n", t->f);
}

void table_add_missing(struct table *t, int n)
{
    for (int i = 0; i < n; i++)
        table_add(t, "-");
}

void table_add_interval(struct table *t, struct interval i, const char *mark)
{
    const char *blank = mark[0] != '\0' ? " " : "";
    if (!isfinite(i.value))
        table_add(t, "-%s%s", blank, mark);
    else if (!isfinite(i.low) || !isfinite(i.high))
        table_add(t, "%.3f%s%s", i.value, blank, mark);
    else
        table_add(t, i.high > 100 * i.value ? "%.3f [%.2g, %.2g]%s%s" : "%.3f [%.3f, %.3f]%s%s", i.value, i.low, i.high,
                  blank, mark);
}
