/* settings.h: the named parameters of an integrator, as the scene file and -P give them.
 *
 * Values are kept as text; an integrator reads them by name with a default. Later ones override earlier ones.
 *
 * Tests: test_asbdpt.c, test/cli.sh.
 */
#ifndef ASBDPT_SETTINGS_H
#define ASBDPT_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/error.h"
#include "base/field.h"

struct setting {
    char *name, *value; /* owned */
    char *origin;       /* "FILE:LINE:COL" or "-P", for messages; owned */
};

/* setting_is_of_file: or of -P? */
static inline bool setting_is_of_file(const struct setting *s) { return strcmp(s->origin, "-P") != 0; }

struct settings {
    struct setting *item; /* [n], owned */
    int n;
};

/* settings_set: add, or replace the one of that name; the texts are copied. settings_remove: forget number i.
 * settings_clear: forget and free everything. */
void settings_set(struct settings *s, const char *name, const char *value, const char *origin);
void settings_remove(struct settings *s, int i);
void settings_clear(struct settings *s);

/* settings_text: the value, or `fallback` when the name is not set. */
const char *settings_text(const struct settings *s, const char *name, const char *fallback);

/* settings_choice: which of the names, ended by NULL, the value is; *out = fallback when not set. Returns false with a
 * message naming origin, name, value and the names. */
bool settings_choice(const struct settings *s, const char *name, int fallback, const char *const *names, int *out,
                     struct error *err);

/* settings_fields: all fields of a table of integers, numbers and words into the struct at `into`. Returns false with a
 * message naming origin, name, value and what is allowed. */
bool settings_fields(const struct settings *s, const struct field *table, void *into, struct error *err);

#endif
