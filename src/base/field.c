/* field.c: see field.h. */
#include "base/field.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/near.h"

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

/* --- settings ----------------------------------------------------------------------------------------- */

static struct setting *find(const struct settings *s, const char *name)
{
    for (int i = 0; i < s->n; i++)
        if (strcmp(s->item[i].name, name) == 0)
            return &s->item[i];
    return NULL;
}

static void free_setting(struct setting *item)
{
    free(item->name);
    free(item->value);
    free(item->origin);
}

void settings_remove(struct settings *s, int i)
{
    free_setting(&s->item[i]);
    memmove(&s->item[i], &s->item[i + 1], (size_t)(--s->n - i) * sizeof *s->item);
}

void settings_set(struct settings *s, const char *name, const char *value, const char *origin)
{
    const struct setting new = {mem_copy_text(name), mem_copy_text(value), mem_copy_text(origin)};
    struct setting *item = find(s, name);
    if (item != NULL) {
        free_setting(item);
    } else {
        s->item = mem_append(s->item, (size_t)s->n, sizeof *s->item);
        item = &s->item[s->n++];
    }
    *item = new;
}

void settings_clear(struct settings *s)
{
    for (int i = 0; i < s->n; i++)
        free_setting(&s->item[i]);
    free(s->item);
    memset(s, 0, sizeof *s);
}

const char *settings_text(const struct settings *s, const char *name, const char *fallback)
{
    const struct setting *item = find(s, name);
    return item != NULL ? item->value : fallback;
}

/* Was it the user's own? */
static bool blame(const struct setting *item, struct error *err)
{
    if (err != NULL)
        err->usage = !setting_is_of_file(item);
    return false;
}

static bool number(const struct settings *s, const struct field *f, double *out, struct error *err)
{
    const struct setting *item = find(s, f->name);
    bool whole = f->kind == FIELD_INTEGER;
    *out = f->fallback;
    if (item == NULL)
        return true;
    char *end;
    *out = strtod(item->value, &end);
    if (end != item->value && *end == '\0' && *out >= f->low && *out <= f->high && (!whole || *out == floor(*out)))
        return true;
    error_set(err, "%s: %s = \"%s\": give a %snumber from %.15g to %.15g", item->origin, f->name, item->value,
              whole ? "whole " : "", f->low, f->high);
    return blame(item, err);
}

bool settings_choice(const struct settings *s, const char *name, int fallback, const char *const *names, int *out,
                     struct error *err)
{
    *out = fallback;
    const struct setting *item = find(s, name);
    if (item == NULL)
        return true;
    char list[256] = "";
    for (int i = 0; names[i] != NULL; i++) {
        *out = i;
        if (strcmp(item->value, names[i]) == 0)
            return true;
        size_t used = strlen(list);
        const char *join = i == 0 ? "" : names[i + 1] == NULL ? " or " : ", ";
        snprintf(list + used, sizeof list - used, "%s\"%s\"", join, names[i]);
    }
    error_set(err, "%s: %s = \"%s\" is unknown: give %s%s", item->origin, name, item->value, list,
              near_of(item->value, names).text);
    return blame(item, err);
}

static bool set(const struct settings *s, const struct field *f, char *into, struct error *err)
{
    double value;
    if (f->kind == FIELD_WORD)
        return settings_choice(s, f->name, (int)f->fallback, f->words, (int *)(void *)(into + f->place), err);
    if (!number(s, f, &value, err))
        return false;
    if (f->kind == FIELD_INTEGER)
        *(int *)(void *)(into + f->place) = (int)value; /* high is an int */
    else
        *(double *)(void *)(into + f->place) = value;
    return true;
}

bool settings_fields(const struct settings *s, const struct field *table, void *into, struct error *err)
{
    for (; table->name != NULL; table++)
        if (!set(s, table, into, err))
            return false;
    return true;
}
