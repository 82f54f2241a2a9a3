/* field.h: the parameters of a method, a material, a shape or any other object of a scene as one table, from which
 * help, scene files, -P and tests take all they know. Defaults are given nowhere else.
 *
 * Two readers go by such tables, for what is wrong has other consequences: of an object pbrt-v3 warns and goes on with
 * the default (parser/parse.c), of a method it is an error (settings.h).
 * Tests: test_options.c, test_parser.c, test_format.c, test_asbdpt.c, test/run/cli.sh. */
#ifndef ASBDPT_FIELD_H
#define ASBDPT_FIELD_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

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
    FIELD_PART,          /* int: an object of the same directive that was made before */
    FIELD_TABLE,         /* a pointer to what a file holds; the scene's */
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
static inline const struct field *field_find(const struct field *table, const char *name)
{
    while (table->name != NULL && strcmp(table->name, name) != 0)
        table++;
    return table->name != NULL ? table : NULL;
}

static inline void field_fallback(const struct field *f, char *text, size_t size)
{
    if (f->kind == FIELD_WORD)
        snprintf(text, size, "%s", f->words[(int)f->fallback]);
    else
        snprintf(text, size, "%g", f->fallback);
}

#endif
