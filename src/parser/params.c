/* params.c: see params.h. */
#include "parser/params.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/near.h"
#include "base/number.h"
#include "parser/spectrum.h"

/* --- reading ------------------------------------------------------------------------------------------ */

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

const char *params_type_name(enum param_type type)
{
    for (int i = 0; i < N_TYPES; i++)
        if (TYPES[i].type == type)
            return TYPES[i].name;
    return "";
}

enum { COLOURS = 1u << PARAM_RGB | 1u << PARAM_XYZ | 1u << PARAM_BLACKBODY | 1u << PARAM_SPECTRUM };

void params_name_types(unsigned types, char *text, size_t size)
{
    const char *join = "";
    text[0] = '\0';
    for (int k = 1; k <= PARAM_TYPES; k++) { /* textures, which may stand for others, last */
        int i = (PARAM_TEXTURE + k) % PARAM_TYPES;
        const char *article = i == PARAM_RGB ? "a colour (" : i == PARAM_INTEGER ? "an " : "a ";
        size_t used = strlen(text);
        if ((types & 1u << i) == 0 || ((1u << i & COLOURS) != 0 && i != PARAM_RGB))
            continue;
        snprintf(text + used, size - used, "%s%s%s%s", join, article, params_type_name((enum param_type)i),
                 i == PARAM_RGB ? ")" : "");
        join = " or ";
    }
}

/* Split a copy of "type name" into item->type and ->name. The type is PARAM_TYPES, with a warning, where it cannot be
 * used. */
static void read_declaration(struct params *p, const struct token *t, struct param *item)
{
    char *text = arena_text(p->arena, t->text);
    const char *type = strtok(text, " \t"), *name = strtok(NULL, " \t");
    struct near near = near_start(name != NULL ? type : "");
    item->type = PARAM_TYPES;
    item->name = name != NULL ? name : t->text;
    for (int i = 0; i < N_TYPES && name != NULL; i++) {
        near_try(&near, TYPES[i].name);
        if (strcmp(TYPES[i].name, type) == 0)
            item->type = TYPES[i].type;
    }
    if (item->type == PARAM_TYPES)
        source_warn(p->messages, t->position,
                    "the parameter \"%.40s\" is passed over: it wants a type and a name, like \"float radius\"; types "
                    "are integer, float, bool, string, texture, point2, vector2, point, vector, normal, rgb, xyz, "
                    "blackbody and spectrum%s", t->text, near.text);
}

static bool wants_text(enum param_type type)
{
    return type == PARAM_BOOL || type == PARAM_STRING || type == PARAM_TEXTURE;
}

/* One more value. Returns true. */
static bool add_number(struct params *p, struct param *item, double number)
{
    p->number = mem_append(p->number, p->n_number, sizeof *p->number);
    p->number[p->n_number++] = number;
    item->n++;
    return true;
}

static bool add_text(struct params *p, struct param *item, const char *text)
{
    p->string = mem_append(p->string, p->n_string, sizeof *p->string);
    p->string[p->n_string++] = text;
    item->is_text = true;
    item->n++;
    return true;
}

/* One value that is not a plain number: a string, a bare true or false, a number with an appendix, or a mistake. */
static bool read_text(struct params *p, struct lexer *l, struct param *item)
{
    struct token t;
    char buffer[64];
    if (!lexer_next(l, &t)) {
        p->failed = true;
        return false;
    }
    if (t.kind == TOKEN_NUMBER && !item->is_text)
        return add_number(p, item, t.number);
    bool bare_bool = t.kind == TOKEN_WORD && (strcmp(t.text, "true") == 0 || strcmp(t.text, "false") == 0);
    bool text = t.kind == TOKEN_STRING || (item->type == PARAM_BOOL && bare_bool);
    if (!text || (item->n > 0 && !item->is_text))
        return params_fail(p, t.position, "\"%s\" wants %s here, not %s", item->name,
                           item->is_text || (item->n == 0 && wants_text(item->type)) ? "a quoted string" : "a number",
                           token_text(&t, buffer, sizeof buffer));
    return add_text(p, item, t.text);
}

