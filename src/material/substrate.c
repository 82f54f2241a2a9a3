/* substrate.c: a diffuse base under a glossy coat, in one lobe. [Ashikhmin & Shirley 2000] */
#include "material/lobe_list.h"

struct substrate {
    struct material is;
    int Kd, Ks;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct substrate *s = (const struct substrate *)m;
    struct lobe *l = lobe_add(list, LOBE_FRESNEL_BLEND, colour_at(list, s->Kd), rgb_black());
    lobe_rough(l, list, m);
    l->of.coat = colour_at(list, s->Ks);
}

#define AT(member) offsetof(struct substrate, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.5), COLOUR_FIELD("Ks", AT(Ks), 0.5),
    AXIS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_substrate = {
    .name = "substrate", .fields = FIELDS, .size = sizeof(struct substrate), .most_lobes = 1, .lobes = lobes};
