/* params.c: see params.h. */
#include "parser/params.h"

#include <ctype.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/os.h"
#include "parser/spectrum.h"
#include "parser/symbols.h"

/* One row per spelling; the first of a type is its name in messages. */
static const struct {
    const char *name;
    enum param_type type;
} TYPES[] = {{"integer", PARAM_INTEGER},  {"float", PARAM_FLOAT},
             {"bool", PARAM_BOOL},        {"string", PARAM_STRING},
             {"texture", PARAM_TEXTURE},  {"point2", PARAM_POINT2},
             {"vector2", PARAM_VECTOR2},  {"point", PARAM_POINT},
             {"point3", PARAM_POINT},     {"vector", PARAM_VECTOR},
             {"vector3", PARAM_VECTOR},   {"normal", PARAM_NORMAL},
             {"rgb", PARAM_RGB},          {"color", PARAM_RGB},
             {"xyz", PARAM_XYZ},          {"blackbody", PARAM_BLACKBODY},
             {"spectrum", PARAM_SPECTRUM}};
enum { N_TYPES = sizeof TYPES / sizeof TYPES[0] };

static const char *type_name(enum param_type type)
{
    for (int i = 0; i < N_TYPES; i++)
        if (TYPES[i].type == type)
            return TYPES[i].name;
    return "";
}

bool params_fail(struct params *p, struct source_position at, const char *format, ...)
{
    if (p->failed)
        return false;
    p->failed = true;
    char text[ERROR_TEXT_SIZE / 2];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return source_error(p->messages, at, "%s", text);
}

/* --- reading ------------------------------------------------------------------------------------------ */

/* Split a copy of "type name". The type remains PARAM_TYPES, with a warning, where the parameter cannot be used. */
static void read_declaration(struct params *p, const struct token *t, struct param *item)
{
    char *text = arena_alloc(item->values.arena, strlen(t->text) + 1);
    strcpy(text, t->text);
    const char *type = strtok(text, " \t"), *name = strtok(NULL, " \t");
    item->type = PARAM_TYPES;
    item->name = t->text;
    if (type == NULL || name == NULL) {
        source_warn(p->messages, t->position, NULL, "the parameter \"%.40s\" is passed over: it is declared by its "
                    "type and its name, like \"float radius\"", t->text);
        return;
    }
    struct suggestion near = suggest_start(type);
    for (int i = 0; i < N_TYPES; i++) {
        suggest_offer(&near, TYPES[i].name);
        if (strcmp(TYPES[i].name, type) == 0) {
            item->type = TYPES[i].type;
            item->name = name;
            return;
        }
    }
    if (near.name != NULL)
        source_warn(p->messages, t->position, NULL, "the parameter \"%.40s\" is passed over: unknown type; did you "
                    "mean \"%s\"?", t->text, near.name);
    else
        source_warn(p->messages, t->position, NULL, "the parameter \"%.40s\" is passed over: unknown type; types are "
                    "integer, float, bool, string, texture, point2, vector2, point, vector, normal, rgb, xyz, "
                    "blackbody and spectrum", t->text);
}

static bool wants_text(enum param_type type)
{
    return type == PARAM_BOOL || type == PARAM_STRING || type == PARAM_TEXTURE;
}

static bool add_number(struct params *p, struct param *item, double number)
{
    p->number = mem_grow(p->number, &p->number_capacity, p->n_number + 1, sizeof *p->number);
    p->number[p->n_number++] = number;
    item->n++;
    return true;
}

/* One value that is not a plain number: a string, a bare true or false, a number with an appendix, or a mistake. */
static bool read_text(struct params *p, struct lexer *l, struct param *item)
{
    struct token t;
    char buffer[64];
    struct lexer before = *l;
    if (!lexer_next(l, &t)) {
        p->failed = true;
        return false;
    }
    if (t.kind == TOKEN_NUMBER && !item->is_text)
        return add_number(p, item, t.number);
    bool bare_bool = t.kind == TOKEN_WORD && (strcmp(t.text, "true") == 0 || strcmp(t.text, "false") == 0);
    bool text = t.kind == TOKEN_STRING || (item->type == PARAM_BOOL && bare_bool);
    if (t.kind == TOKEN_WORD && !text)
        *l = before; /* it may be the next directive */
    if (!text || (item->n > 0 && !item->is_text))
        return params_fail(p, t.position, "\"%s\" wants %s here, not %s", item->name,
                           item->is_text || (item->n == 0 && wants_text(item->type)) ? "a quoted string" : "a number",
                           token_text(&t, buffer, sizeof buffer));
    item->is_text = true;
    p->string = mem_grow(p->string, &p->string_capacity, p->n_string + 1, sizeof *p->string);
    p->string[p->n_string++] = t.text;
    item->n++;
    return true;
}

