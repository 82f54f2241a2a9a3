/* field.c: see field.h. */
#include "base/field.h"

#include <stdio.h>
#include <string.h>

const struct field *field_find(const struct field *table, const char *name)
{
    while (table->name != NULL && strcmp(table->name, name) != 0)
        table++;
    return table->name != NULL ? table : NULL;
}

void field_fallback(const struct field *f, char *text, size_t size)
{
    if (f->kind == FIELD_WORD)
        snprintf(text, size, "%s", f->words[(int)f->fallback]);
    else
        snprintf(text, size, "%g", f->fallback);
}
