/* parser_parts.h: the parts of the suite `parser`: test_parser.c has the fixtures, parser_words.c what scenes hold,
 * parser_pieces.c numbers, names, spectra and messages, parser_limits.c what a scene may repeat, and the bounds of its
 * parameters; and of the suite `format`: test_format.c has the rows of the pages' tables, format_values.c the lists of
 * parameters.
 */
#ifndef TEST_PARSER_PARTS_H
#define TEST_PARSER_PARTS_H

#include "scene/scene.h"
#include "helpers.h"
#include "test.h"

enum { MAX_WARNINGS = 32, TEXT = 512 };

/* Messages as they come. */
struct heard {
    char text[MAX_WARNINGS][TEXT];
    int n;
};

struct hearing {
    struct heard warnings, errors;
};

/* A sink of messages whose context is a struct hearing. */
void hear_message(void *context, bool is_error, const char *text);

/* leave_out_directory: of a text, wherever the test's own directory is named in it. */
void leave_out_directory(struct test *t, char *text);

/* scene_in_words: a scene, as far as these tests look at it; to be given to free(). */
char *scene_in_words(struct test *t, const struct scene *s);

/* link_parts: what the fixtures name, parts/, pictures/ and features/, in the test's own directory. */
void link_parts(struct test *t);

void check_contents(struct test *t, const char *name, const char *text, const struct scene *s);
void check_parser_pieces(struct test *t);
void check_parser_limits(struct test *t);

/* A scene around one directive of some type, whose list of parameters is to come. */
struct type_text {
    char directive[100]; /* Shape "sphere" */
    const struct field *fields; /* the parameters of the type; others in a list belong to other types */
    const char *before, *after;
};

/* check_format_values: is every parameter of a list of the page what the list says? */
void check_format_values(struct test *t, const struct type_text *type, const char *list);

#endif
