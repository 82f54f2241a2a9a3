/* parse_texture.c: named textures. Defaults are pbrt-v3's [pbrt-v3 textures/, core/paramset.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "material/noise.h"

/* The current transform, kept for textures that look through it. */
static int space(struct parser *p)
{
    if (!parse_placed(p))
        p->params.failed = true;
    return texture_add_space(&p->scene->textures, p->place.ctm);
}

/* Each kind reads what it has a use for. */
static void mapping(struct parser *p, struct mapping *m)
{
    static const char *const KINDS[] = {"uv", "spherical", "cylindrical", "planar", NULL}; /* as in enum mapping_kind */
    struct params *q = &p->params;
    m->kind = (enum mapping_kind)params_choice(q, "mapping", KINDS);
    if (m->kind == MAPPING_UV) {
        m->su = params_number(q, "uscale", 1, -NUMBER_MAX, NUMBER_MAX);
        m->sv = params_number(q, "vscale", 1, -NUMBER_MAX, NUMBER_MAX);
    }
    if (m->kind == MAPPING_PLANAR) {
        m->v1 = params_vec3(q, "v1", PARAM_VECTOR, vec(1, 0, 0));
        m->v2 = params_vec3(q, "v2", PARAM_VECTOR, vec(0, 1, 0));
    }
    if (m->kind == MAPPING_UV || m->kind == MAPPING_PLANAR) {
        m->du = params_number(q, "udelta", 0, -NUMBER_MAX, NUMBER_MAX);
        m->dv = params_number(q, "vdelta", 0, -NUMBER_MAX, NUMBER_MAX);
    } else {
        m->space = space(p);
    }
}

static void mapped(struct parser *p, void *object) { mapping(p, &((struct texture *)object)->map); }

/* Squares, on a surface, or cubes, in space, which no mapping acts on. */
static void checkerboard(struct parser *p, void *object)
{
    struct texture *t = object;
    if (params_int(&p->params, "dimension", 2, 2, 3) == 2) {
        mapping(p, &t->map);
    } else {
        t->kind = TEXTURE_CUBES;
        t->space = space(p);
    }
}

static void noise_texture(struct parser *p, void *object) { ((struct texture *)object)->space = space(p); }

/* A file that is not there is grey, as in pbrt-v3. */
static int read_image(struct parser *p, const char *path, struct source_position at, struct error *err)
{
    struct texture_set *set = &p->scene->textures;
    bool encoded = file_has_extension(path, ".png") || file_has_extension(path, ".tga");
    if (!file_exists(path)) {
        source_warn(&p->messages, at, "there is no file %s; as in pbrt-v3, a grey image of 0.5 takes its place", path);
        return texture_add_grey(set, !encoded);
    }
    int id = texture_load_image(set, path, p->named.memory, err);
    return id >= 0 && parse_picture(p, at, &set->image[id], 0, err) ? id : -1;
}

static void imagemap(struct parser *p, void *object)
{
    static const char *const WRAPS[] = {"repeat", "black", "clamp", NULL}; /* as in enum texture_wrap */
    struct params *q = &p->params;
    struct texture *t = object;
    mapping(p, &t->map);
    t->wrap = (enum texture_wrap)params_choice(q, "wrap", WRAPS);
    t->image = parse_file(p, "filename", &p->images, read_image);
    if (t->image < 0)
        type_error(q, "an imagemap needs its image: add \"string filename\" \"...\"");
    t->gamma = params_bool(q, "gamma", t->image >= 0 && !p->scene->textures.image[t->image].linear);
}

#define MAPPING {.name = "mapping"}, {.name = "uscale"}, {.name = "vscale"}, {.name = "udelta"}, {.name = "vdelta"}, \
    {.name = "v1"}, {.name = "v2"}
#define AT(member) offsetof(struct texture, member)
static const struct field CONSTANT[] = {{"value", FIELD_VALUE, AT(constant), .fallback = 1}, {.name = NULL}};
static const struct field SCALE[] = {
    {"tex1", FIELD_OPERAND, AT(tex1), .fallback = 1},
    {"tex2", FIELD_OPERAND, AT(tex2), .fallback = 1}, {.name = NULL}};
static const struct field MIX[] = {
    {"tex1", FIELD_OPERAND, AT(tex1), .fallback = 0},
    {"tex2", FIELD_OPERAND, AT(tex2), .fallback = 1},
    {"amount", FIELD_FLOAT_TEXTURE, AT(amount), .fallback = 0.5}, {.name = NULL}};
