/* uber.c: a bit of everything: diffuse, glossy, mirror, refraction, and holes by opacity. */
#include "material/lobe_list.h"

struct uber {
    struct material is;
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
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, Ks, none), 1, eta), list, m);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_REFLECTION, Kr, none), 1, eta);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, none, Kt), 1, eta);
}

/* Without "vroughness" v is as u, be u "uroughness": pbrt's uber differs from its metal. */
#define AT(member) offsetof(struct uber, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    COLOUR_FIELD("Kr", AT(Kr), 0), COLOUR_FIELD("Kt", AT(Kt), 0),
    {"index", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), FIELD_KEPT, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    COLOUR_FIELD("opacity", AT(opacity), 1),
    ROUGHNESS_FIELD("roughness", u, 0.1),
    AXIS_FIELDS(FIELD_KEPT), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_uber = {
    .name = "uber", .fields = FIELDS, .size = sizeof(struct uber), .most_lobes = 5, .may_be_delta = true,
    .lobes = lobes};
