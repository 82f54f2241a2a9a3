/* parse_texture.c: named textures. Defaults are pbrt-v3's [pbrt-v3 textures/, core/paramset.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "material/noise.h"

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

/* The current transform, kept for textures that look through it. */
static int space(struct parser *p)
{
    if (!parse_placed(p))
        p->params.failed = true;
    return texture_add_space(&p->scene->textures, p->place.ctm);
}

/* Each kind reads what it has a use for. */
static void mapping(struct parser *p, const struct parameter *row, void *field)
{
    static const char *const KINDS[] = {"uv", "spherical", "cylindrical", "planar", NULL}; /* as in enum mapping_kind */
    struct params *q = &p->params;
    struct mapping *m = field;
    m->kind = (enum mapping_kind)params_choice(q, "mapping", KINDS);
    (void)row;
    if (m->kind == MAPPING_UV) {
        m->su = params_number(q, "uscale", 1, ANY_NUMBER);
        m->sv = params_number(q, "vscale", 1, ANY_NUMBER);
    }
    if (m->kind == MAPPING_PLANAR) {
        m->v1 = params_vec3(q, "v1", PARAM_VECTOR, vec(1, 0, 0));
        m->v2 = params_vec3(q, "v2", PARAM_VECTOR, vec(0, 1, 0));
    }
    if (m->kind == MAPPING_UV || m->kind == MAPPING_PLANAR) {
        m->du = params_number(q, "udelta", 0, ANY_NUMBER);
        m->dv = params_number(q, "vdelta", 0, ANY_NUMBER);
    } else {
        m->space = space(p);
    }
}

/* Squares, on a surface, or cubes, in space, which no mapping acts on. */
static void checkerboard(struct parser *p, void *object)
{
    struct texture *t = object;
    if (params_int(&p->params, "dimension", 2, 2, 3) == 2) {
        mapping(p, NULL, &t->map);
    } else {
        t->kind = TEXTURE_CUBES;
        t->space = space(p);
    }
}

static void noise_texture(struct parser *p, void *object) { ((struct texture *)object)->space = space(p); }

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
    t->gamma = params_bool(q, "gamma", file_has_extension(path, ".tga") || file_has_extension(path, ".png"));
    if (!q->failed) {
        struct error inner;
        int known = set->n_images;
        t->image = texture_load_image(set, path, &inner);
        parse_picture(q, at, t->image < 0 ? NULL : &set->image[t->image], t->image == known, 0, &inner);
    }
    free(path);
}

#define OF_MAPPING \
    BY_BUILD("uscale"), BY_BUILD("vscale"), BY_BUILD("udelta"), BY_BUILD("vdelta"), BY_BUILD("v1"), BY_BUILD("v2")
#define FIELD(f) offsetof(struct texture, f)
#define NUMBER(name, f, x) {name, parse_number, FIELD(f), GREY(x), ANY_NUMBER}
#define MAPPING {"mapping", mapping, FIELD(map), GREY(0), 0, 0}, OF_MAPPING
#define OPERAND(name, f, x) {name, operand, FIELD(f), GREY(x), ANY_NUMBER}
#define OPERANDS(first, second) OPERAND("tex1", tex1, first), OPERAND("tex2", tex2, second)
#define VALUE(name, f, x) {name, value, FIELD(f), GREY(x), 0, 0}

static const struct parameter CONSTANT[] = {VALUE("value", constant, 1), END_OF_PARAMETERS};
static const struct parameter SCALE[] = {OPERANDS(1, 1), END_OF_PARAMETERS};
static const struct parameter MIX[] = {
    OPERANDS(0, 1),
    {"amount", parse_float_texture, FIELD(amount), GREY(0.5), ANY_NUMBER},
    END_OF_PARAMETERS};
static const struct parameter CHECKERBOARD[] = {
    OPERANDS(1, 0), BY_BUILD("dimension"), BY_BUILD("mapping"), OF_MAPPING,
    IGNORED("aamode"), /* pixel samples do the filtering */
    END_OF_PARAMETERS};
static const struct parameter IMAGEMAP[] = {
    MAPPING,
    NUMBER("scale", scale, 1),
    {"wrap", wrap, FIELD(wrap), GREY(0), 0, 0},
    IGNORED("trilinear"), /* choices of pbrt's texture filter; here pixel samples filter */
    IGNORED("maxanisotropy"),
    BY_BUILD("filename"),
    BY_BUILD("gamma"),
    END_OF_PARAMETERS};