static bool read_value(struct params *p, struct lexer *l, struct param *item)
{
    double number;
    if (item->is_text || !lexer_number(l, &number))
        return read_text(p, l, item);
    return add_number(p, item, number);
}

static bool read_values(struct params *p, struct lexer *l, struct param *item)
{
    item->values = *l;
    if (lexer_peek(l) != TOKEN_OPEN)
        return read_value(p, l, item);
    struct token open;
    lexer_next(l, &open);
    item->values = *l;
    for (;;) {
        enum token_kind next = lexer_peek(l);
        if (next == TOKEN_CLOSE)
            return lexer_next(l, &open);
        if (next == TOKEN_END || item->n == INT_MAX)
            return params_fail(p, open.position, "this [ has no ]; close the list of values");
        if (!read_value(p, l, item))
            return false;
    }
}

/* Numbers where strings belong and the reverse: pbrt-v3 passes over such a parameter. */
static bool is_usable(struct params *p, const struct param *item)
{
    if (item->type == PARAM_TYPES)
        return false;
    if (item->type == PARAM_SPECTRUM || item->n == 0 || item->is_text == wants_text(item->type))
        return true;
    source_warn(p->messages, item->position, NULL, "\"%s %.40s\" is passed over: it wants %s", type_name(item->type),
                item->name, item->is_text ? "numbers, not strings" : "a quoted string, not a number");
    return false;
}

bool params_read(struct params *p, struct lexer *l)
{
    p->n = p->n_asked = 0;
    p->n_number = p->n_string = 0;
    p->failed = p->excess = false;
    while (lexer_peek(l) == TOKEN_STRING) {
        struct token t;
        if (!lexer_next(l, &t))
            return false;
        struct param item = {.position = t.position, .values = *l};
        read_declaration(p, &t, &item);
        size_t first_number = p->n_number, first_string = p->n_string;
        if (!read_values(p, l, &item))
            return false;
        item.first = item.is_text ? first_string : first_number;
        if (!is_usable(p, &item))
            continue;
        p->item = mem_grow(p->item, &p->capacity, (size_t)p->n + 1, sizeof *p->item);
        p->item[p->n++] = item;
    }
    return true;
}

int params_take(struct params *p, const struct params *from, const struct param *item)
{
    struct param copy = *item;
    size_t n = (size_t)item->n;
    for (int i = 0; i < p->n; i++)
        if (strcmp(p->item[i].name, item->name) == 0 &&
            (item->type == PARAM_TEXTURE || p->item[i].type == PARAM_TEXTURE || p->item[i].type == item->type))
            p->item[i--] = p->item[--p->n];
    if (item->is_text) {
        p->string = mem_grow(p->string, &p->string_capacity, p->n_string + n, sizeof *p->string);
        memcpy(p->string + p->n_string, from->string + item->first, n * sizeof *p->string);
        copy.first = p->n_string;
        p->n_string += n;
    } else {
        p->number = mem_grow(p->number, &p->number_capacity, p->n_number + n, sizeof *p->number);
        memcpy(p->number + p->n_number, from->number + item->first, n * sizeof *p->number);
        copy.first = p->n_number;
        p->n_number += n;
    }
    p->item = mem_grow(p->item, &p->capacity, (size_t)p->n + 1, sizeof *p->item);
    p->item[p->n] = copy;
    return p->n++;
}

void params_free(struct params *p)
{
    free(p->item);
    free(p->number);
    free(p->string);
    memset(p, 0, sizeof *p);
}

/* --- asking ------------------------------------------------------------------------------------------- */

struct source_position param_value_position(const struct param *item, int k)
{
    struct messages silent = {0};
    struct lexer l = item->values;
    l.messages = &silent;
    struct token t = {.position = item->position};
    for (int i = 0; i <= k; i++)
        if (!lexer_next(&l, &t))
            break;
    messages_end(&silent);
    return t.position;
}

