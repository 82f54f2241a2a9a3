/* parameter.c: see parameter.h. */
#include "integrators/parameter.h"

#include <stdio.h>
#include <string.h>

static bool set(const struct method_parameter *p, const struct settings *s, char *into, struct error *err)
{
    int *whole = (int *)(void *)(into + p->place);
    long value;
    switch (p->kind) {
    case PARAMETER_INTEGER:
        if (!settings_int(s, p->name, (long)p->fallback, (long)p->low, (long)p->high, &value, err))
            return false;
        *whole = (int)value; /* high is an int */
        return true;
    case PARAMETER_NUMBER:
        return settings_real(s, p->name, p->fallback, p->low, p->high, (double *)(void *)(into + p->place), err);
    case PARAMETER_WORD: return settings_choice(s, p->name, (int)p->fallback, p->words, whole, err);
    }
    return false;
}

bool parameters_set(const struct method_parameter *table, const struct settings *s, void *into, struct error *err)
{
    for (; table->name != NULL; table++)
        if (!set(table, s, into, err))
            return false;
    return true;
}

const struct method_parameter *parameter_find(const struct method_parameter *table, const char *name)
{
    while (table->name != NULL && strcmp(table->name, name) != 0)
        table++;
    return table->name != NULL ? table : NULL;
}

const char *parameter_type(const struct method_parameter *p)
{
    static const char *const types[] = {"integer", "float", "string"};
    return types[p->kind];
}

void parameter_fallback(const struct method_parameter *p, char *text, size_t size)
{
    if (p->kind == PARAMETER_WORD)
        snprintf(text, size, "%s", p->words[(int)p->fallback]);
    else
        snprintf(text, size, "%g", p->fallback);
}
