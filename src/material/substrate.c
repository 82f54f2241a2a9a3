/* substrate.c: a diffuse base under a glossy coat, in one lobe. [Ashikhmin & Shirley 2000] */
#include <stddef.h>

#include "material/lobe_list.h"

struct substrate {
    struct material is;
    struct roughness rough;
    int Kd, Ks;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct substrate *s = (const struct substrate *)m;
    struct lobe *l = lobe_add(list, LOBE_FRESNEL_BLEND, colour_at(list, s->Kd), rgb_black());
    lobe_rough(l, list, &s->rough);
    l->of.coat = colour_at(list, s->Ks);
}

static bool is_brushed(const struct material *m, const struct texture_set *textures)
{
    return roughness_differs(&((const struct substrate *)m)->rough, textures);
}

#define AT(member) offsetof(struct substrate, member)
static const struct field FIELDS[] = {
    {"Kd", FIELD_RGB_TEXTURE, AT(Kd), 0.5, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Ks", FIELD_RGB_TEXTURE, AT(Ks), 0.5, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_substrate = {
    .name = "substrate", .fields = FIELDS, .size = sizeof(struct substrate), .most_lobes = 1, .lobes = lobes,
    .is_brushed = is_brushed};