static bool read_value(struct params *p, struct lexer *l, struct param *item)
{
    double number;
    return item->is_text || !lexer_number(l, &number) ? read_text(p, l, item) : add_number(p, item, number);
}

static bool read_values(struct params *p, struct lexer *l, struct param *item)
{
    if (lexer_peek(l) != TOKEN_OPEN)
        return read_value(p, l, item);
    struct token open;
    lexer_next(l, &open);
    for (;;) {
        enum token_kind next = lexer_peek(l);
        if (next == TOKEN_CLOSE)
            return lexer_next(l, &open);
        if (next == TOKEN_END)
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
    source_warn(p->messages, item->position, "\"%s %.40s\" is passed over: it wants %s", params_type_name(item->type),
                item->name, item->is_text ? "numbers, not strings" : "a quoted string, not a number");
    return false;
}

static bool read_items(struct params *p, struct lexer *l)
{
    while (lexer_peek(l) == TOKEN_STRING) {
        struct token t;
        if (!lexer_next(l, &t))
            return false;
        if (p->n == MAX_PARAMETERS)
            return params_fail(p, t.position, "more than %d parameters; nothing has so many", MAX_PARAMETERS);
        struct param item = {.position = t.position};
        read_declaration(p, &t, &item);
        size_t n_number = p->n_number, n_string = p->n_string;
        if (!read_values(p, l, &item))
            return false;
        if (is_usable(p, &item)) {
            p->item[p->n++] = item;
        } else {
            p->n_number = n_number;
            p->n_string = n_string;
        }
    }
    return true;
}

bool params_read(struct params *p, struct lexer *l)
{
    p->n = 0;
    p->n_number = p->n_string = 0;
    p->failed = false;
    bool ok = read_items(p, l);
    size_t numbers = 0, texts = 0;
    for (struct param *item = p->item; item < p->item + p->n; item++) { /* the arrays do not move any more */
        item->number = item->is_text ? NULL : p->number + numbers;
        item->text = item->is_text ? p->string + texts : NULL;
        *(item->is_text ? &texts : &numbers) += (size_t)item->n;
    }
    return ok;
}

/* n values in the arena. */
static void *copy_values(struct arena *arena, const void *values, int n, size_t size)
{
    void *copy = arena_alloc(arena, (size_t)n * size);
    return n > 0 ? memcpy(copy, values, (size_t)n * size) : copy;
}

struct param_list params_keep(const struct params *p)
{
    struct param_list kept = {copy_values(p->arena, p->item, p->n, sizeof *kept.item), p->n};
    for (struct param *item = kept.item; item < kept.item + kept.n; item++)
        if (item->is_text)
            item->text = copy_values(p->arena, item->text, item->n, sizeof *item->text);
        else
            item->number = copy_values(p->arena, item->number, item->n, sizeof *item->number);
    return kept;
}

void params_free(struct params *p)
{
    free(p->number);
    free(p->string);
}

/* --- asking ------------------------------------------------------------------------------------------- */

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

/* The last parameter of this name and one of the types: as in pbrt, a later one replaces an earlier one. Without one,
 * that of the list behind, unless this list has a value in place of its texture or the reverse. */
static struct param *find(struct params *p, const char *name, unsigned types)
{
    struct param *found = NULL;
    bool hidden = false, texture = types == 1u << PARAM_TEXTURE;
    for (struct param *item = p->item; item < p->item + p->n; item++) {
        if (strcmp(item->name, name) != 0)
            continue;
        hidden |= (item->type == PARAM_TEXTURE) != texture;
        if ((types & 1u << item->type) == 0) {
            item->asked |= types;
            continue;
        }
        if (found != NULL && !item->used)
            source_warn(p->messages, item->position, "parameter \"%s\" is given twice; the last one counts", name);
        item->used = true;
        found = item;
    }
    if (found != NULL || hidden)
        return found;
    for (int i = 0; i < p->behind.n; i++)
        if (strcmp(p->behind.item[i].name, name) == 0 && (types & 1u << p->behind.item[i].type) != 0)
            found = &p->behind.item[i];
    return found;
}

/* Whole numbers have ranges of their own, which params_int checks. */
static bool numbers_usable(struct params *p, const struct param *item)
{
    for (int i = 0; !item->is_text && item->type != PARAM_INTEGER && i < item->n; i++)
        if (!(fabs(item->number[i]) <= NUMBER_MAX))
            return params_fail(p, item->position, "%g is too large for \"%s\"; numbers go up to %g here",
                               item->number[i], item->name, NUMBER_MAX);
    return true;
}

static void warn_of_empty(struct params *p, const struct param *item)
{
    source_warn(p->messages, item->position, "parameter \"%s %s\" is empty, and is passed over",
                params_type_name(item->type), item->name);
}

/* A parameter that is n values, all of them usable. As in pbrt-v3, of fewer the default counts, and of more, except for
 * a rest: four numbers are one colour, six are two. */
static struct param *find_n(struct params *p, const char *name, unsigned types, int n)
{
    struct param *item = find(p, name, types);
    if (item == NULL || p->failed)
        return NULL;
    bool fits = item->type == PARAM_FLOAT ? item->n == n : item->n / n == 1;
    if (item->n == 0)
        warn_of_empty(p, item);
    else if (item->n != n)
        source_warn(p->messages, item->position, "parameter \"%s %s\" of %s \"%s\" wants %d value%s%s, not %d; %s",
                    params_type_name(item->type), name, p->directive, p->type, n, n > 1 ? "s" : "",
                    item->type == PARAM_BLACKBODY ? ", kelvin and a factor" : "", item->n,
                    fits ? "the rest is passed over" : "it is passed over");
    return fits && numbers_usable(p, item) ? item : NULL;
}

const struct param *params_ignore(struct params *p, const char *name) { return find(p, name, ~0u); }

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
    double number = item->number[0];
    if (number >= low && number <= high)
        return number;
    params_fail(p, item->position, "\"%s\" is %g; it must be from %g to %g", name, number, low, high);
    return fallback;
}

