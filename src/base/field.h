/* field.h: the parameters of a method, a material, a shape or any other object of a scene as one table, from which
 * help, scene files, -P and tests take all they know, and in which alone a default stands.
 *
 * Tests: test_options.c, test_parser.c, test_format.c.
 */
#ifndef ASBDPT_FIELD_H
#define ASBDPT_FIELD_H

#include <stddef.h>

/* What a parameter is, and what stands at its place in the struct. */
enum field_kind {
    FIELD_INTEGER, /* int */
    FIELD_NUMBER,  /* double */
    FIELD_WORD     /* int: which of the words */
};

struct field {
    const char *name;
    enum field_kind kind;
    size_t place;               /* in the struct to be filled */
    double fallback, low, high; /* integers and numbers: low <= value <= high; words: the fallback's number */
    const char *help;
    const char *const *words;   /* words: all there are, ended by NULL */
};

/* field_find: the one of that name in a table, which ends with one without, or NULL. */
const struct field *field_find(const struct field *table, const char *name);

/* field_type: as pbrt's scene files call it, of the three kinds that methods have: "integer", "float" or "string". */
const char *field_type(const struct field *f);

/* field_fallback: the default of such as text [size]. */
void field_fallback(const struct field *f, char *text, size_t size);

#endif
