/* parse.c: what directives have in common: reading their arguments, choosing the type of an object by its name, and
 * reading its parameters by a table. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
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

bool parse_newer(struct parser *p, struct source_position at, const char *name)
{
    static const char *const NEWER[] = {
        "Option", "Attribute", "ColorSpace", /* directives; then types of films, cameras, samplers, shapes, materials */
        "rgb", "gbuffer", "spectral", "spherical", "zsobol", "independent", "paddedsobol", "pmj02bn", "bilinearmesh",
        "diffuse", "coateddiffuse", "diffusetransmission", "conductor", "coatedconductor", "dielectric",
        "thindielectric", "interface"};
    for (size_t i = 0; i < sizeof NEWER / sizeof NEWER[0]; i++)
        if (strcmp(NEWER[i], name) == 0) {
            source_error(&p->messages, at, "\"%s\" is of pbrt-v4, whose files are not read; take the version of this "
                         "scene that was made for pbrt-v3", name);
            p->phase = GIVEN_UP;
            return true;
        }
    return false;
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

bool parse_type(struct parser *p, const struct object_type *types)
{
    struct params *q = &p->params;
    char known[256] = "";
    for (p->type = types; p->type->name != NULL; p->type++) {
        if (strcmp(p->type->name, q->type) == 0)
            return true;
        strncat(known, known[0] != '\0' ? ", " : "", sizeof known - strlen(known) - 1);
        strncat(known, p->type->name, sizeof known - strlen(known) - 1);
    }
    if (parse_newer(p, q->position, q->type))
        return false;
    return type_error(q, "%s \"%.40s\" is not supported; use one of %s", q->directive, q->type, known);
}

void parse_fields(struct parser *p, void *object)
{
    for (const struct parameter *row = p->type->parameter; row->name != NULL; row++)
        if (row->read != NULL)
            row->read(p, row, (char *)object + row->field);
    if (p->type->build != NULL)
        p->type->build(p, object);
}

/* A parameter nobody asked for: is its name known, or is another near? */
static void warn_of_unused(struct parser *p, const struct param *item)
{
    struct suggestion near = suggest_start(item->name);
    char hint[128] = "";
    for (const struct parameter *row = p->type->parameter; row->name != NULL; row++)
        suggest_offer(&near, row->name);
    if (near.name != NULL && strcmp(near.name, item->name) == 0)
        strcpy(hint, "; that has another type, or no meaning here");
    else if (near.name != NULL)
        snprintf(hint, sizeof hint, "; did you mean \"%s\"?", near.name);
    source_warn(&p->messages, item->position, "parameter \"%s %.40s\" of %s \"%s\" is not used%s",
                params_type_name(item->type), item->name, p->params.directive, p->params.type, hint);
}

bool parse_done(struct parser *p)
{
    for (const struct param *item = p->params.item; item < p->params.item + p->params.n && !p->params.failed; item++)
        if (!item->used)
            warn_of_unused(p, item);
    return !p->params.failed;
}

bool parse_object(struct parser *p, void *object)
{
    parse_fields(p, object);
    return parse_done(p);
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
    params_ignore(&p->params, row->name);
    (void)field;
}

/* --- textures and pictures ----------------------------------------------------------------------------- */

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
    struct source_position at;
    const char *texture = params_text(q, name, PARAM_TEXTURE, &at);
    if (texture == NULL)
        return -1;
    int id = symbols_find(table, texture);
    if (id < 0)
        parse_no_such(p, at, texture, is_float ? "float texture" : "spectrum texture", "the default is taken");
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
    double value = id < 0 ? params_number(&p->params, row->name, row->fallback.r, ANY_NUMBER) : 0;
    if (id < 0)
        id = isnan(value) ? *texture : parse_constant(p, rgb_grey(value));
    *texture = id;
    check_range(p, row, id);
}

void parse_rgb_texture(struct parser *p, const struct parameter *row, void *field)
{
    int id = parse_named_texture(p, row->name, false);
    if (id < 0)
        id = parse_constant(p, params_rgb(&p->params, row->name, row->fallback));
    *(int *)field = id;
    check_range(p, row, id);
}

bool parse_picture(struct params *q, struct source_position at, const struct image *image, bool is_new, uint64_t tables,
                   struct error *why)
{
    if (image == NULL || (is_new && !scene_files_picture(q->files, image, tables, why)))
        return params_fail(q, at, "%s", why->text);
    if (image->replaced > 0)
        source_warn(q->messages, at, "%ld numbers of this picture are not finite, or negative light; 0 instead",
                    image->replaced);
    return true;
}
