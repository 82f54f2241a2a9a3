/* metal.c: facets of a conductor. */
#include <stddef.h>

#include "material/lobe_list.h"

struct metal {
    struct material is;
    struct roughness rough;
    int eta, k; /* -1: copper's */
};

/* Complex index of copper in sRGB: pbrt-v3's default, its tabulated spectra reduced to RGB. */
static const rgb ETA = {0.199990, 0.922086, 1.099876}, K = {3.904638, 2.447633, 2.137651};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct metal *metal = (const struct metal *)m;
    struct lobe *l = lobe_add(list, LOBE_MICROFACET_REFLECTION, rgb_grey(1), rgb_black());
    lobe_rough(l, list, &metal->rough);
    l->fresnel = FRESNEL_CONDUCTOR;
    l->of.conductor.eta = metal->eta < 0 ? ETA : colour_at(list, metal->eta);
    l->of.conductor.k = metal->k < 0 ? K : colour_at(list, metal->k);
}

static bool is_brushed(const struct material *m, const struct texture_set *textures)
{
    return roughness_differs(&((const struct metal *)m)->rough, textures);
}

#define AT(member) offsetof(struct metal, member)
static const struct field FIELDS[] = {
    {"eta", FIELD_RGB_TEXTURE, AT(eta), FIELD_KEPT, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"k", FIELD_RGB_TEXTURE, AT(k), FIELD_KEPT, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0.01, .high = MATERIAL_MAX_ROUGHNESS},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0.01, .high = MATERIAL_MAX_ROUGHNESS},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), FIELD_KEPT, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), FIELD_KEPT, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_metal = {.name = "metal", .fields = FIELDS, .size = sizeof(struct metal),
                                            .most_lobes = 1, .lobes = lobes, .is_brushed = is_brushed};
