/* field.h: the parameters of a method, a material, a shape or any other object of a scene as one table, from which
 * help, scene files, -P and tests take all they know. Defaults are given nowhere else.
 * Tests: test_options.c, test_parser.c, test_format.c, test_asbdpt.c, test/run/cli.sh. */
#ifndef ASBDPT_FIELD_H
#define ASBDPT_FIELD_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/error.h"

/* What a parameter is, and the type of its place in the struct. Methods have those of the second line alone. */
enum field_kind {
    FIELD_OTHER,         /* nothing: who makes the object reads it */
    FIELD_INTEGER, FIELD_NUMBER, FIELD_WORD, /* int; double; int: which of the words */
    FIELD_SWITCH,        /* bool */
    FIELD_POINT,         /* vec3 */
    FIELD_FLOAT_TEXTURE, /* int: a texture of numbers, or one made for a number, each from low to high */
    FIELD_RGB_TEXTURE,   /* int: of colours */
    FIELD_OPERAND,       /* int: of what the texture is that is being made; */
    FIELD_VALUE,         /* rgb: a value of that type */
    FIELD_MATERIAL,      /* int: a material made before */
    FIELD_FOURIER_TABLE, /* const struct fourier_table *: from a file; the scene's */
    FIELD_FILE,          /* const char *: a path that may be read, or NULL; borrowed */
    FIELD_INDICES, FIELD_POINTS, FIELD_VECTORS, FIELD_NORMALS, FIELD_PAIRS, /* struct field_list: of three, of two */
    FIELD_IGNORED        /* nothing depends on it */
};

struct field {
    const char *name;
    enum field_kind kind;
    size_t place;               /* in the struct to be filled */
    double fallback, low, high; /* low <= value <= high, any where both are 0; words: the fallback's number */
    const char *help;
    const char *const *words;   /* words: all there are, ended by NULL */
};

/* Numbers of a scene file. */
struct field_list {
    const double *number; /* those of [n] entries, each within NUMBER_MAX; NULL: there are none */
    int n;
};

#define FIELD_KEPT ((double)NAN) /* the fallback is the value that is there already; of numbers, points and textures */

/* field_find: the one of that name in a table, which ends with one without, or NULL. field_fallback: of the three kinds
 * that methods have: the default as text [size]. */
const struct field *field_find(const struct field *table, const char *name);
void field_fallback(const struct field *f, char *text, size_t size);

/* --- settings ----------------------------------------------------------------------------------------- */

/* The parameters of an integrator as a scene file and -P give them, kept as text until they are read by a table. Later
 * ones override earlier ones. */
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
