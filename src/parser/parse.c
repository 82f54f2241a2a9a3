/* parse.c: what directives have in common: reading their arguments, choosing the type of an object by its name, and
 * reading its parameters by a table. See parse.h. */
#include "parser/parse.h"

#include <string.h>

#include "base/bits.h"

/* --- arguments of directives -------------------------------------------------------------------------- */

bool parse_string(struct parser *p, struct token *out, const char *what)
{
    char found[64];
    struct lexer before = p->lexer;
    if (!lexer_next(&p->lexer, out))
        return false;
    if (out->kind == TOKEN_STRING)
        return true;
    if (out->kind == TOKEN_WORD)
        p->lexer = before; /* it may be the next directive */
    return source_error(&p->messages, out->position, "%s wants %s in quotes here, not %s", p->directive.text, what,
                       token_text(out, found, sizeof found));
}

bool parse_list(struct parser *p, const char *directive, const struct token *type)
{
    struct params *q = &p->params;
    q->directive = directive;
    q->type = type->text;
    q->position = type->position;
    return params_read(q, &p->lexer);
}

bool parse_typed(struct parser *p)
{
    struct token type;
    return parse_string(p, &type, "a type") && parse_list(p, p->directive.text, &type);
}

void parse_no_such(struct parser *p, struct source_position at, const char *name, const char *what,
                   const char *instead)
{
    source_warn(&p->messages, at, "there is no %s \"%.60s\"; %s", what, name, instead);
}

int parse_named(struct parser *p, struct token *name, const struct symbols *table, const char *what,
                const char *instead)
{
    if (!parse_string(p, name, "a name"))
        return -1;
    int i = symbols_find(table, name->text);
    if (i < 0)
        parse_no_such(p, name->position, name->text, what, instead);
    return i;
}

/* --- objects by tables ---------------------------------------------------------------------------------- */

/* "a, b, c": the types of a table that are supported, cut at the buffer's end. */
static void list_types(const struct object_type *types, char *buffer, size_t size)
{
    buffer[0] = '\0';
    for (const struct object_type *t = types; t->name != NULL; t++)
        if (t->parameter != NULL) {
            strncat(buffer, buffer[0] != '\0' ? ", " : "", size - strlen(buffer) - 1);
            strncat(buffer, t->name, size - strlen(buffer) - 1);
        }
}

/* A type that neither pbrt-v3 nor this program knows; *end is the row behind the table, which says what to do: refuse
 * it, leave the directive out, or take the type of this row, by its name in the table if it has one. */
static bool unknown_type(struct parser *p, const struct object_type *types, const struct object_type *end)
{
    struct params *q = &p->params;
    char list[256];
    const char *instead = NULL;
    list_types(types, list, sizeof list);
    for (const struct object_type *t = types; t != end && instead == NULL; t++)
        if (t->parameter == end->parameter && t->kind == end->kind)
            instead = t->name;
    if (end->parameter == NULL && end->kind == REFUSE_OTHERS)
        return type_error(q, "unknown %s \"%.40s\"; known are %s", q->directive, q->type, list);
    if (end->parameter == NULL || instead == NULL)
        source_warn(q->messages, q->position, "unknown %s \"%.40s\" is left out, as pbrt-v3 does; known are %s",
                    q->directive, q->type, list);
    else
        source_warn(q->messages, q->position, "unknown %s \"%.40s\"; \"%s\" is taken instead; known are %s",
                    q->directive, q->type, instead, list);
    return end->parameter != NULL;
}

bool parse_type(struct parser *p, const struct object_type *types)
{
    struct params *q = &p->params;
    char list[256];
    for (p->type = types; p->type->name != NULL; p->type++) {
        if (strcmp(p->type->name, q->type) != 0)
            continue;
        if (p->type->parameter != NULL)
            return true;
        list_types(types, list, sizeof list);
        return type_error(q, "%s \"%s\" of pbrt-v3 is not supported; use one of %s", q->directive, q->type, list);
    }
    return unknown_type(p, types, p->type);
}

void parse_fields(struct parser *p, void *object)
{
    for (const struct parameter *row = p->type->parameter; row->name != NULL; row++)
        if (row->read != NULL)
            row->read(p, row, (char *)object + row->field);
    if (p->type->build != NULL)
        p->type->build(p, object);
}

bool parse_object(struct parser *p, void *object)
{
    parse_fields(p, object);
    return params_done(&p->params);
}

/* --- readers of one parameter --------------------------------------------------------------------------- */

