/* parse_texture.c: named textures. Defaults are pbrt-v3's [pbrt-v3 textures/, core/paramset.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* A value or a texture of the type being defined. */
static void operand(struct parser *p, const struct parameter *row, void *field)
{
    if (p->texture_is_float)
        parse_float_texture(p, row, field);
    else
        parse_rgb_texture(p, row, field);
}

/* A value of the type being defined. */
static void value(struct parser *p, const struct parameter *row, void *field)
{
    *(rgb *)field = p->texture_is_float
                        ? rgb_grey(params_number(&p->params, row->name, row->fallback.r, ANY_NUMBER))
                        : params_rgb(&p->params, row->name, row->fallback);
}

static void mapping(struct parser *p, const struct parameter *row, void *field)
{
    struct source_position at;
    const char *kind = params_text(&p->params, row->name, PARAM_STRING, &at);
    (void)field;
    if (kind != NULL && strcmp(kind, "uv") != 0)
        params_fail(&p->params, at, "texture mapping \"%.40s\" is not supported; use \"uv\"", kind);
}

/* Two: solid ones are not supported. */
static void dimension(struct parser *p, const struct parameter *row, void *field)
{
    (void)field;
    params_int(&p->params, row->name, 2, 2, 2);
}

static void wrap(struct parser *p, const struct parameter *row, void *field)
{
    static const char *const WRAPS[] = {"repeat", "black", "clamp", NULL}; /* as in enum texture_wrap */
    *(enum texture_wrap *)field = (enum texture_wrap)params_choice(&p->params, row->name, WRAPS);
}

static void imagemap(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct texture *t = object;
    struct texture_set *set = &p->scene->textures;
    struct source_position at = q->position;
    char *path = params_file(q, "filename", &at);
    if (path == NULL) {
        type_error(q, "an imagemap needs its picture: add \"string filename\" \"...\"");
        return;
    }
    t->u.imagemap.gamma = params_bool(q, "gamma", path_ends_in(path, ".tga") || path_ends_in(path, ".png"));
    struct error inner;
    int image = 0;
    if (!q->failed && (image = texture_load_image(set, path, &inner)) < 0)
        params_fail(q, at, "%s", inner.text);
    else if (!q->failed && set->image[image].replaced > 0)
        source_warn(&p->messages, at, set->image_path[image], "%ld numbers of this picture are not finite; 0 instead",
                    set->image[image].replaced);
    t->u.imagemap.image = image;
    free(path);
}

#define FIELD(f) offsetof(struct texture, u.f)
#define NUMBER(name, f, x) {name, parse_number, FIELD(f), GREY(x), ANY_NUMBER, NULL}
#define MAPPING(kind) \
    {"mapping", mapping, 0, GREY(0), 0, 0, NULL}, NUMBER("uscale", kind.map.su, 1), NUMBER("vscale", kind.map.sv, 1), \
    NUMBER("udelta", kind.map.du, 0), NUMBER("vdelta", kind.map.dv, 0)
#define OPERANDS(kind, first, second) \
    {"tex1", operand, FIELD(kind.tex1), GREY(first), 0, 0, NULL}, \
    {"tex2", operand, FIELD(kind.tex2), GREY(second), 0, 0, NULL}
#define VALUE(name, f, x) {name, value, FIELD(f), GREY(x), 0, 0, NULL}

static const struct parameter CONSTANT[] = {VALUE("value", constant, 1), END_OF_PARAMETERS};
static const struct parameter SCALE[] = {OPERANDS(pair, 1, 1), END_OF_PARAMETERS};
static const struct parameter MIX[] = {
    OPERANDS(pair, 0, 1),
    {"amount", parse_float_texture, FIELD(pair.amount), GREY(0.5), 0, 0, NULL},
    END_OF_PARAMETERS};
static const struct parameter CHECKERBOARD[] = {
    {"dimension", dimension, 0, GREY(2), 2, 2, NULL},
    OPERANDS(checker, 1, 0),
    MAPPING(checker),
    IGNORED("aamode"), /* pixel samples do the filtering */
    END_OF_PARAMETERS};
static const struct parameter IMAGEMAP[] = {
    MAPPING(imagemap),
    NUMBER("scale", imagemap.scale, 1),
    {"wrap", wrap, FIELD(imagemap.wrap), GREY(0), 0, 0, NULL},
    IGNORED("trilinear"), /* choices of pbrt's texture filter; here pixel samples filter */
    IGNORED("maxanisotropy"),
    BY_BUILD("filename"),
    BY_BUILD("gamma"),
    END_OF_PARAMETERS};
static const struct parameter BILERP[] = {
    MAPPING(bilerp), VALUE("v00", bilerp.v00, 0), VALUE("v01", bilerp.v01, 1),
    VALUE("v10", bilerp.v10, 0), VALUE("v11", bilerp.v11, 1), END_OF_PARAMETERS};

static const struct object_type TYPES[] = {
    {"constant", CONSTANT, TEXTURE_CONSTANT, NULL},
    {"scale", SCALE, TEXTURE_SCALE, NULL},
    {"mix", MIX, TEXTURE_MIX, NULL},
    {"checkerboard", CHECKERBOARD, TEXTURE_CHECKERBOARD, NULL},
    {"imagemap", IMAGEMAP, TEXTURE_IMAGEMAP, imagemap},
    {"bilerp", BILERP, TEXTURE_BILERP, NULL},
    REFUSED("uv"), REFUSED("dots"), REFUSED("fbm"), REFUSED("wrinkled"), REFUSED("marble"), REFUSED("windy"),
    REFUSED("ptex"), OTHERS_LEFT_OUT};

/* Texture "name" "float or spectrum or color" "class". */
static bool texture(struct parser *p)
{
    struct token name, type, class;
    if (!parse_string(p, &name, "a name") || !parse_string(p, &type, "float or spectrum") ||
        !parse_string(p, &class, "a kind of texture") || !parse_list(p, "Texture", &class))
        return false;
    p->texture_is_float = strcmp(type.text, "float") == 0;
    if (!p->texture_is_float && strcmp(type.text, "spectrum") != 0 && strcmp(type.text, "color") != 0) {
        source_warn(&p->messages, type.position, NULL, "unknown texture type \"%.40s\"; use \"float\" or \"spectrum\"",
                    type.text);
        return false;
    }
    struct texture t = {.kind = TEXTURE_CONSTANT};
    bool known = parse_type(p, TYPES);
    if (known)
        t.kind = (enum texture_kind)p->type->kind;
    else if (!p->params.failed)
        return false; /* left out */
    bool ok = known && parse_object(p, &t);
    int id = ok ? texture_add(&p->scene->textures, t) : parse_constant(p, rgb_black());
    symbols_add(p->texture_is_float ? &p->float_textures : &p->spectrum_textures, name.text, id);
    if (p->scene->textures.texture[id].cost > TEXTURE_MAX_COST)
        return source_error(&p->messages, p->params.position,
                            "this texture is built from more than %d others; use fewer", TEXTURE_MAX_COST);
    return ok;
}

const struct directive TEXTURE_DIRECTIVES[] = {{"Texture", IN_WORLD, texture, NULL}, END_OF_DIRECTIVES};
