/* parse_material.c: the parameters of each material, with pbrt-v3's defaults [pbrt-v3 materials/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static void mixed_material(struct parser *p, const struct parameter *row, void *field)
{
    struct source_position at = p->params.position;
    const char *name = params_text(&p->params, row->name, PARAM_STRING, &at);
    int k = name != NULL ? symbols_find(&p->materials, name) : -1;
    *(int *)field = k >= 0 ? p->material[k].id : MATERIAL_NONE;
    if (*(int *)field == MATERIAL_NONE)
        params_fail(&p->params, at, "\"%s\" of a mix must name a material that is not \"none\"", row->name);
}

/* Negative numbers of a colour count as 0: colours of the file that sRGB has not got have some. */
#define RGB(f, r, g, b) \
    {#f, parse_rgb_texture, offsetof(struct material, f), {r, g, b}, -MATERIAL_MAX_COLOUR, MATERIAL_MAX_COLOUR}
#define COLOUR(f, value) RGB(f, value, value, value)
#define TEXTURE(name, f, value, range) \
    {name, parse_float_texture, offsetof(struct material, f), GREY(value), range}
#define ROUGHNESSES 0, MATERIAL_MAX_ROUGHNESS
#define INDICES MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX
#define ROUGH(name, f, value) TEXTURE(name, f, value, ROUGHNESSES)
#define REMAP {"remaproughness", parse_bool, offsetof(struct material, remap_roughness), GREY(1), 0, 0}
#define INDEX /* of refraction; "eta" wins */ \
    TEXTURE("index", index, 1.5, INDICES), TEXTURE("eta", index, KEPT, INDICES)
#define TWO_ROUGHNESSES(value) /* glass and substrate have no "roughness" in pbrt-v3: it passes over that, so do we */ \
    ROUGH("uroughness", uroughness, value), ROUGH("vroughness", vroughness, value), REMAP
#define BUMP TEXTURE("bumpmap", bump, KEPT, ANY_NUMBER), END_OF_PARAMETERS
#define MIXED(name, f) {name, mixed_material, offsetof(struct material, f), GREY(0), 0, 0}

static const struct parameter MATTE[] = {COLOUR(Kd, 0.5), TEXTURE("sigma", sigma, 0, ANY_NUMBER), BUMP};
static const struct parameter MIRROR[] = {COLOUR(Kr, 0.9), BUMP};
static const struct parameter GLASS[] = {COLOUR(Kr, 1), COLOUR(Kt, 1), INDEX, TWO_ROUGHNESSES(0), BUMP};
/* Of what is beneath the surface pbrt-v3's bdpt sees nothing. */
#define BENEATH \
    COLOUR(Kr, 1), COLOUR(Kt, 1), TEXTURE("eta", index, 1.33, INDICES), TWO_ROUGHNESSES(0), IGNORED("scale"), \
        IGNORED("g"), BUMP
static const struct parameter SUBSURFACE[] = {IGNORED("name"), IGNORED("sigma_a"), IGNORED("sigma_s"), BENEATH};
static const struct parameter KDSUBSURFACE[] = {IGNORED("Kd"), IGNORED("mfp"), BENEATH};
#define UNIT 0, 1
#define TWICE 0, 2
#define FACTORS 0, MATERIAL_MAX_COLOUR
static const struct parameter DISNEY[] = {
    {"color", parse_rgb_texture, offsetof(struct material, Kd), GREY(0.5), -MATERIAL_MAX_COLOUR, MATERIAL_MAX_COLOUR},
    TEXTURE("eta", index, 1.5, INDICES),
    ROUGH("roughness", uroughness, 0.5),
    TEXTURE("metallic", disney.metallic, 0, UNIT),
    TEXTURE("speculartint", disney.specular_tint, 0, UNIT),
    TEXTURE("anisotropic", disney.anisotropic, 0, UNIT),
    TEXTURE("sheen", disney.sheen, 0, FACTORS),
    TEXTURE("sheentint", disney.sheen_tint, 0.5, UNIT),
    TEXTURE("clearcoat", disney.clearcoat, 0, FACTORS),
    TEXTURE("clearcoatgloss", disney.clearcoat_gloss, 1, UNIT),
    TEXTURE("spectrans", disney.transmission, 0, UNIT),
    {"scatterdistance", parse_rgb_texture, offsetof(struct material, disney.scatter_distance), GREY(0), ANY_NUMBER},
    {"thin", parse_bool, offsetof(struct material, disney.thin), GREY(0), 0, 0},
    TEXTURE("flatness", disney.flatness, 0, UNIT),
    TEXTURE("difftrans", disney.diffuse_transmission, 1, TWICE),
    BUMP};
static const struct parameter FOURIER[] = {BY_BUILD("bsdffile"), BUMP};
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

static void surface_alone(struct parser *p)
{
    source_warn(&p->messages, p->params.position, "\"%s\" is its surface alone, as in pbrt-v3's \"bdpt\": no light "
                "goes through what is beneath", p->params.type);
}

static void subsurface(struct parser *p, void *object)
{
    surface_alone(p);
    (void)object;
}

static void disney(struct parser *p, void *object)
{
    const struct material *m = object;
    const struct texture *distance = &p->scene->textures.texture[m->disney.scatter_distance];
    if (!m->disney.thin && !(distance->kind == TEXTURE_CONSTANT && rgb_is_black(distance->constant)))
        surface_alone(p);
}

static void fourier(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct texture_set *set = &p->scene->textures;
    struct source_position at = q->position;
    struct error inner;
    int known = set->n_tables, table;
    char *path = params_file(q, "bsdffile", &at);
    if (path == NULL) {
        type_error(q, "a fourier material needs its table: add \"string bsdffile\" \"...\"");
    } else if (!q->failed) {
        ((struct material *)object)->table = table = texture_load_table(set, path, &inner);
        const struct fourier_table *read = table == known ? &set->table[table] : NULL;
        if (table < 0 || (read != NULL && !scene_files_count(q->files, read->content, read->file_size, &inner)))
            params_fail(q, at, "%s", inner.text);
    }
    free(path);
}

const struct object_type MATERIAL_TYPES[] = {
    {"matte", MATTE, MATERIAL_MATTE, NULL},
    {"mirror", MIRROR, MATERIAL_MIRROR, NULL},
    {"glass", GLASS, MATERIAL_GLASS, NULL},
    {"metal", METAL, MATERIAL_METAL, NULL},
    {"plastic", PLASTIC, MATERIAL_PLASTIC, NULL},
    {"substrate", SUBSTRATE, MATERIAL_SUBSTRATE, NULL},
    {"uber", UBER, MATERIAL_UBER, NULL},
    {"translucent", TRANSLUCENT, MATERIAL_TRANSLUCENT, NULL},
    {"subsurface", SUBSURFACE, MATERIAL_GLASS, subsurface},
    {"kdsubsurface", KDSUBSURFACE, MATERIAL_GLASS, subsurface},
    {"disney", DISNEY, MATERIAL_DISNEY, disney},
    {"fourier", FOURIER, MATERIAL_FOURIER, fourier},
    {"mix", MIX, MATERIAL_MIX, NULL},
    END_OF_TYPES};

static bool is_none(const char *type) { return type[0] == '\0' || strcmp(type, "none") == 0; }

/* A material of kind params.type, whose parameters that nobody has asked for are left. */
static bool make(struct parser *p, int *out)
{
    struct params *q = &p->params;
    *out = 0; /* where the parser starts with a matte one */
    if (is_none(q->type)) {
        *out = MATERIAL_NONE;
        for (int i = 0; i < q->n; i++)
            q->item[i].used = true; /* nothing is left to use them */
        return true;
    }
    if (!parse_type(p, MATERIAL_TYPES))
        return false;
    struct material m = material_blank((enum material_kind)p->type->kind);
    parse_fields(p, &m);
    if (q->failed)
        return false;
    if (m.vroughness < 0)
        m.vroughness = m.uroughness;
    *out = scene_add_material(p->scene, m);
    if (material_lobes(p->scene->material, *out) > MATERIAL_MAX_LOBES)
        return source_error(&p->messages, q->position,
                            "this mix has more than %d lobes in all; mix fewer materials", MATERIAL_MAX_LOBES);
    return true;
}

bool parse_make_material(struct parser *p, struct material_source *out)
{
    out->type = p->params.type;
    bool ok = make(p, &out->id) && parse_done(p);
    out->list = params_keep(&p->params);
    return ok;
}

static int n_unused(const struct params *q)
{
    int n = 0;
    for (int i = 0; i < q->n; i++)
        n += !q->item[i].used;
    return n;
}

int parse_changed_material(struct parser *p)
{
    struct params *q = &p->params;
    const struct object_type *shape = p->type;
    const char *directive = q->directive, *type = q->type;
    int id = p->state.material.id, before = n_unused(q), n_materials = p->scene->n_materials;
    if (q->failed || before == 0 || id == MATERIAL_NONE)
        return id;
    q->directive = "Material";
    q->type = p->state.material.type;
    q->behind = p->state.material.list;
    q->failed = !make(p, &id);
    q->behind.n = 0;
    q->directive = directive;
    q->type = type;
    p->type = shape;
    if (n_unused(q) == before) { /* none was the material's */
        p->scene->n_materials = n_materials;
        id = p->state.material.id;
    }
    return id;
}

static bool material(struct parser *p) { return parse_typed(p) && parse_make_material(p, &p->state.material); }

static bool make_named_material(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    struct material_source made = {.type = ""};
    bool ok = parse_list(p, "Material", &name);
    const char *type = params_text(&p->params, "type", PARAM_STRING, &p->params.position);
    if (type == NULL)
        source_warn(&p->messages, name.position,
                    "MakeNamedMaterial needs its kind: add \"string type\" \"matte\"; \"none\" is taken");
    p->params.type = type != NULL ? type : "";
    ok = ok && parse_make_material(p, &made);
    if (symbols_find(&p->materials, name.text) >= 0)
        source_warn(&p->messages, name.position, "the material \"%.60s\" is defined again", name.text);
    p->material = mem_append(p->material, (size_t)p->n_materials, sizeof *p->material);
    p->material[p->n_materials] = made;
    symbols_add(&p->materials, name.text, p->n_materials++);
    return ok;
}

static bool named_material(struct parser *p)
{
    struct token name;
    int k = parse_named(p, &name, &p->materials, "named material", "the material stays as it is");
    if (k >= 0)
        p->state.material = p->material[k];
    return k >= 0;
}

const struct directive MATERIAL_DIRECTIVES[] = {{"NamedMaterial", IN_WORLD, named_material, NULL},
                                                {"Material", IN_WORLD, material, NULL},
                                                {"MakeNamedMaterial", IN_WORLD, make_named_material, NULL},
                                                END_OF_DIRECTIVES};
