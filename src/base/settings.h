/* settings.h: the parameters of an integrator, as a scene file and -P give them, until its table reads them (field.h).
 * Which integrator it is shows when both are known.
 * Tests: test_options.c, test_asbdpt.c, test_parser.c, test/run/cli.sh. */
#ifndef ASBDPT_SETTINGS_H
#define ASBDPT_SETTINGS_H

#include <stdbool.h>
#include <string.h>

#include "base/error.h"
#include "base/field.h"

struct setting {
    char *name, *value; /* owned */
    double number;      /* the value if it is a number, else NaN */
    char *origin;       /* "FILE:LINE:COL" or "-P", for messages; owned */
};

/* setting_is_of_file: or of -P? */
static inline bool setting_is_of_file(const struct setting *s) { return strcmp(s->origin, "-P") != 0; }

/* Later ones override earlier ones. */
struct settings {
    struct setting *item; /* [n], owned */
    int n;
};

/* settings_set: add a copy, or replace the one of that name; -P gives texts, a scene file numbers, too.
 * settings_remove: forget number i. settings_clear: forget and free everything. */
void settings_set(struct settings *s, const char *name, const char *value, const char *origin);
void settings_set_number(struct settings *s, const char *name, double number, const char *origin);
void settings_remove(struct settings *s, int i);
void settings_clear(struct settings *s);

/* settings_find: the one of that name, or NULL. */
const struct setting *settings_find(const struct settings *s, const char *name);

/* settings_choice: which of the names, ended by NULL, the value is; *out = fallback when not set. Returns false with a
 * message naming origin, name, value and the names. */
bool settings_choice(const struct settings *s, const char *name, int fallback, const char *const *names, int *out,
                     struct error *err);

/* settings_fields: all fields of a table of integers, numbers and words into the struct at `into`. Returns false with a
 * message naming origin, name, value and what is allowed. */
bool settings_fields(const struct settings *s, const struct field *table, void *into, struct error *err);

#endif
