/* table.c: see table.h. */
#include "lab/table.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "lab/markup.h"
#include "base/mem.h"

#define PLUS_MINUS "\xc2\xb1" /* U+00B1 in UTF-8 */

void table_begin(struct table *t, const char *caption)
{
    memset(t, 0, sizeof *t);
    snprintf(t->caption, sizeof t->caption, "%s", caption);
}

void table_column(struct table *t, const char *head)
{
    if (t->columns < TABLE_MAX_COLUMNS)
        snprintf(t->head[t->columns++], TABLE_CELL, "%s", head);
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

/* The logarithm of a double is -324 to 308.
 * Digits after the point so that `unit` shows two digits; at least `low`. */
static int digits_for(double unit, int low)
{
    int n = unit > 0 && isfinite(unit) ? 1 - (int)floor(log10(unit)) : 3;
    return n < low ? low : n > 6 ? 6 : n;
}

void table_add_estimate(struct table *t, double mean, double error)
{
    if (!isfinite(mean))
        table_add(t, NAN, "-");
    else if (!isfinite(error) || error == 0)
        table_add(t, mean, "%.4g", mean);
    else
        table_add(t, mean, "%.*f " PLUS_MINUS " %.*f", digits_for(error, 0), mean, digits_for(error, 0), error);
}

void table_add_interval(struct table *t, double value, double low, double high)
{
    if (!isfinite(value))
        table_add(t, NAN, "-");
    else if (!isfinite(low) || !isfinite(high))
        table_add(t, value, "%.3f", value);
    else if (high > 100 * value)
        table_add(t, value, "%.3f [%.2g, %.2g]", value, low, high);
    else
        table_add(t, value, "%.3f [%.3f, %.3f]", value, low, high);
}

size_t table_rows(const struct table *t) { return t->columns > 0 ? t->n_cells / (size_t)t->columns : 0; }

void table_html(FILE *f, const struct table *t)
{
    fputs("<figure class=\"table\"><figcaption>", f);
    xml_text(f, t->caption);
    fputs("</figcaption>\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"", f);
    xml_text(f, t->caption);
    fputs("\"><table>\n<thead><tr>", f);
    for (int c = 0; c < t->columns; c++) {
        fputs("<th scope=\"col\">", f);
        xml_text(f, t->head[c]);
        fputs("</th>", f);
    }
    fputs("</tr></thead>\n<tbody>\n", f);
    for (size_t row = 0; row < table_rows(t); row++) {
        fputs("<tr>", f);
        for (size_t c = 0; c < (size_t)t->columns; c++) {
            const struct table_cell *cell = &t->cell[row * (size_t)t->columns + c];
            fputs(c == 0 ? "<th scope=\"row\"" : "<td", f);
            if (isfinite(cell->value))
                fprintf(f, " data-value=\"%.9g\"", cell->value);
            fputc('>', f);
            xml_text(f, cell->text);
            fputs(c == 0 ? "</th>" : "</td>", f);
        }
        fputs("</tr>\n", f);
    }
    fputs("</tbody></table></div></figure>\n", f);
}

void table_markdown(FILE *f, const struct table *t)
{
    fprintf(f, "%s\n\n|", t->caption);
    for (int c = 0; c < t->columns; c++)
        fprintf(f, " %s |", t->head[c]);
    fputs("\n|", f);
    for (int c = 0; c < t->columns; c++)
        fputs(c == 0 ? "---|" : "---:|", f);
    for (size_t i = 0; i < table_rows(t) * (size_t)t->columns; i++)
        fprintf(f, "%s %s |", i % (size_t)t->columns == 0 ? "\n|" : "", t->cell[i].text);
    fputs("\n\n", f);
}

void table_free(struct table *t)
{
    free(t->cell);
    memset(t, 0, sizeof *t);
}