bool params_numbers(struct params *p, const char *name, double *out, int n)
{
    const struct param *item = find_n(p, name, 1u << PARAM_FLOAT, n);
    if (item != NULL)
        memcpy(out, item->number, (size_t)n * sizeof *out);
    return item != NULL;
}

int params_int(struct params *p, const char *name, int fallback, int low, int high)
{
    const struct param *item = find_one(p, name, PARAM_INTEGER);
    if (item == NULL)
        return fallback;
    double number = item->number[0], whole = trunc(number);
    if (whole != number)
        source_warn(p->messages, item->position, "\"%s\" is %.12g, which counts as %.12g", name, number, whole);
    if (whole >= low && whole <= high)
        return (int)whole;
    params_fail(p, item->position, "\"%s\" is %.12g; it must be a whole number from %d to %d", name, number, low, high);
    return fallback;
}

bool params_bool(struct params *p, const char *name, bool fallback)
{
    const struct param *item = find_one(p, name, PARAM_BOOL);
    if (item == NULL)
        return fallback;
    const char *text = item->text[0];
    if (strcmp(text, "true") != 0 && strcmp(text, "false") != 0)
        source_warn(p->messages, item->position, "\"%s\" is \"%.40s\", which counts as \"false\"", name, text);
    return strcmp(text, "true") == 0;
}

const char *params_text(struct params *p, const char *name, enum param_type type, struct source_position *at)
{
    const struct param *item = find_one(p, name, type);
    if (item == NULL)
        return NULL;
    *at = item->position;
    return item->text[0];
}

vec3 params_vec3(struct params *p, const char *name, enum param_type type, vec3 fallback)
{
    const struct param *item = find_n(p, name, 1u << type, 3);
    return item == NULL ? fallback : vec(item->number[0], item->number[1], item->number[2]);
}

