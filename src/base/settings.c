/* settings.c: see settings.h. */
#include "base/settings.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/near.h"

const struct setting *settings_find(const struct settings *s, const char *name)
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

static void put(struct settings *s, const char *name, const char *value, double number, const char *origin)
{
    const struct setting new = {mem_copy_text(name), mem_copy_text(value), number, mem_copy_text(origin)};
    int i = 0;
    while (i < s->n && strcmp(s->item[i].name, name) != 0)
        i++;
    if (i < s->n) {
        free_setting(&s->item[i]);
    } else {
        s->item = mem_append(s->item, (size_t)s->n, sizeof *s->item);
        s->n++;
    }
    s->item[i] = new;
}

void settings_set(struct settings *s, const char *name, const char *value, const char *origin)
{
    char *end;
    double number = strtod(value, &end);
    put(s, name, value, end != value && *end == '\0' ? number : NAN, origin);
}

void settings_set_number(struct settings *s, const char *name, double number, const char *origin)
{
    char value[32];
    snprintf(value, sizeof value, "%.15g", number); /* what was written, if it had no more digits */
    put(s, name, value, number, origin);
}

void settings_clear(struct settings *s)
{
    for (int i = 0; i < s->n; i++)
        free_setting(&s->item[i]);
    free(s->item);
    memset(s, 0, sizeof *s);
}

/* --- reading ------------------------------------------------------------------------------------------ */

/* Was it the user's own? */
static bool blame(const struct setting *item, struct error *err)
{
    if (err != NULL)
        err->usage = !setting_is_of_file(item);
    return false;
}

static bool number(const struct settings *s, const struct field *f, double *out, struct error *err)
{
    const struct setting *item = settings_find(s, f->name);
    bool whole = f->kind == FIELD_INTEGER;
    *out = item == NULL ? f->fallback : item->number;
    if (item == NULL || (*out >= f->low && *out <= f->high && (!whole || *out == floor(*out))))
        return true;
    error_set(err, "%s: %s = \"%s\": give a %snumber from %.15g to %.15g", item->origin, f->name, item->value,
              whole ? "whole " : "", f->low, f->high);
    return blame(item, err);
}

bool settings_choice(const struct settings *s, const char *name, int fallback, const char *const *names, int *out,
                     struct error *err)
{
    const struct setting *item = settings_find(s, name);
    char list[NAMES_TEXT];
    *out = item == NULL ? fallback : names_find(names, item->value);
    if (*out >= 0)
        return true;
    error_set(err, "%s: %s = \"%s\" is unknown: give %s%s", item->origin, name, item->value,
              names_list(names, list), near_of(item->value, names).text);
    return blame(item, err);
}

static bool read_field(const struct settings *s, const struct field *f, char *into, struct error *err)
{
    void *place = into + f->place;
    double value;
    if (f->kind == FIELD_WORD)
        return settings_choice(s, f->name, (int)f->fallback, f->words, place, err);
    if (!number(s, f, &value, err))
        return false;
    if (f->kind == FIELD_INTEGER)
        *(int *)place = (int)value; /* high is an int */
    else
        *(double *)place = value;
    return true;
}

bool settings_fields(const struct settings *s, const struct field *table, void *into, struct error *err)
{
    for (; table->name != NULL; table++)
        if (!read_field(s, table, into, err))
            return false;
    return true;
}