static void remember_name(struct params *p, const char *name)
{
    for (int i = 0; i < p->n_asked; i++)
        if (strcmp(p->asked[i], name) == 0)
            return;
    if (p->n_asked < MAX_ASKED)
        p->asked[p->n_asked++] = name;
}

/* The last parameter of this name and one of the types; like pbrt, a later one replaces an earlier one. */
static struct param *find(struct params *p, const char *name, unsigned types)
{
    remember_name(p, name);
    struct param *found = NULL;
    for (int i = 0; i < p->n; i++) {
        struct param *item = &p->item[i];
        if ((types & 1u << item->type) == 0 || strcmp(item->name, name) != 0)
            continue;
        if (found != NULL)
            source_warn(p->messages, item->position, NULL, "parameter \"%s\" is given twice; the last one counts",
                        name);
        item->used = true;
        found = item;
    }
    return found;
}

/* Whole numbers have ranges of their own, which params_int checks. */
static bool numbers_usable(struct params *p, const struct param *item)
{
    for (int i = 0; !item->is_text && item->type != PARAM_INTEGER && i < item->n; i++) {
        double number = p->number[item->first + (size_t)i];
        if (!(fabs(number) <= NUMBER_MAX))
            return params_fail(p, param_value_position(item, i), "%g is too large for \"%s\"; numbers go up to %g here",
                               number, item->name, NUMBER_MAX);
    }
    return true;
}

/* A parameter of one thing that is n values, all of them usable. Of another number of things pbrt-v3 takes the default,
 * or the first where p->excess says so; what is left over of a thing it does not count. */
static struct param *find_n(struct params *p, const char *name, unsigned types, int n)
{
    struct param *item = find(p, name, types);
    if (item == NULL || p->failed)
        return NULL;
    int things = item->n / n;
    bool taken = things == 1 || (p->excess && things > 1);
    if (item->n != n)
        source_warn(p->messages, item->position, NULL, "parameter \"%s %s\" of %s \"%s\" wants %d value%s, not %d; %s",
                    type_name(item->type), name, p->directive, p->type, n, n > 1 ? "s" : "", item->n,
                    taken ? "the rest is passed over" : "it is passed over");
    return taken && numbers_usable(p, item) ? item : NULL;
}

const struct param *params_ignore(struct params *p, const char *name) { return find(p, name, ~0u); }

bool params_has(const struct params *p, const char *name, enum param_type type)
{
    for (int i = 0; i < p->n; i++)
        if (p->item[i].type == type && strcmp(p->item[i].name, name) == 0)
            return true;
    return false;
}

/* The one value of a parameter of this type, or NULL. */
static const struct param *find_one(struct params *p, const char *name, enum param_type type)
{
    return find_n(p, name, 1u << type, 1);
}

double params_number(struct params *p, const char *name, double fallback, double low, double high)
{
    const struct param *item = find_one(p, name, PARAM_FLOAT);
    if (item == NULL)
        return fallback;
    double number = p->number[item->first];
    if (number >= low && number <= high)
        return number;
    struct source_position at = param_value_position(item, 0);
    if (high <= NUMBER_MAX)
        params_fail(p, at, "\"%s\" is %g; it must be from %g to %g", name, number, low, high);
    else
        params_fail(p, at, "\"%s\" is %g; it must be %sat least %g", name, number,
                    low == NUMBER_MIN ? "greater than 0, and " : "", low);
    return fallback;
}

int params_int(struct params *p, const char *name, int fallback, int low, int high)
{
    const struct param *item = find_one(p, name, PARAM_INTEGER);
    if (item == NULL)
        return fallback;
    double number = p->number[item->first];
    double whole = trunc(number);
    if (whole != number)
        source_warn(p->messages, item->position, NULL, "\"%s\" is %.12g, which counts as %.12g", name, number, whole);
    if (whole >= low && whole <= high)
        return (int)whole;
    if (low == high)
        params_fail(p, param_value_position(item, 0), "\"%s\" is %.12g; only %d is supported", name, number, low);
    params_fail(p, param_value_position(item, 0), "\"%s\" is %.12g; it must be a whole number from %d to %d", name,
                number, low, high);
    return fallback;
}

