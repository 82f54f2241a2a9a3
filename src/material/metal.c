/* metal.c: facets of a conductor. */
#include "material/lobe_list.h"

struct metal {
    struct material is;
    int eta, k; /* -1: copper's */
};

/* Complex index of copper in sRGB: pbrt-v3's default, its tabulated spectra reduced to RGB. */
static const rgb ETA = {0.199990, 0.922086, 1.099876}, K = {3.904638, 2.447633, 2.137651};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct metal *metal = (const struct metal *)m;
    struct lobe *l = lobe_add(list, LOBE_MICROFACET_REFLECTION, rgb_grey(1), rgb_black());
    lobe_rough(l, list, m);
    l->fresnel = FRESNEL_CONDUCTOR;
    l->of.conductor.eta = metal->eta < 0 ? ETA : colour_at(list, metal->eta);
    l->of.conductor.k = metal->k < 0 ? K : colour_at(list, metal->k);
}

#define AT(member) offsetof(struct metal, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("eta", AT(eta), FIELD_KEPT), COLOUR_FIELD("k", AT(k), FIELD_KEPT),
    ROUGHNESS_FIELDS(0.01), AXIS_FIELDS(FIELD_KEPT), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_metal = {.name = "metal", .fields = FIELDS, .size = sizeof(struct metal),
                                            .most_lobes = 1, .lobes = lobes};
