/* translucent.c: diffuse and glossy on both sides. */
#include "material/lobe_list.h"

struct translucent {
    struct material is;
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
    lobe_rough(lobe_dielectric(above, 1, eta), list, m);
    struct lobe *below = lobe_add(list, LOBE_MICROFACET_TRANSMISSION, none, rgb_mul(down, Ks));
    lobe_rough(lobe_dielectric(below, 1, eta), list, m);
}

#define AT(member) offsetof(struct translucent, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    COLOUR_FIELD("reflect", AT(reflect), 0.5), COLOUR_FIELD("transmit", AT(transmit), 0.5),
    ROUGHNESS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_translucent = {
    .name = "translucent", .fields = FIELDS, .size = sizeof(struct translucent), .most_lobes = 4, .lobes = lobes};
