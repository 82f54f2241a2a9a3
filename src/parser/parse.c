/* parse.c: what directives have in common: reading their arguments, choosing the type of an object by its name, and
 * reading its parameters by a table. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- names that are none ------------------------------------------------------------------------------ */

struct near parse_near(struct parser *p, const char *name)
{
    return near_start(p->n_sought++ < MOST_SOUGHT ? name : "");
}

struct near parse_near_symbol(struct parser *p, const char *name, const struct symbols *table)
{
    struct near near = parse_near(p, name);
    for (int i = table->n - 1; i >= 0 && i >= table->n - MOST_COMPARED; i--)
        near_try(&near, table->entry[i].name);
    return near;
}

/* --- arguments of directives -------------------------------------------------------------------------- */

bool parse_string(struct parser *p, struct token *out, const char *what)
{
    char found[64];
    if (!lexer_next(&p->lexer, out))
        return false;
    if (out->kind == TOKEN_STRING)
        return true;
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

int parse_named(struct parser *p, struct token *name, const struct symbols *table, const char *what,
                const char *instead)
{
    if (!parse_string(p, name, "a name"))
        return -1;
    int i = symbols_find(table, name->text);
    if (i < 0)
        source_warn(&p->messages, name->position, "there is no %s \"%.60s\"; %s%s", what, name->text, instead,
                    parse_near_symbol(p, name->text, table).text);
    return i;
}

/* --- objects by tables ---------------------------------------------------------------------------------- */

bool parse_type(struct parser *p, const struct object_type *types)
{
    struct params *q = &p->params;
    char known[256] = "";
    struct near near = near_start(q->type);
    for (; types->name != NULL; types++) {
        p->type = *types;
        if (strcmp(types->name, q->type) == 0)
            return true;
        near_try(&near, types->name);
        strncat(known, known[0] != '\0' ? ", " : "", sizeof known - strlen(known) - 1);
        strncat(known, types->name, sizeof known - strlen(known) - 1);
    }
    struct foreign foreign = parse_foreign_type(q->directive, q->type);
    if (foreign.text[0] != '\0')
        return type_error(q, "%s \"%.40s\" is not supported%s", q->directive, q->type, foreign.text);
    return type_error(q, "%s \"%.40s\" is not supported; use one of %s%s", q->directive, q->type, known, near.text);
}

/* Why a parameter was not used: of a name that is known its type, of others what was probably meant. */
static void explain(struct parser *p, const struct param *item, char *why, size_t size)
{
    struct foreign foreign = parse_foreign_parameter(p->params.directive, item->name, p->type.fields);
    char types[64];
    if (item->asked == 1u << PARAM_TEXTURE) { /* without one, other types are asked for */
        snprintf(why, size, ": its texture counts");
    } else if (item->asked != 0) {
        params_name_types(item->asked, types, sizeof types);
        snprintf(why, size, ": \"%.40s\" is %s", item->name, types);
    } else if (field_find(p->type.fields, item->name) != NULL) {
        snprintf(why, size, ": it has no meaning here");
    } else if (foreign.text[0] != '\0') {
        snprintf(why, size, "%s", foreign.text);
    } else {
        struct near near = parse_near(p, item->name);
        for (const struct field *f = p->type.fields; f->name != NULL; f++)
            near_try(&near, f->name);
        snprintf(why, size, "%s", near.text);
    }
}

static void warn_of_unused(struct parser *p, const struct param *item)
{
    char why[sizeof(struct foreign)];
    explain(p, item, why, sizeof why);
    source_warn(&p->messages, item->position, "parameter \"%s %.40s\" of %s \"%s\" is not used%s",
                params_type_name(item->type), item->name, p->params.directive, p->params.type, why);
}

bool parse_done(struct parser *p)
{
    for (const struct param *item = p->params.item; item < p->params.item + p->params.n && !p->params.failed; item++)
        if (!item->used)
            warn_of_unused(p, item);
    return !p->params.failed;
}

/* --- textures and files -------------------------------------------------------------------------------- */

int parse_constant(struct parser *p, rgb value) { return texture_add_constant(&p->scene->textures, value); }

int parse_named_texture(struct parser *p, const char *name, bool is_float, bool *unknown)
{
    struct params *q = &p->params;
    const struct symbols *table = is_float ? &p->float_textures : &p->spectrum_textures;
    struct source_position at;
    const char *texture = params_text(q, name, PARAM_TEXTURE, &at);
    int id = texture != NULL ? symbols_find(table, texture) : -1;
    *unknown = texture != NULL && id < 0;
    if (*unknown)
        source_warn(&p->messages, at, "there is no %s texture \"%.60s\"; the default is taken%s",
                    is_float ? "float" : "spectrum", texture, parse_near_symbol(p, texture, table).text);
    return id;
}

int parse_file(struct parser *p, const char *name, struct symbols *known, file_reader *read)
{
    struct params *q = &p->params;
    struct source_position at;
    struct error why;
    char *path = params_file(q, name, &at);
    bool wanted = path != NULL && !q->failed;
    int id = wanted ? symbols_find(known, path) : -1;
    if (wanted && id < 0) {
        id = read(p, path, at, &why);
        if (id >= 0)
            symbols_add(known, path, id);
        else
            params_fail(q, at, "%s", why.text);
    }
    free(path);
    return id;
}

bool parse_picture(struct parser *p, struct source_position at, const struct image *image, size_t tables,
                   struct error *err)
{
    if (image->replaced > 0)
        source_warn(&p->messages, at, "%ld numbers of this image are not finite, or negative light; 0 instead",
                    image->replaced);
    return scene_files_count(&p->named, image->content, (double)(image_bytes(image) + tables), err);
}

/* --- one parameter ------------------------------------------------------------------------------------ */

static double least(const struct field *f) { return f->low == 0 && f->high == 0 ? -NUMBER_MAX : f->low; }
static double most(const struct field *f) { return f->low == 0 && f->high == 0 ? NUMBER_MAX : f->high; }

/* The share of light that a surface scatters. */
static bool is_reflectance(const char *name)
{
    static const char *const NAMES[] = {"Kd", "Ks", "Kr", "Kt", "reflect", "transmit", "color"};
    size_t i = 0;
    while (i < sizeof NAMES / sizeof NAMES[0] && strcmp(NAMES[i], name) != 0)
        i++;
    return i < sizeof NAMES / sizeof NAMES[0];
}

/* Where more is scattered than arrives. A spectrum of 1 has a luminance of 1, to 1 % (spectrum.h), and more red than 1,
 * for the white of sRGB is bluer. */
static void warn_of_surplus(struct parser *p, const struct field *f, rgb value)
{
    const struct param *item = params_ignore(&p->params, f->name);
    bool spectral = item != NULL && item->type != PARAM_RGB && item->type != PARAM_TEXTURE;
    if ((spectral ? rgb_luminance(value) : rgb_max(value)) > 1.01)
        source_warn(&p->messages, item != NULL ? item->position : p->params.position, "\"%s\" is (%g %g %g): above 1 a "
                    "surface scatters more light than reaches it", f->name, value.r, value.g, value.b);
}

/* Refuse a texture that is the same everywhere and outside the field's range; warn of one that makes light. */
static int checked(struct parser *p, const struct field *f, int texture)
{
    const struct texture *t = texture < 0 ? NULL : &p->scene->textures.texture[texture];
    if (t == NULL || t->kind != TEXTURE_CONSTANT)
        return texture;
    const double value[3] = {t->constant.r, t->constant.g, t->constant.b};
    for (int i = 0; i < 3 && !p->params.failed; i++)
        if (!(value[i] >= least(f) && value[i] <= most(f))) {
            const struct param *item = params_ignore(&p->params, f->name);
            params_fail(&p->params, item != NULL ? item->position : p->params.position,
                        "\"%s\" is %g; it must be from %g to %g", f->name, value[i], least(f), most(f));
        }
    if (!p->params.failed && is_reflectance(f->name) && rgb_max(t->constant) > 1)
        warn_of_surplus(p, f, t->constant);
    return texture;
}

static int float_texture(struct parser *p, const struct field *f, int kept)
{
    bool unknown;
    int id = parse_named_texture(p, f->name, true, &unknown);
    double value = f->fallback;
    if (id < 0 && !unknown)
        value = params_number(&p->params, f->name, value, -NUMBER_MAX, NUMBER_MAX);
    if (id < 0)
        id = isnan(value) ? kept : parse_constant(p, rgb_grey(value));
    return checked(p, f, id);
}

static int rgb_texture(struct parser *p, const struct field *f, int kept)
{
    bool unknown;
    int id = parse_named_texture(p, f->name, false, &unknown);
    rgb value = rgb_grey(f->fallback);
    if (id < 0 && !unknown)
        value = params_rgb(&p->params, f->name, value);
    if (id < 0)
        id = isnan(value.r) ? kept : parse_constant(p, value);
    return checked(p, f, id);
}

/* A path that lives as long as the parser. */
static const char *path_of(struct parser *p, const char *name)
{
    struct source_position at;
    char *path = params_file(&p->params, name, &at);
    const char *kept = path == NULL ? NULL : arena_text(&p->arena, path);
    free(path);
    return kept;
}

static void read_field(struct parser *p, const struct field *f, void *place)
{
    struct params *q = &p->params;
    double *number = place;
    int *whole = place;
    vec3 *point = place;
    struct field_list *list = place;
    double x = f->fallback;
    bool is_float = p->texture_is_float;
    switch (f->kind) {
    case FIELD_INTEGER: *whole = params_int(q, f->name, isnan(x) ? *whole : (int)x, (int)f->low, (int)f->high); break;
    case FIELD_NUMBER: *number = params_number(q, f->name, isnan(x) ? *number : x, least(f), most(f)); break;
    case FIELD_WORD: *whole = params_choice(q, f->name, f->words); break;
    case FIELD_SWITCH: *(bool *)place = params_bool(q, f->name, x != 0); break;
    case FIELD_POINT: *point = params_vec3(q, f->name, PARAM_POINT, isnan(x) ? *point : vec(x, x, x)); break;
    case FIELD_FLOAT_TEXTURE: *whole = float_texture(p, f, *whole); break;
    case FIELD_RGB_TEXTURE: *whole = rgb_texture(p, f, *whole); break;
    case FIELD_OPERAND: *whole = is_float ? float_texture(p, f, *whole) : rgb_texture(p, f, *whole); break;
    case FIELD_VALUE:
        *(rgb *)place = is_float ? rgb_grey(params_number(q, f->name, x, least(f), most(f)))
                                 : params_rgb(q, f->name, rgb_grey(x));
        break;
    case FIELD_PART: *whole = parse_part(p, f->name); break;
    case FIELD_TABLE: *(const struct fourier_table **)place = parse_fourier_table(p, f->name); break;
    case FIELD_FILE: *(const char **)place = path_of(p, f->name); break;
    case FIELD_INDICES: *list = params_list(q, f->name, 1u << PARAM_INTEGER, 3); break;
    case FIELD_POINTS: *list = params_list(q, f->name, 1u << PARAM_POINT, 3); break;
    case FIELD_VECTORS: *list = params_list(q, f->name, 1u << PARAM_VECTOR, 3); break;
    case FIELD_NORMALS: *list = params_list(q, f->name, 1u << PARAM_NORMAL, 3); break;
    case FIELD_PAIRS: *list = params_list(q, f->name, 1u << PARAM_FLOAT | 1u << PARAM_POINT2, 2); break;
    case FIELD_IGNORED: params_ignore(q, f->name); break;
    case FIELD_OTHER: break;
    }
}

void parse_fields(struct parser *p, void *object)
{
    for (const struct field *f = p->type.fields; f->name != NULL; f++)
        read_field(p, f, (char *)object + f->place);
    if (p->type.build != NULL)
        p->type.build(p, object);
}

bool parse_object(struct parser *p, void *object)
{
    parse_fields(p, object);
    return parse_done(p);
}