static const struct parameter BILERP[] = {
    MAPPING, VALUE("v00", v00, 0), VALUE("v01", v01, 1),
    VALUE("v10", v10, 0), VALUE("v11", v11, 1), END_OF_PARAMETERS};

static const struct parameter UV[] = {MAPPING, END_OF_PARAMETERS};
/* pbrt-v3 paints the dots with "outside" and what is around them with "inside". */
static const struct parameter DOTS[] = {
    MAPPING, OPERAND("inside", tex2, 1), OPERAND("outside", tex1, 0), END_OF_PARAMETERS};

#define OCTAVES {"octaves", parse_integer, FIELD(octaves), GREY(8), 0, NOISE_MAX_OCTAVES}
static const struct parameter OCTAVES_OF_NOISE[] = {OCTAVES, NUMBER("roughness", omega, 0.5), END_OF_PARAMETERS};
static const struct parameter WINDY[] = {END_OF_PARAMETERS};
static const struct parameter MARBLE[] = {
    OCTAVES, NUMBER("roughness", omega, 0.5), NUMBER("scale", scale, 1),
    NUMBER("variation", variation, 0.2), END_OF_PARAMETERS};

const struct object_type TEXTURE_TYPES[] = {
    {"constant", CONSTANT, TEXTURE_CONSTANT, NULL},
    {"scale", SCALE, TEXTURE_SCALE, NULL},
    {"mix", MIX, TEXTURE_MIX, NULL},
    {"checkerboard", CHECKERBOARD, TEXTURE_CHECKERBOARD, checkerboard},
    {"imagemap", IMAGEMAP, TEXTURE_IMAGEMAP, imagemap},
    {"bilerp", BILERP, TEXTURE_BILERP, NULL},
    {"uv", UV, TEXTURE_UV, NULL},
    {"dots", DOTS, TEXTURE_DOTS, NULL},
    {"fbm", OCTAVES_OF_NOISE, TEXTURE_FBM, noise_texture},
    {"wrinkled", OCTAVES_OF_NOISE, TEXTURE_WRINKLED, noise_texture},
    {"windy", WINDY, TEXTURE_WINDY, noise_texture},
    {"marble", MARBLE, TEXTURE_MARBLE, noise_texture},
    END_OF_TYPES};

/* The texture of params.type, or -1. */
static int make(struct parser *p)
{
    struct params *q = &p->params;
    if (!parse_type(p, TEXTURE_TYPES))
        return -1;
    struct texture t = {.kind = (enum texture_kind)p->type->kind};
    if (p->texture_is_float && (t.kind == TEXTURE_UV || t.kind == TEXTURE_MARBLE))
        type_error(q, "the texture \"%s\" is a colour; its type is \"spectrum\"", q->type);
    if (!parse_object(p, &t))
        return -1;
    int id = texture_add(&p->scene->textures, t);
    if (p->scene->textures.texture[id].cost <= TEXTURE_MAX_COST)
        return id;
    type_error(q, "this texture is built from more than %d others; use fewer, or fewer octaves", TEXTURE_MAX_COST);
    return -1;
}

/* Texture "name" "float or spectrum or color" "class". */
static bool texture(struct parser *p)
{
    struct token name, type, class;
    if (!parse_string(p, &name, "a name") || !parse_string(p, &type, "float or spectrum") ||
        !parse_string(p, &class, "a kind of texture") || !parse_list(p, "Texture", &class))
        return false;
    p->texture_is_float = strcmp(type.text, "float") == 0;
    if (!p->texture_is_float && strcmp(type.text, "spectrum") != 0 && strcmp(type.text, "color") != 0)
        return source_error(&p->messages, type.position, "unknown texture type \"%.40s\"; use \"float\" or "
                            "\"spectrum\"", type.text);
    int id = make(p);
    symbols_add(p->texture_is_float ? &p->float_textures : &p->spectrum_textures, name.text,
                id >= 0 ? id : parse_constant(p, rgb_black()));
    return id >= 0;
}

const struct directive TEXTURE_DIRECTIVES[] = {{"Texture", IN_WORLD, texture, NULL}, END_OF_DIRECTIVES};