void parse_number(struct parser *p, const struct parameter *row, void *field)
{
    double *x = field;
    *x = params_number(&p->params, row->name, isnan(row->fallback.r) ? *x : row->fallback.r, row->low, row->high);
}

void parse_integer(struct parser *p, const struct parameter *row, void *field)
{
    *(int *)field = params_int(&p->params, row->name, (int)row->fallback.r, (int)row->low, (int)row->high);
}

void parse_bool(struct parser *p, const struct parameter *row, void *field)
{
    *(bool *)field = params_bool(&p->params, row->name, row->fallback.r != 0);
}

void parse_point(struct parser *p, const struct parameter *row, void *field)
{
    vec3 fallback = vec(row->fallback.r, row->fallback.g, row->fallback.b);
    *(vec3 *)field = params_vec3(&p->params, row->name, PARAM_POINT, fallback);
}

void parse_ignored(struct parser *p, const struct parameter *row, void *field)
{
    const struct param *item = params_ignore(&p->params, row->name);
    (void)field;
    if (item != NULL && row->warning != NULL)
        source_warn(&p->messages, item->position, "%s", row->warning);
}

/* --- textures ------------------------------------------------------------------------------------------- */

int parse_constant(struct parser *p, rgb value)
{
    int *slot = &p->constant[hash_content(&value, sizeof value) % CONSTANTS];
    const struct texture *known = *slot > 0 ? &p->scene->textures.texture[*slot - 1] : NULL;
    if (known == NULL || memcmp(&known->constant, &value, sizeof value) != 0)
        *slot = texture_add_constant(&p->scene->textures, value) + 1;
    return *slot - 1;
}

int parse_named_texture(struct parser *p, const char *name, bool is_float)
{
    struct params *q = &p->params;
    const struct symbols *table = is_float ? &p->float_textures : &p->spectrum_textures;
    const struct symbols *other = is_float ? &p->spectrum_textures : &p->float_textures;
    struct source_position at;
    const char *texture = params_text(q, name, PARAM_TEXTURE, &at);
    if (texture == NULL)
        return -1;
    int id = symbols_find(table, texture);
    if (id < 0 && symbols_find(other, texture) >= 0)
        source_warn(q->messages, at,
                    "\"%s\" wants a texture of type %s, but \"%.60s\" is of type %s; the default is taken", name,
                    is_float ? "float" : "spectrum", texture, is_float ? "spectrum" : "float");
    else if (id < 0)
        parse_no_such(p, at, texture, is_float ? "float texture" : "spectrum texture", "the default is taken");
    const struct param *value = id < 0 ? NULL : params_ignore(q, name);
    if (value != NULL && value->type != PARAM_TEXTURE) /* a texture wins over a value of the same name, as in pbrt */
        source_warn(&p->messages, value->position, "\"%s\" is given as a texture and as a value; the texture counts",
                    name);
    return id;
}

/* Refuse a texture that is the same everywhere and outside the row's range. */
static void check_range(struct parser *p, const struct parameter *row, int texture)
{
    const struct texture *t = texture < 0 ? NULL : &p->scene->textures.texture[texture];
    if (t == NULL || t->kind != TEXTURE_CONSTANT)
        return;
    const double value[3] = {t->constant.r, t->constant.g, t->constant.b};
    for (int i = 0; i < 3 && !p->params.failed; i++)
        if (!(value[i] >= row->low && value[i] <= row->high)) {
            const struct param *item = params_ignore(&p->params, row->name);
            params_fail(&p->params, item != NULL ? item->position : p->params.position,
                        "\"%s\" is %g; it must be from %g to %g", row->name, value[i], row->low, row->high);
        }
}

void parse_float_texture(struct parser *p, const struct parameter *row, void *field)
{
    int *texture = field, id = parse_named_texture(p, row->name, true);
    p->params.excess = true;
    double value = id < 0 ? params_number(&p->params, row->name, row->fallback.r, ANY_NUMBER) : 0;
    p->params.excess = false;
    if (id < 0)
        id = isnan(value) ? *texture : parse_constant(p, rgb_grey(value));
    *texture = id;
    check_range(p, row, id);
}

void parse_rgb_texture(struct parser *p, const struct parameter *row, void *field)
{
    int id = parse_named_texture(p, row->name, false);
    p->params.excess = true;
    if (id < 0)
        id = parse_constant(p, params_rgb(&p->params, row->name, row->fallback));
    p->params.excess = false;
    *(int *)field = id;
    check_range(p, row, id);
}
