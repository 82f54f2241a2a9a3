/* parse_material.c: the parameters of each material, with pbrt-v3's defaults [pbrt-v3 materials/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <string.h>

static void mixed_material(struct parser *p, const struct parameter *row, void *field)
{
    struct params *q = &p->params;
    struct source_position at;
    const char *name = params_text(q, row->name, PARAM_STRING, &at);
    if (name == NULL) {
        type_error(q, "a mix needs \"string namedmaterial1\" and \"string namedmaterial2\"");
        return;
    }
    int value = symbols_find(&p->materials, name);
    if (value < 0)
        parse_no_such(p, at, name, &p->materials, "named material", "define it with MakeNamedMaterial");
    else if (value - 1 == MATERIAL_NONE)
        params_fail(q, at, "the material \"%.60s\" is \"none\"; it cannot be mixed", name);
    *(int *)field = value - 1;
}

/* Negative numbers of a colour count as 0: colours of the file that sRGB has not got have some. */
#define RGB(f, r, g, b) \
    {#f, parse_rgb_texture, offsetof(struct material, f), {r, g, b}, -MATERIAL_MAX_COLOUR, MATERIAL_MAX_COLOUR, NULL}
#define COLOUR(f, value) RGB(f, value, value, value)
#define TEXTURE(name, f, value, low, high) \
    {name, parse_float_texture, offsetof(struct material, f), GREY(value), low, high, NULL}
#define ROUGH(name, f, value) TEXTURE(name, f, value, 0, MATERIAL_MAX_ROUGHNESS)
#define REMAP {"remaproughness", parse_bool, offsetof(struct material, remap_roughness), GREY(1), 0, 0, NULL}
#define INDEX /* of refraction; "eta" wins */ \
    TEXTURE("index", index, 1.5, MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX), \
    TEXTURE("eta", index, KEPT, MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX)
#define TWO_ROUGHNESSES(value) /* glass and substrate have no "roughness" in pbrt-v3: it passes over that, so do we */ \
    ROUGH("uroughness", uroughness, value), ROUGH("vroughness", vroughness, value), REMAP, \
    {"roughness", parse_ignored, 0, GREY(0), 0, 0, \
     "pbrt-v3 does not read \"roughness\" of this material, so it is ignored; " \
     "use \"uroughness\" and \"vroughness\""}
#define BUMP TEXTURE("bumpmap", bump, KEPT, 0, 0), END_OF_PARAMETERS
#define MIXED(name, f) {name, mixed_material, offsetof(struct material, f), GREY(0), 0, 0, NULL}

static const struct parameter MATTE[] = {COLOUR(Kd, 0.5), TEXTURE("sigma", sigma, 0, 0, 0), BUMP};
static const struct parameter MIRROR[] = {COLOUR(Kr, 0.9), BUMP};
static const struct parameter GLASS[] = {COLOUR(Kr, 1), COLOUR(Kt, 1), INDEX, TWO_ROUGHNESSES(0), BUMP};
static const struct parameter METAL[] = {
    /* Complex index of copper in sRGB: pbrt-v3's default, its tabulated spectra reduced to RGB. */
    RGB(eta, 0.199990, 0.922086, 1.099876),
    RGB(k, 3.904638, 2.447633, 2.137651),
    ROUGH("roughness", uroughness, 0.01),
    ROUGH("roughness", vroughness, 0.01),
    ROUGH("uroughness", uroughness, KEPT),
    ROUGH("vroughness", vroughness, KEPT),
    REMAP,
    BUMP};
static const struct parameter PLASTIC[] = {
    COLOUR(Kd, 0.25), COLOUR(Ks, 0.25), ROUGH("roughness", uroughness, 0.1), REMAP, BUMP};
static const struct parameter SUBSTRATE[] = {
    COLOUR(Kd, 0.5), COLOUR(Ks, 0.5), TWO_ROUGHNESSES(0.1), BUMP};
static const struct parameter UBER[] = {
    COLOUR(Kd, 0.25),
    COLOUR(Ks, 0.25),
    COLOUR(Kr, 0),
    COLOUR(Kt, 0),
    INDEX,
    COLOUR(opacity, 1),
    ROUGH("roughness", uroughness, 0.1),
    ROUGH("uroughness", uroughness, KEPT),
    ROUGH("vroughness", vroughness, KEPT), /* else as "uroughness": pbrt's uber differs from its metal */
    REMAP,
    BUMP};
static const struct parameter TRANSLUCENT[] = {
    COLOUR(Kd, 0.25),       COLOUR(Ks, 0.25), COLOUR(reflect, 0.5),
    COLOUR(transmit, 0.5), ROUGH("roughness", uroughness, 0.1), REMAP, BUMP};
static const struct parameter MIX[] = {
    MIXED("namedmaterial1", mix1), MIXED("namedmaterial2", mix2), COLOUR(amount, 0.5), END_OF_PARAMETERS};

static const struct object_type TYPES[] = {
    {"matte", MATTE, MATERIAL_MATTE, NULL},
    {"mirror", MIRROR, MATERIAL_MIRROR, NULL},
    {"glass", GLASS, MATERIAL_GLASS, NULL},
    {"metal", METAL, MATERIAL_METAL, NULL},
    {"plastic", PLASTIC, MATERIAL_PLASTIC, NULL},
    {"substrate", SUBSTRATE, MATERIAL_SUBSTRATE, NULL},
    {"uber", UBER, MATERIAL_UBER, NULL},
    {"translucent", TRANSLUCENT, MATERIAL_TRANSLUCENT, NULL},
    {"mix", MIX, MATERIAL_MIX, NULL},
    REFUSED("disney"), REFUSED("fourier"), REFUSED("hair"), REFUSED("kdsubsurface"), REFUSED("subsurface"),
    END_OF_TYPES};

bool parse_make_material(struct parser *p, int *out)
{
    struct params *q = &p->params;
    *out = MATERIAL_NONE;
    if (q->type[0] == '\0' || strcmp(q->type, "none") == 0) {
        for (int i = 0; i < q->n; i++)
            q->item[i].used = true; /* nothing is left to use them */
        return params_done(q);
    }
    if (!parse_type(p, TYPES))
        return false;
    struct material m = material_blank((enum material_kind)p->type->kind);
    if (!parse_object(p, &m))
        return false;
    if (m.vroughness < 0)
        m.vroughness = m.uroughness;
    *out = scene_add_material(p->scene, m);
    if (!material_fits(p->scene->material, *out))
        return source_error(&p->messages, q->position,
                            "this mix has more than %d lobes in all; mix fewer materials", MATERIAL_MAX_LOBES);
    return true;
}

static bool material(struct parser *p) { return parse_typed(p) && parse_make_material(p, &p->state.material); }

static bool make_named_material(struct parser *p)
{
    struct token name;
    int id;
    if (!parse_string(p, &name, "a name") || !parse_list(p, "Material", &name))
        return false;
    const char *type = params_text(&p->params, "type", PARAM_STRING, &p->params.position);
    if (type == NULL)
        return params_fail(&p->params, name.position,
                           "MakeNamedMaterial needs its kind: add \"string type\" \"matte\"");
    p->params.type = type;
    if (!parse_make_material(p, &id))
        return false;
    if (symbols_find(&p->materials, name.text) >= 0)
        source_warn(&p->messages, name.position, "material again", "the material \"%.60s\" is defined again",
                    name.text);
    symbols_add(&p->materials, name.text, id + 1); /* 0 stands for "none" */
    return true;
}

static bool named_material(struct parser *p)
{
    struct token name;
    int id = parse_named(p, &name, &p->materials, "named material");
    if (id >= 0)
        p->state.material = id - 1;
    return id >= 0;
}

const struct directive MATERIAL_DIRECTIVES[] = {{"NamedMaterial", IN_WORLD, named_material, NULL},
                                                {"Material", IN_WORLD, material, NULL},
                                                {"MakeNamedMaterial", IN_WORLD, make_named_material, NULL},
                                                END_OF_DIRECTIVES};
