/* parse_material.c: the parameters of each material, with pbrt-v3's defaults [PBRT3 materials/]. See parse.h. */
#include "parser/parse.h"

#include <string.h>

static const char *const KINDS[] = {"matte",     "mirror", "glass",       "metal", "plastic",
                                    "substrate", "uber",   "translucent", "mix",   NULL};
static const char *const REFUSED[] = {"disney", "fourier", "hair", "kdsubsurface", "subsurface", NULL};

/* Complex index of copper in sRGB: pbrt-v3's default metal, its tabulated spectra reduced to RGB. */
static const rgb COPPER_ETA = {0.199990, 0.922086, 1.099876};
static const rgb COPPER_K = {3.904638, 2.447633, 2.137651};

static struct material no_parameters(enum material_kind kind)
{
    struct material m = {.kind = kind,
                         .Kd = -1,
                         .Ks = -1,
                         .Kr = -1,
                         .Kt = -1,
                         .sigma = -1,
                         .eta = -1,
                         .k = -1,
                         .index = -1,
                         .uroughness = -1,
                         .vroughness = -1,
                         .remap_roughness = true,
                         .opacity = -1,
                         .reflect = -1,
                         .transmit = -1,
                         .amount = -1,
                         .mix1 = -1,
                         .mix2 = -1,
                         .bump = -1};
    return m;
}

/* Refuse a texture that is the same everywhere and outside [low, high]. Returns it. */
static int within(struct parser *p, const char *name, int texture, double low, double high)
{
    const struct texture *t = texture < 0 ? NULL : &p->scene->textures.texture[texture];
    if (t == NULL || t->kind != TEXTURE_CONSTANT || p->params.failed)
        return texture;
    const double value[3] = {t->u.constant.r, t->u.constant.g, t->u.constant.b};
    for (int i = 0; i < 3; i++)
        if (!(value[i] >= low && value[i] <= high)) {
            const struct param *item = params_ignore(&p->params, name);
            params_fail(&p->params, item != NULL ? item->place : p->params.place,
                        "\"%s\" is %g; it must be from %g to %g", name, value[i], low, high);
            break;
        }
    return texture;
}

/* Negative numbers of a colour count as 0: colours of the file that sRGB has not got have some. */
static int coloured(struct parser *p, const char *name, rgb fallback)
{
    return within(p, name, parse_rgb_texture(p, name, fallback), -MATERIAL_MAX_COLOUR, MATERIAL_MAX_COLOUR);
}

static int grey(struct parser *p, const char *name, double fallback) { return coloured(p, name, rgb_grey(fallback)); }

/* A roughness, or `otherwise` where the parameter is absent. */
static int rough(struct parser *p, const char *name, int otherwise)
{
    return within(p, name, parse_float_texture_or(p, name, otherwise), 0, MATERIAL_MAX_ROUGHNESS);
}

/* "roughness" for both directions, unless one of them has its own. */
static void roughness(struct parser *p, struct material *m, double fallback, bool anisotropic)
{
    m->uroughness = m->vroughness = rough(p, "roughness", parse_constant(p, rgb_grey(fallback)));
    if (anisotropic) {
        m->uroughness = rough(p, "uroughness", m->uroughness);
        m->vroughness = rough(p, "vroughness", m->vroughness);
    }
    m->remap_roughness = params_bool(&p->params, "remaproughness", true);
}

/* Glass and substrate have only the two directions in pbrt-v3; it passes over "roughness" there, and so do we. */
static void two_roughnesses(struct parser *p, struct material *m, double fallback)
{
    int smooth = parse_constant(p, rgb_grey(fallback));
    m->uroughness = rough(p, "uroughness", smooth);
    m->vroughness = rough(p, "vroughness", smooth);
    m->remap_roughness = params_bool(&p->params, "remaproughness", true);
    const struct param *both = params_ignore(&p->params, "roughness");
    if (both != NULL)
        place_warn(&p->messages, both->place, "roughness",
                   "pbrt-v3 does not read \"roughness\" of this material, so it is ignored; "
                   "use \"uroughness\" and \"vroughness\"");
}

/* The index of refraction, "eta" or "index". */
static int refraction(struct parser *p)
{
    int index = parse_float_texture(p, "index", 1.5), eta = parse_float_texture_or(p, "eta", -1);
    within(p, "index", index, MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX);
    return eta < 0 ? index : within(p, "eta", eta, MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX);
}

