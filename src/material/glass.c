/* glass.c: a boundary between two dielectrics, smooth or rough; and the two materials that, as in pbrt-v3's bdpt, which
 * sees nothing of what is beneath their surface, are their boundary alone. */
#include "material/lobe_list.h"

struct glass {
    struct material is;
    int Kr, Kt, index;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct glass *g = (const struct glass *)m;
    rgb R = colour_at(list, g->Kr), T = colour_at(list, g->Kt), none = rgb_black();
    double eta = index_at(list, g->index);
    bool smooth = number_at(list, m->rough.u) == 0 && number_at(list, m->rough.v) == 0;
    if (smooth || eta == 1) { /* where nothing refracts, facets do not scatter either */
        lobe_dielectric(lobe_add(list, LOBE_FRESNEL_SPECULAR, R, T), 1, eta);
        return;
    }
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, R, none), 1, eta), list, m);
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_TRANSMISSION, none, T), 1, eta), list, m);
}

static bool is_deep(const struct material *m, const struct texture_set *textures)
{
    (void)m;
    (void)textures;
    return true;
}

/* Glass and substrate have no "roughness" in pbrt-v3: it passes over that, so do we. Of two indices "eta" wins. */
#define AT(member) offsetof(struct glass, member)
static const struct field GLASS[] = {
    COLOUR_FIELD("Kr", AT(Kr), 1), COLOUR_FIELD("Kt", AT(Kt), 1),
    {"index", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), FIELD_KEPT, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    AXIS_FIELDS(0), REMAP_FIELD, LAST_FIELDS};

static const struct field SUBSURFACE[] = {
    {"name", .kind = FIELD_IGNORED}, {"sigma_a", .kind = FIELD_IGNORED}, {"sigma_s", .kind = FIELD_IGNORED},
    {"scale", .kind = FIELD_IGNORED}, {"g", .kind = FIELD_IGNORED},
    COLOUR_FIELD("Kr", AT(Kr), 1), COLOUR_FIELD("Kt", AT(Kt), 1),
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), 1.33, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    AXIS_FIELDS(0), REMAP_FIELD, LAST_FIELDS};

static const struct field KDSUBSURFACE[] = {
    {"Kd", .kind = FIELD_IGNORED}, {"mfp", .kind = FIELD_IGNORED}, {"scale", .kind = FIELD_IGNORED},
    {"g", .kind = FIELD_IGNORED},
    COLOUR_FIELD("Kr", AT(Kr), 1), COLOUR_FIELD("Kt", AT(Kt), 1),
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), 1.33, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    AXIS_FIELDS(0), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_glass = {
    .name = "glass", .fields = GLASS, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes};
const struct material_row material_subsurface = {
    .name = "subsurface", .fields = SUBSURFACE, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes, .is_deep = is_deep};
const struct material_row material_kdsubsurface = {
    .name = "kdsubsurface", .fields = KDSUBSURFACE, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes, .is_deep = is_deep};
