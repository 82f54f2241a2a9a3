/* plastic.c: a diffuse base under facets of a dielectric coat. */
#include <stddef.h>

#include "material/lobe_list.h"

struct plastic {
    struct material is;
    struct roughness rough;
    int Kd, Ks;
};

/* pbrt-v3 has the two indices of the coat the wrong way round: from outside its light seems to leave glass of 1.5
 * and is totally reflected from 41.8 degrees on. Its images of plastic are what its users know, so we do the same. */
static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct plastic *p = (const struct plastic *)m;
    lobe_add(list, LOBE_LAMBERT_REFLECTION, colour_at(list, p->Kd), rgb_black());
    struct lobe *coat = lobe_add(list, LOBE_MICROFACET_REFLECTION, colour_at(list, p->Ks), rgb_black());
    lobe_rough(lobe_dielectric(coat, 1.5, 1), list, &p->rough);
}

#define AT(member) offsetof(struct plastic, member)
static const struct field FIELDS[] = {
    {"Kd", FIELD_RGB_TEXTURE, AT(Kd), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Ks", FIELD_RGB_TEXTURE, AT(Ks), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_plastic = {
    .name = "plastic", .fields = FIELDS, .size = sizeof(struct plastic), .most_lobes = 2, .lobes = lobes};
