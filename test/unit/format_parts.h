/* format_parts.h: the parts of the suite `format`: test_format.c has the rows of the pages' tables, format_values.c the
 * lists of parameters. */
#ifndef TEST_FORMAT_PARTS_H
#define TEST_FORMAT_PARTS_H

#include "helpers.h"

/* A scene around one directive of some type, whose list of parameters is to come. */
struct type_text {
    char directive[100]; /* Shape "sphere" */
    const struct field *fields; /* the parameters of the type; others in a list belong to other types */
    const char *before, *after;
};

/* check_format_values: is every parameter of a list of the page what the list says? */
void check_format_values(struct test *t, const struct type_text *type, const char *list);

#endif
