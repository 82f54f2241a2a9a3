/* table.c: see table.h. */
#include "lab/table.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

void table_begin(struct table *t, const char *caption, ...)
{
    va_list args;
    memset(t, 0, sizeof *t);
    va_start(args, caption);
    vsnprintf(t->caption, sizeof t->caption, caption, args);
    va_end(args);
}

void table_column(struct table *t, const char *format, ...)
{
    va_list args;
    if (t->columns >= TABLE_MAX_COLUMNS)
        return;
    va_start(args, format);
    vsnprintf(t->head[t->columns++], TABLE_CELL, format, args);
    va_end(args);
}

void table_add(struct table *t, double value, const char *format, ...)
{
    va_list args;
    t->cell = mem_grow(t->cell, &t->capacity, t->n_cells + 1, sizeof *t->cell);
    struct table_cell *c = &t->cell[t->n_cells++];
    c->value = value;
    va_start(args, format);
    vsnprintf(c->text, sizeof c->text, format, args);
    va_end(args);
}

void table_add_missing(struct table *t, int n)
{
    for (int i = 0; i < n; i++)
        table_add(t, NAN, "-");
}

void table_add_interval(struct table *t, struct interval i)
{
    if (!isfinite(i.value))
        table_add_missing(t, 1);
    else if (!isfinite(i.low) || !isfinite(i.high))
        table_add(t, i.value, "%.3f", i.value);
    else if (i.high > 100 * i.value)
        table_add(t, i.value, "%.3f [%.2g, %.2g]", i.value, i.low, i.high);
    else
        table_add(t, i.value, "%.3f [%.3f, %.3f]", i.value, i.low, i.high);
}

void table_add_marked(struct table *t, struct interval i, const char *mark)
{
    table_add_interval(t, i);
    char *text = t->cell[t->n_cells - 1].text;
    size_t n = strlen(text);
    snprintf(text + n, TABLE_CELL - n, "%s%s", mark[0] != '\0' ? " " : "", mark);
}

void table_free(struct table *t)
{
    free(t->cell);
    memset(t, 0, sizeof *t);
}

/* A bar or a backslash of the text is no end of the cell. */
static void markdown_text(FILE *f, const char *text)
{
    for (; *text != '\0'; text++)
        fprintf(f, *text == '|' || *text == '\\' ? "\\%c" : "%c", *text);
}

void table_markdown(FILE *f, const struct table *t)
{
    fprintf(f, "%s\n\n|", t->caption);
    for (size_t c = 0; c < t->columns; c++) {
        fputc(' ', f);
        markdown_text(f, t->head[c]);
        fputs(" |", f);
    }
    fputs("\n|", f);
    for (size_t c = 0; c < t->columns; c++)
        fputs(c == 0 ? "---|" : "---:|", f);
    for (size_t i = 0; i < t->n_cells; i++) {
        const char *text = t->cell[i].text;
        fprintf(f, "%s%s", i % t->columns == 0 ? "\n|" : "", text[0] != '\0' ? " " : "");
        markdown_text(f, text);
        fputs(" |", f);
    }
    fputs("\n\n", f);
}