bool params_bool(struct params *p, const char *name, bool fallback)
{
    const struct param *item = find_one(p, name, PARAM_BOOL);
    if (item == NULL)
        return fallback;
    const char *text = p->string[item->first];
    if (strcmp(text, "true") != 0 && strcmp(text, "false") != 0)
        source_warn(p->messages, item->position, NULL, "\"%s\" is \"%.40s\", which counts as \"false\"", name, text);
    return strcmp(text, "true") == 0;
}

const char *params_text(struct params *p, const char *name, enum param_type type, struct source_position *at)
{
    const struct param *item = find_one(p, name, type);
    if (item == NULL)
        return NULL;
    *at = param_value_position(item, 0);
    return p->string[item->first];
}

static vec3 three_numbers(struct params *p, const char *name, enum param_type type, vec3 fallback)
{
    const struct param *item = find_n(p, name, 1u << type, 3);
    if (item == NULL)
        return fallback;
    const double *x = p->number + item->first;
    return vec(x[0], x[1], x[2]);
}

vec3 params_point(struct params *p, const char *name, vec3 fallback)
{
    return three_numbers(p, name, PARAM_POINT, fallback);
}

vec3 params_vector(struct params *p, const char *name, vec3 fallback)
{
    return three_numbers(p, name, PARAM_VECTOR, fallback);
}

int params_choice(struct params *p, const char *name, const char *const *choices)
{
    const struct param *item = find_one(p, name, PARAM_STRING);
    if (item == NULL)
        return 0;
    const char *text = p->string[item->first];
    for (int i = 0; choices[i] != NULL; i++)
        if (strcmp(choices[i], text) == 0)
            return i;
    const char *near = suggest_from(text, choices);
    source_warn(p->messages, item->position, NULL, "\"%s\" cannot be \"%.40s\", so it is \"%s\"%s%s%s", name, text,
                choices[0], near != NULL ? "; did you mean \"" : "", near != NULL ? near : "",
                near != NULL ? "\"?" : "");
    return 0;
}

const double *params_list(struct params *p, const char *name, unsigned types, int group, int *n,
                          const struct param **found)
{
    const struct param *item = find(p, name, types);
    bool usable = item != NULL && !p->failed && numbers_usable(p, item);
    *n = usable && !item->is_text ? item->n / group : 0;
    if (found != NULL)
        *found = usable ? item : NULL;
    if (usable && (*n == 0 || item->n % group != 0))
        source_warn(p->messages, item->position, NULL,
                    "parameter \"%s %s\" wants its numbers in groups of %d, but there are %d; the rest is passed over",
                    type_name(item->type), name, group, item->n);
    return *n > 0 ? p->number + item->first : NULL;
}

/* --- files and colours -------------------------------------------------------------------------------- */

char *path_join(const char *directory, const char *name)
{
    if (os_absolute(name) || directory[0] == '\0')
        return mem_copy_text(name);
    size_t n = strlen(directory);
    char *path = mem_alloc(n + strlen(name) + 2, 1);
    memcpy(path, directory, n);
    if (!os_separator(directory[n - 1]))
        path[n++] = '/';
    strcpy(path + n, name);
    return path;
}

bool path_ends_in(const char *path, const char *extension)
{
    size_t n = strlen(path), m = strlen(extension);
    for (size_t i = 0; i < m && n >= m; i++)
        if (tolower((unsigned char)path[n - m + i]) != extension[i])
            return false;
    return n >= m;
}

char *params_file(struct params *p, const char *name, struct source_position *at)
{
    const char *file = params_text(p, name, PARAM_STRING, at);
    return file != NULL && file[0] != '\0' ? path_join(p->directory, file) : NULL;
}

/* Wavelength and value pairs of an .spd file: numbers, with comments from # to the end of the line. Errors in it
 * are shown at their position in that file. */