static int mixed(struct parser *p, const char *parameter)
{
    struct params *q = &p->params;
    struct place at;
    const char *name = params_text(q, parameter, PARAM_STRING, &at);
    if (name == NULL) {
        params_fail(q, q->place, "a mix needs \"string namedmaterial1\" and \"string namedmaterial2\"");
        return -1;
    }
    int value = names_find(&p->materials, name), id = value - 1;
    const char *near = names_near(&p->materials, name);
    if (value < 0 && near != NULL)
        params_fail(q, at, "there is no named material \"%.60s\"; did you mean \"%.60s\"?", name, near);
    else if (value < 0)
        params_fail(q, at, "there is no named material \"%.60s\"; define it with MakeNamedMaterial", name);
    else if (id == MATERIAL_NONE)
        params_fail(q, at, "the material \"%.60s\" is \"none\"; it cannot be mixed", name);
    return id;
}

static struct material make(struct parser *p, enum material_kind kind)
{
    struct material m = no_parameters(kind);
    switch (kind) {
    case MATERIAL_MATTE:
        m.Kd = grey(p, "Kd", 0.5);
        m.sigma = parse_float_texture(p, "sigma", 0);
        break;
    case MATERIAL_MIRROR: m.Kr = grey(p, "Kr", 0.9); break;
    case MATERIAL_GLASS:
        m.Kr = grey(p, "Kr", 1);
        m.Kt = grey(p, "Kt", 1);
        m.index = refraction(p);
        two_roughnesses(p, &m, 0);
        break;
    case MATERIAL_METAL:
        m.eta = coloured(p, "eta", COPPER_ETA);
        m.k = coloured(p, "k", COPPER_K);
        roughness(p, &m, 0.01, true);
        break;
    case MATERIAL_PLASTIC:
        m.Kd = grey(p, "Kd", 0.25);
        m.Ks = grey(p, "Ks", 0.25);
        roughness(p, &m, 0.1, false);
        break;
    case MATERIAL_SUBSTRATE:
        m.Kd = grey(p, "Kd", 0.5);
        m.Ks = grey(p, "Ks", 0.5);
        two_roughnesses(p, &m, 0.1);
        break;
    case MATERIAL_UBER:
        m.Kd = grey(p, "Kd", 0.25);
        m.Ks = grey(p, "Ks", 0.25);
        m.Kr = grey(p, "Kr", 0);
        m.Kt = grey(p, "Kt", 0);
        m.index = refraction(p);
        m.opacity = grey(p, "opacity", 1);
        roughness(p, &m, 0.1, true);
        m.vroughness = rough(p, "vroughness", m.uroughness); /* pbrt's uber differs from its metal */
        break;
    case MATERIAL_TRANSLUCENT:
        m.Kd = grey(p, "Kd", 0.25);
        m.Ks = grey(p, "Ks", 0.25);
        m.reflect = grey(p, "reflect", 0.5);
        m.transmit = grey(p, "transmit", 0.5);
        roughness(p, &m, 0.1, false);
        break;
    case MATERIAL_MIX:
        m.mix1 = mixed(p, "namedmaterial1");
        m.mix2 = mixed(p, "namedmaterial2");
        m.amount = grey(p, "amount", 0.5);
        return m;
    }
    m.bump = parse_float_texture_or(p, "bumpmap", -1);
    return m;
}

bool parse_material(struct parser *p, int *out)
{
    struct params *q = &p->params;
    *out = MATERIAL_NONE;
    if (q->type[0] == '\0' || strcmp(q->type, "none") == 0) {
        for (int i = 0; i < q->n; i++)
            q->item[i].used = true; /* nothing is left to use them */
        return params_done(q);
    }
    int kind = parse_name(p, KINDS, REFUSED);
    if (kind < 0)
        return false;
    struct material m = make(p, (enum material_kind)kind);
    if (!params_done(q))
        return false;
    *out = scene_add_material(p->scene, m);
    if (!material_fits(p->scene->material, *out))
        return place_error(&p->messages, q->place, "this mix has more than %d lobes in all; mix fewer materials",
                           MATERIAL_MAX_LOBES);
    return true;
}
