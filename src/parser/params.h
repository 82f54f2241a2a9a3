/* params.h: the typed parameter list of one directive, e.g.  "float radius" 2  "rgb Kd" [.5 .5 .5].
 *
 * The list is read whole, then asked for by name. Each question has a default, so the code that makes a sphere
 * reads like its documentation. Nothing is passed over in silence: where pbrt-v3 goes on with the default (a type that
 * does not fit, too few values) there is a warning. What cannot be meant (a number out of range, a file that is not
 * there) is an error: the first is reported and noted in `failed`, and later questions are answered with defaults.
 * Tests: test_parser.c. */
#ifndef ASBDPT_PARAMS_H
#define ASBDPT_PARAMS_H

#include "base/bits.h"
#include "base/field.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "parser/lexer.h"
#include "parser/scene_files.h"

enum param_type {
    PARAM_INTEGER,
    PARAM_FLOAT,
    PARAM_BOOL,
    PARAM_STRING,
    PARAM_TEXTURE,
    PARAM_POINT2,
    PARAM_VECTOR2,
    PARAM_POINT, /* point or point3 */
    PARAM_VECTOR,
    PARAM_NORMAL,
    PARAM_RGB, /* rgb or color */
    PARAM_XYZ,
    PARAM_BLACKBODY,
    PARAM_SPECTRUM, /* numbers, or the name of an .spd file */
    PARAM_TYPES
};

struct param {
    enum param_type type;
    const char *name;
    struct source_position position; /* of the quoted declaration */
    int n;             /* values; fewer than bytes in a file (text_read) */
    bool is_text;      /* strings (also bools), else numbers */
    bool used;
    unsigned asked;    /* types that were asked for under this name, none of which it has; a mask, 1u << PARAM_FLOAT */
    double *number;    /* [n] if they are numbers */
    const char **text; /* [n] if they are strings */
};

enum { MAX_PARAMETERS = 64 }; /* of a directive: more than any has names for */

/* A list that outlives its directive. */
struct param_list {
    struct param *item; /* [n], in an arena, with their values */
    int n;
};

/* Reused from list to list; zero-initialised before the first and released by params_free after the last. */
struct params {
    /* To be set. What the list belongs to, for messages: directive "Shape", type "sphere". */
    const char *directive, *type;
    struct source_position position; /* of the type */
    struct messages *messages;
    struct scene_files *files;
    struct arena *arena; /* for what outlives the list */
    /* Set by params_read: */
    bool failed;                      /* there was an error */
    struct param item[MAX_PARAMETERS]; /* [n] */
    int n;
    struct param_list behind; /* another list that is asked for what this one does not have */
    double *number;           /* all numbers of all items, owned */
    const char **string;      /* all strings, owned array of texts in the lexer's arena */
    size_t n_number, n_string;
};

/* params_read: read the list that starts at the lexer's position, up to the first token that is not a declaration.
 * False with a message. params_keep: a copy of the list, in the arena. */
bool params_read(struct params *p, struct lexer *l);
struct param_list params_keep(const struct params *p);
void params_free(struct params *p);

/* params_fail: an error, unless there is one already. Returns false. */
bool params_fail(struct params *p, struct source_position at, const char *format, ...);

/* params_ignore: accept a parameter of any type without using it. Returns it, or NULL. */
const struct param *params_ignore(struct params *p, const char *name);

/* One value, or the default. All questions refuse numbers beyond NUMBER_MAX (number.h). Of params_int and params_number
 * the default need not lie from low to high; whole numbers are rounded towards 0. */
bool params_bool(struct params *p, const char *name, bool fallback);
int params_int(struct params *p, const char *name, int fallback, int low, int high);
double params_number(struct params *p, const char *name, double fallback, double low, double high);
vec3 params_vec3(struct params *p, const char *name, enum param_type type, vec3 fallback); /* point, vector, normal */
rgb params_rgb(struct params *p, const char *name, rgb fallback); /* rgb, xyz, blackbody or spectrum */

/* params_numbers: n numbers into out; false if there are not as many. */
bool params_numbers(struct params *p, const char *name, double *out, int n);

/* params_list: numbers of a parameter of one of the types in the mask (1u << PARAM_FLOAT | ...), in groups. */
struct field_list params_list(struct params *p, const char *name, unsigned types, int group);

/* params_text: the one value of a parameter of type PARAM_STRING or PARAM_TEXTURE, or NULL; *at is where it is
 * declared. params_file: that of a "string NAME" as a path (scene_files_path), to be given to free(); NULL if it is
 * absent, "" or, with an error, refused. */
const char *params_text(struct params *p, const char *name, enum param_type type, struct source_position *at);
char *params_file(struct params *p, const char *name, struct source_position *at);

/* params_choice: a string that should be one of a NULL-terminated list; returns its index (0 = default if absent). */
int params_choice(struct params *p, const char *name, const char *const *choices);

/* params_type_name: as scene files have it: "integer", "rgb" ... params_name_types: those of a mask as text [size], "a
 * colour (rgb) or a texture". */
const char *params_type_name(enum param_type type);
void params_name_types(unsigned types, char *text, size_t size);

#endif