static rgb rgb_from_file(struct params *p, const struct param *item)
{
    rgb colour = rgb_black();
    struct error inner;
    size_t size;
    char *path = path_join(p->directory, p->string[item->first]), *text = text_read(path, &size, &inner);
    if (text == NULL) {
        params_fail(p, param_value_position(item, 0), "%s", inner.text);
        free(path);
        return colour;
    }
    *p->content = hash_combine(*p->content, hash_content(text, size));
    struct arena arena = {NULL, NULL};
    struct source_file file = {path, text, text + size, item->position, false};
    struct lexer l = lexer_start(&file, &arena, p->messages);
    double *number = NULL;
    size_t n = 0, capacity = 0;
    struct token t = {0};
    bool ok = lexer_next(&l, &t);
    for (; ok && t.kind == TOKEN_NUMBER; ok = lexer_next(&l, &t)) {
        number = mem_grow(number, &capacity, n + 1, sizeof *number);
        number[n++] = t.number;
    }
    if (!ok)
        p->failed = true;
    else if (t.kind != TOKEN_END || n < 2 || n % 2 != 0)
        params_fail(p, t.position,
                    "a spectrum file holds pairs of numbers, wavelength in nm and value, and nothing else");
    else
        colour = spectrum_from_samples((double(*)[2])number, (int)(n / 2));
    free(number);
    arena_free(&arena);
    free(text);
    free(path);
    return colour;
}

/* How many values make up this colour: one file name, or numbers; of a spectrum as many pairs as there are. */
static int colour_values(const struct param *item)
{
    if (item->is_text)
        return 1;
    if (item->type == PARAM_RGB || item->type == PARAM_XYZ)
        return 3;
    return item->type == PARAM_BLACKBODY || item->n < 2 ? 2 : item->n - item->n % 2;
}

static rgb rgb_from_numbers(enum param_type type, double *x, int n)
{
    switch ((int)type) {
    case PARAM_RGB: return rgb_make(x[0], x[1], x[2]);
    case PARAM_XYZ: return spectrum_from_xyz(x[0], x[1], x[2]);
    case PARAM_BLACKBODY: return spectrum_blackbody(x[0], x[1]);
    default: return spectrum_from_samples((double(*)[2])x, n / 2);
    }
}

/* Numbers of a colour can be summed, and those of a file are not checked one by one, so what comes out is. */
static bool colour_usable(rgb c)
{
    return fabs(c.r) <= NUMBER_MAX && fabs(c.g) <= NUMBER_MAX && fabs(c.b) <= NUMBER_MAX;
}

rgb params_rgb(struct params *p, const char *name, rgb fallback)
{
    const unsigned types = 1u << PARAM_RGB | 1u << PARAM_XYZ | 1u << PARAM_BLACKBODY | 1u << PARAM_SPECTRUM;
    const struct param *item = find(p, name, types);
    int n = item == NULL ? 0 : colour_values(item);
    if (item == NULL || (item = find_n(p, name, 1u << item->type, n)) == NULL)
        return fallback;
    rgb colour;
    if (item->is_text)
        colour = rgb_from_file(p, item);
    else
        colour = rgb_from_numbers(item->type, p->number + item->first, n);
    if (colour_usable(colour))
        return colour;
    params_fail(p, item->position, "parameter \"%s\" gives the colour (%g %g %g); its numbers go up to %g here", name,
                colour.r, colour.g, colour.b, NUMBER_MAX);
    return fallback;
}

/* --- the end ------------------------------------------------------------------------------------------ */

/* A parameter nobody asked for: does the name exist with another type, or is another name near? */
static void warn_of_unused(struct params *p, const struct param *item)
{
    struct suggestion near = suggest_start(item->name);
    for (int i = 0; i < p->n_asked; i++) {
        if (strcmp(p->asked[i], item->name) == 0) {
            source_warn(p->messages, item->position, NULL,
                        "parameter \"%s\" of %s \"%s\" cannot be of type \"%s\", so it is not used", item->name,
                        p->directive, p->type, type_name(item->type));
            return;
        }
        suggest_offer(&near, p->asked[i]);
    }
    source_warn(p->messages, item->position, NULL, "parameter \"%.40s\" of %s \"%s\" is not used%s%s%s", item->name,
                p->directive, p->type, near.name != NULL ? "; did you mean \"" : "",
                near.name != NULL ? near.name : "", near.name != NULL ? "\"?" : "");
}

bool params_done(struct params *p)
{
    for (int i = 0; i < p->n && !p->failed; i++)
        if (!p->item[i].used)
            warn_of_unused(p, &p->item[i]);
    return !p->failed;
}
