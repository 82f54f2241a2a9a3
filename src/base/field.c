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

const char *field_type(const struct field *f)
{
    static const char *const types[] = {
        [FIELD_INTEGER] = "integer", [FIELD_NUMBER] = "float", [FIELD_WORD] = "string"};
    return types[f->kind];
}

void field_fallback(const struct field *f, char *text, size_t size)
{
    if (f->kind == FIELD_WORD)
        snprintf(text, size, "%s", f->words[(int)f->fallback]);
    else
        snprintf(text, size, "%g", f->fallback);
}