int params_choice(struct params *p, const char *name, const char *const *choices)
{
    const struct param *item = find_one(p, name, PARAM_STRING);
    if (item == NULL)
        return 0;
    int i = names_find(choices, item->text[0]);
    if (i >= 0)
        return i;
    struct near near = near_of(item->text[0], choices);
    source_warn(p->messages, item->position, "\"%s\" cannot be \"%.40s\", so it is \"%s\"%s", name, item->text[0],
                choices[0], near.name != choices[0] ? near.text : "");
    return 0;
}

struct field_list params_list(struct params *p, const char *name, unsigned types, int group)
{
    const struct param *item = find(p, name, types);
    if (item == NULL || p->failed || !numbers_usable(p, item))
        return (struct field_list){NULL, 0};
    int n = item->is_text ? 0 : item->n / group;
    if (item->n == 0)
        warn_of_empty(p, item);
    else if (n == 0 || item->n % group != 0)
        source_warn(p->messages, item->position,
                    "parameter \"%s %s\" wants its numbers in groups of %d, but there are %d; the rest is passed over",
                    params_type_name(item->type), name, group, item->n);
    return (struct field_list){n > 0 ? item->number : NULL, n};
}

/* --- files and colours -------------------------------------------------------------------------------- */

char *params_file(struct params *p, const char *name, struct source_position *at)
{
    const char *file = params_text(p, name, PARAM_STRING, at);
    struct error refused;
    if (file == NULL || file[0] == '\0')
        return NULL;
    char *path = scene_files_path(p->files, file, &refused);
    if (path == NULL)
        params_fail(p, *at, "%s", refused.text);
    return path;
}

/* The colour of an .spd file. Messages about it are shown at their place in that file. */
static rgb rgb_from_file(struct params *p, const struct param *item)
{
    rgb colour = rgb_black();
    struct error inner;
    struct source_position at;
    size_t size, n;
    char *path = scene_files_path(p->files, item->text[0], &inner);
    char *text = path != NULL ? scene_files_read(p->files, path, &size, &inner) : NULL;
    if (text != NULL) {
        struct source_file file = {path, text, text + size, false};
        double *number = spd_numbers(p->messages, &file, &at, &n);
        if (n < 2)
            params_fail(p, at, "a spectrum file holds pairs of numbers, wavelength in nm and value");
        else
            colour = spectrum_from_samples((double(*)[2])number, (int)(n / 2));
        if (n > 2 && n % 2 != 0)
            source_warn(p->messages, at, "this number of a spectrum file has no partner, and is passed over");
        free(number);
    } else {
        params_fail(p, item->position, "%s%s", inner.text, strchr(item->text[0], '.') != NULL ? "" :
                    "; a spectrum here is a file, or numbers: pbrt-v4's names of spectra are not known");
    }
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
    if (type == PARAM_RGB)
        return rgb_make(x[0], x[1], x[2]);
    if (type == PARAM_XYZ)
        return spectrum_from_xyz(x[0], x[1], x[2]);
    if (type == PARAM_BLACKBODY)
        return spectrum_blackbody(x[0], x[1]);
    return spectrum_from_samples((double(*)[2])x, n / 2);
}

/* Numbers of a colour can be summed, and those of a file are not checked one by one, so what comes out is. */
rgb params_rgb(struct params *p, const char *name, rgb fallback)
{
    struct param *item = find(p, name, COLOURS);
    int n = item == NULL ? 0 : colour_values(item);
    if (item == NULL || (item = find_n(p, name, 1u << item->type, n)) == NULL)
        return fallback;
    rgb colour = item->is_text ? rgb_from_file(p, item) : rgb_from_numbers(item->type, item->number, n);
    if (fabs(colour.r) <= NUMBER_MAX && fabs(colour.g) <= NUMBER_MAX && fabs(colour.b) <= NUMBER_MAX)
        return colour;
    params_fail(p, item->position, "parameter \"%s\" gives the colour (%g %g %g); its numbers go up to %g here", name,
                colour.r, colour.g, colour.b, NUMBER_MAX);
    return fallback;
}
