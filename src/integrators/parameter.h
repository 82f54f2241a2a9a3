/* parameter.h: the parameters of a method as one table, from which --help, -P, scene files and --stats take all they
 * know, and in which alone a default stands.
 *
 * Tests: test_options.c.
 */
#ifndef ASBDPT_PARAMETER_H
#define ASBDPT_PARAMETER_H

#include "scene/settings.h"

enum parameter_kind { PARAMETER_INTEGER, PARAMETER_NUMBER, PARAMETER_WORD };

struct method_parameter {
    const char *name;
    enum parameter_kind kind;
    size_t place;               /* in the struct to be filled: of an int, of a double, of an int, the word's number */
    double fallback, low, high; /* integers and numbers: low <= value <= high; words: the fallback's number */
    const char *help;
    const char *const *words;   /* words: all there are, ended by NULL */
};

/* parameters_set: read all parameters of a table, ended by a NULL name, into the struct at `into`. Returns false with a
 * message naming origin, name, value and what is allowed. */
bool parameters_set(const struct method_parameter *table, const struct settings *s, void *into, struct error *err);

/* parameter_find: the parameter of that name in the table, or NULL. */
const struct method_parameter *parameter_find(const struct method_parameter *table, const char *name);

/* parameter_type: as pbrt's scene files call it: "integer", "float" or "string". */
const char *parameter_type(const struct method_parameter *p);

/* parameter_fallback: the default as text [size]. */
void parameter_fallback(const struct method_parameter *p, char *text, size_t size);

#endif
