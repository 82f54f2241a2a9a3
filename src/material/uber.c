/* uber.c: a bit of everything: diffuse, glossy, mirror, refraction, and holes by opacity. */
#include <stddef.h>

#include "material/lobe_list.h"

struct uber {
    struct material is;
    struct roughness rough;
    int Kd, Ks, Kr, Kt, index, opacity;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct uber *u = (const struct uber *)m;
    rgb opacity = colour_at(list, u->opacity), clear = limited_rgb(rgb_sub(rgb_grey(1), opacity)), none = rgb_black();
    rgb Kd = rgb_mul(opacity, colour_at(list, u->Kd)), Ks = rgb_mul(opacity, colour_at(list, u->Ks));
    rgb Kr = rgb_mul(opacity, colour_at(list, u->Kr)), Kt = rgb_mul(opacity, colour_at(list, u->Kt));
    double eta = index_at(list, u->index);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, none, clear), 1, 1);
    lobe_add(list, LOBE_LAMBERT_REFLECTION, Kd, none);
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, Ks, none), 1, eta), list, &u->rough);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_REFLECTION, Kr, none), 1, eta);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, none, Kt), 1, eta);
}

static bool is_brushed(const struct material *m, const struct texture_set *textures)
{
    return roughness_differs(&((const struct uber *)m)->rough, textures);
}

/* Without "vroughness" v is as u, be u "uroughness": pbrt's uber differs from its metal. */
#define AT(member) offsetof(struct uber, member)
static const struct field FIELDS[] = {
    {"Kd", FIELD_RGB_TEXTURE, AT(Kd), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Ks", FIELD_RGB_TEXTURE, AT(Ks), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Kr", FIELD_RGB_TEXTURE, AT(Kr), 0, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Kt", FIELD_RGB_TEXTURE, AT(Kt), 0, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"index", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), FIELD_KEPT, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"opacity", FIELD_RGB_TEXTURE, AT(opacity), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), FIELD_KEPT, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), FIELD_KEPT, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_uber = {
    .name = "uber", .fields = FIELDS, .size = sizeof(struct uber), .most_lobes = 5, .may_be_delta = true,
    .lobes = lobes, .is_brushed = is_brushed};
