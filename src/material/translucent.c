/* translucent.c: diffuse and glossy on both sides. */
#include <stddef.h>

#include "material/lobe_list.h"

struct translucent {
    struct material is;
    struct roughness rough;
    int Kd, Ks, reflect, transmit;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const double eta = 1.5;
    const struct translucent *t = (const struct translucent *)m;
    rgb up = colour_at(list, t->reflect), down = colour_at(list, t->transmit), none = rgb_black();
    rgb Kd = colour_at(list, t->Kd), Ks = colour_at(list, t->Ks);
    lobe_add(list, LOBE_LAMBERT_REFLECTION, rgb_mul(up, Kd), none);
    lobe_add(list, LOBE_LAMBERT_TRANSMISSION, none, rgb_mul(down, Kd));
    struct lobe *above = lobe_add(list, LOBE_MICROFACET_REFLECTION, rgb_mul(up, Ks), none);
    lobe_rough(lobe_dielectric(above, 1, eta), list, &t->rough);
    struct lobe *below = lobe_add(list, LOBE_MICROFACET_TRANSMISSION, none, rgb_mul(down, Ks));
    lobe_rough(lobe_dielectric(below, 1, eta), list, &t->rough);
}

#define AT(member) offsetof(struct translucent, member)
static const struct field FIELDS[] = {
    {"Kd", FIELD_RGB_TEXTURE, AT(Kd), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Ks", FIELD_RGB_TEXTURE, AT(Ks), 0.25, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"reflect", FIELD_RGB_TEXTURE, AT(reflect), 0.5, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"transmit", FIELD_RGB_TEXTURE, AT(transmit), 0.5, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"roughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0.1, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_translucent = {
    .name = "translucent", .fields = FIELDS, .size = sizeof(struct translucent), .most_lobes = 4, .lobes = lobes};
