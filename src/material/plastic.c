/* plastic.c: a diffuse base under facets of a dielectric coat. */
#include "material/lobe_list.h"

struct plastic {
    struct material is;
    int Kd, Ks;
};

/* pbrt-v3 has the two indices of the coat the wrong way round: from outside its light seems to leave glass of 1.5
 * and is totally reflected from 41.8 degrees on. Its images of plastic are what its users know, so we do the same. */
static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct plastic *p = (const struct plastic *)m;
    lobe_add(list, LOBE_LAMBERT_REFLECTION, colour_at(list, p->Kd), rgb_black());
    struct lobe *coat = lobe_add(list, LOBE_MICROFACET_REFLECTION, colour_at(list, p->Ks), rgb_black());
    lobe_rough(lobe_dielectric(coat, 1.5, 1), list, m);
}

#define AT(member) offsetof(struct plastic, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    ROUGHNESS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_plastic = {
    .name = "plastic", .fields = FIELDS, .size = sizeof(struct plastic), .most_lobes = 2, .lobes = lobes};