static const struct field CHECKERBOARD[] = {
    {"tex1", FIELD_OPERAND, AT(tex1), .fallback = 1},
    {"tex2", FIELD_OPERAND, AT(tex2), .fallback = 0},
    {.name = "dimension"}, MAPPING,
    {"aamode", .kind = FIELD_IGNORED}, /* pixel samples do the filtering */
    {.name = NULL}};
static const struct field IMAGEMAP[] = {
    MAPPING,
    {"scale", FIELD_NUMBER, AT(scale), .fallback = 1}, {.name = "wrap"}, {.name = "filename"}, {.name = "gamma"},
    {"trilinear", .kind = FIELD_IGNORED}, /* choices of pbrt's texture filter; here pixel samples filter */
    {"maxanisotropy", .kind = FIELD_IGNORED}, {.name = NULL}};
static const struct field BILERP[] = {
    MAPPING,
    {"v00", FIELD_VALUE, AT(v00), .fallback = 0},
    {"v01", FIELD_VALUE, AT(v01), .fallback = 1},
    {"v10", FIELD_VALUE, AT(v10), .fallback = 0},
    {"v11", FIELD_VALUE, AT(v11), .fallback = 1}, {.name = NULL}};
static const struct field UV[] = {MAPPING, {.name = NULL}};
/* pbrt-v3 paints the dots with "outside" and what is around them with "inside". */
static const struct field DOTS[] = {
    MAPPING,
    {"inside", FIELD_OPERAND, AT(tex2), .fallback = 1},
    {"outside", FIELD_OPERAND, AT(tex1), .fallback = 0}, {.name = NULL}};
#define OCTAVES                                                                                                        \
    {"octaves", FIELD_INTEGER, AT(octaves), 8, 0, .high = NOISE_MAX_OCTAVES},                                          \
    {"roughness", FIELD_NUMBER, AT(omega), .fallback = 0.5}
static const struct field FBM[] = {OCTAVES, {.name = NULL}};
static const struct field WINDY[] = {{.name = NULL}};
static const struct field MARBLE[] = {
    OCTAVES,
    {"scale", FIELD_NUMBER, AT(scale), .fallback = 1},
    {"variation", FIELD_NUMBER, AT(variation), .fallback = 0.2}, {.name = NULL}};

const struct object_type TEXTURE_TYPES[] = {
    {"constant", CONSTANT, TEXTURE_CONSTANT, NULL},
    {"scale", SCALE, TEXTURE_SCALE, NULL},
    {"mix", MIX, TEXTURE_MIX, NULL},
    {"checkerboard", CHECKERBOARD, TEXTURE_CHECKERBOARD, checkerboard},
    {"imagemap", IMAGEMAP, TEXTURE_IMAGEMAP, imagemap},
    {"bilerp", BILERP, TEXTURE_BILERP, mapped},
    {"uv", UV, TEXTURE_UV, mapped},
    {"dots", DOTS, TEXTURE_DOTS, mapped},
    {"fbm", FBM, TEXTURE_FBM, noise_texture},
    {"wrinkled", FBM, TEXTURE_WRINKLED, noise_texture},
    {"windy", WINDY, TEXTURE_WINDY, noise_texture},
    {"marble", MARBLE, TEXTURE_MARBLE, noise_texture}, {.name = NULL}};

/* The texture of params.type, or -1. */
static int make(struct parser *p)
{
    struct params *q = &p->params;
    if (!parse_type(p, TEXTURE_TYPES))
        return -1;
    struct texture t = {.kind = (enum texture_kind)p->type.kind};
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
                            "\"spectrum\"%s", type.text, near_of(type.text, (const char *const[])
                            {"float", "spectrum", "color", NULL}).text);
    struct symbols *known = p->texture_is_float ? &p->float_textures : &p->spectrum_textures;
    if (symbols_find(known, name.text) >= 0)
        source_warn(&p->messages, name.position, "the texture \"%.60s\" is defined again", name.text);
    int id = make(p);
    symbols_add(known, name.text, id >= 0 ? id : parse_constant(p, rgb_black()));
    return id >= 0;
}

const struct directive TEXTURE_DIRECTIVES[] = {{"Texture", IN_WORLD, texture, NULL}, {.name = NULL}};
