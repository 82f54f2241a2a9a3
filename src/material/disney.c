/* disney.c: the Disney BSDF [Burley 2012] [Burley 2015], as pbrt-v3 has it; burley.h has its formulas. */
#include <math.h>
#include <stddef.h>

#include "base/vec.h"
#include "material/burley.h"
#include "material/lobe_list.h"

struct disney {
    struct material is;
    int colour, index, roughness, metallic, specular_tint, anisotropic, sheen, sheen_tint, clearcoat, clearcoat_gloss;
    int transmission;
    int scatter_distance; /* what is beneath begins where it is not black; not there if thin */
    bool thin;
    int flatness, diffuse_transmission; /* of thin ones; the transmission from 0 to 2 */
};

static rgb blend(double t, rgb a, rgb b) { return rgb_add(rgb_scale(a, 1 - t), rgb_scale(b, t)); }

/* What is diffuse of it, of colour c, and has this share of the whole. */
static void diffuse(struct lobe_list *list, const struct disney *d, double whole, rgb c, rgb tint)
{
    bool beneath = !d->thin && !rgb_is_black(colour_at(list, d->scatter_distance));
    double sheen = limited(number_at(list, d->sheen), 0, MATERIAL_MAX_COLOUR);
    struct lobe *l = lobe_add(list, LOBE_FORM, beneath ? rgb_black() : c, rgb_black());
    l->form = &form_disney;
    l->scale = rgb_grey(whole);
    l->of.disney.roughness = roughness_at(list, d->roughness);
    l->of.disney.retro = c;
    l->of.disney.sheen = rgb_scale(blend(fraction_at(list, d->sheen_tint), rgb_grey(1), tint), sheen);
    if (d->thin) {
        double flat = fraction_at(list, d->flatness);
        rgb reflected = rgb_scale(c, 1 - 0.5 * limited(number_at(list, d->diffuse_transmission), 0, 2));
        l->R = rgb_scale(reflected, 1 - flat);
        l->of.disney.flat = rgb_scale(reflected, flat);
    }
    if (beneath)
        lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, rgb_black(), rgb_grey(1)), 1,
                        index_at(list, d->index));
}

/* Roughnesses along and across, as Disney remaps them. */
static void rough(struct lobe *l, const struct lobe_list *list, const struct disney *d, double roughness)
{
    double aspect = sqrt(1 - 0.9 * fraction_at(list, d->anisotropic));
    l->alpha_x = fmax(1e-3, sqr(roughness) / aspect);
    l->alpha_y = fmax(1e-3, sqr(roughness) * aspect);
}

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct disney *d = (const struct disney *)m;
    rgb c = colour_at(list, d->colour), white = rgb_grey(1), none = rgb_black();
    rgb tint = rgb_luminance(c) > 0 ? rgb_scale(c, 1 / rgb_luminance(c)) : white;
    double eta = index_at(list, d->index), roughness = roughness_at(list, d->roughness);
    double metallic = fraction_at(list, d->metallic), through = fraction_at(list, d->transmission);
    double base = (1 - metallic) * (1 - through);
    if (base > 0)
        diffuse(list, d, base, c, tint);
    struct lobe *facets = lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, white, none), 1, eta);
    rough(facets, list, d, roughness);
    facets->fresnel = FRESNEL_DISNEY;
    facets->separate = true;
    facets->of.tinted.metallic = metallic;
    rgb plain = rgb_scale(blend(fraction_at(list, d->specular_tint), white, tint), sqr((eta - 1) / (eta + 1)));
    facets->of.tinted.normal = blend(metallic, plain, c);
    struct lobe *coat = lobe_add(list, LOBE_FORM, limited_rgb(rgb_grey(number_at(list, d->clearcoat))), none);
    coat->form = &form_coat;
    coat->of.gloss = 0.1 - (0.1 - 0.001) * fraction_at(list, d->clearcoat_gloss);
    /* Two refractions give the colour. Thin ones scatter less, as the index does. [Burley 2015] */
    rgb T = rgb_scale(rgb_make(sqrt(c.r), sqrt(c.g), sqrt(c.b)), through);
    enum lobe_kind kind = eta == 1 ? LOBE_SPECULAR_TRANSMISSION : LOBE_MICROFACET_TRANSMISSION; /* as in glass.c */
    struct lobe *glass = lobe_dielectric(lobe_add(list, kind, none, T), 1, eta);
    if (eta != 1)
        rough(glass, list, d, d->thin ? (0.65 * eta - 0.35) * roughness : roughness);
    glass->separate = !d->thin;
    double behind = 0.5 * limited(number_at(list, d->diffuse_transmission), 0, 2);
    if (d->thin)
        lobe_add(list, LOBE_LAMBERT_TRANSMISSION, none, rgb_scale(c, behind));
}

static bool is_deep(const struct material *m, const struct texture_set *textures)
{
    const struct disney *d = (const struct disney *)m;
    const struct texture *distance = &textures->texture[d->scatter_distance];
    return !d->thin && !(distance->kind == TEXTURE_CONSTANT && rgb_is_black(distance->constant));
}

#define AT(member) offsetof(struct disney, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("color", AT(colour), 0.5),
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(roughness), 0.5, .high = MATERIAL_MAX_ROUGHNESS},
    {"metallic", FIELD_FLOAT_TEXTURE, AT(metallic), 0, .high = 1},
    {"speculartint", FIELD_FLOAT_TEXTURE, AT(specular_tint), 0, .high = 1},
    {"anisotropic", FIELD_FLOAT_TEXTURE, AT(anisotropic), 0, .high = 1},
    {"sheen", FIELD_FLOAT_TEXTURE, AT(sheen), 0, .high = MATERIAL_MAX_COLOUR},
    {"sheentint", FIELD_FLOAT_TEXTURE, AT(sheen_tint), 0.5, .high = 1},
    {"clearcoat", FIELD_FLOAT_TEXTURE, AT(clearcoat), 0, .high = MATERIAL_MAX_COLOUR},
    {"clearcoatgloss", FIELD_FLOAT_TEXTURE, AT(clearcoat_gloss), 1, .high = 1},
    {"spectrans", FIELD_FLOAT_TEXTURE, AT(transmission), 0, .high = 1},
    {"scatterdistance", .kind = FIELD_RGB_TEXTURE, .place = AT(scatter_distance)},
    {"thin", .kind = FIELD_SWITCH, .place = AT(thin)},
    {"flatness", FIELD_FLOAT_TEXTURE, AT(flatness), 0, .high = 1},
    {"difftrans", FIELD_FLOAT_TEXTURE, AT(diffuse_transmission), 1, .high = 2},
    LAST_FIELDS};

const struct material_row material_disney = {.name = "disney", .fields = FIELDS, .size = sizeof(struct disney),
                                             .most_lobes = 5, .may_be_delta = true, .lobes = lobes,
                                             .may_be_brushed = true, .is_deep = is_deep};
