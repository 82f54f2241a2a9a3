/* glass.c: a boundary between two dielectrics, smooth or rough; and the two materials that, as in pbrt-v3's bdpt, which
 * sees nothing of what is beneath their surface, are their boundary alone. */
#include <stddef.h>

#include "material/lobe_list.h"

struct glass {
    struct material is;
    struct roughness rough;
    int Kr, Kt, index;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct glass *g = (const struct glass *)m;
    rgb R = colour_at(list, g->Kr), T = colour_at(list, g->Kt), none = rgb_black();
    double eta = index_at(list, g->index);
    if (roughness_is_zero(list, &g->rough) || eta == 1) { /* where nothing refracts, facets do not scatter either */
        lobe_dielectric(lobe_add(list, LOBE_FRESNEL_SPECULAR, R, T), 1, eta);
        return;
    }
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, R, none), 1, eta), list, &g->rough);
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_TRANSMISSION, none, T), 1, eta), list, &g->rough);
}

static bool is_brushed(const struct material *m, const struct texture_set *textures)
{
    return roughness_differs(&((const struct glass *)m)->rough, textures);
}

static bool is_deep(const struct material *m, const struct texture_set *textures)
{
    (void)m;
    (void)textures;
    return true;
}

/* Glass has no "roughness" in pbrt-v3, nor has substrate: it passes over that, so do we. Of two indices "eta" wins. */
#define AT(member) offsetof(struct glass, member)
static const struct field GLASS[] = {
    {"Kr", FIELD_RGB_TEXTURE, AT(Kr), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Kt", FIELD_RGB_TEXTURE, AT(Kt), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"index", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), FIELD_KEPT, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

static const struct field SUBSURFACE[] = {
    {"name", .kind = FIELD_IGNORED}, {"sigma_a", .kind = FIELD_IGNORED}, {"sigma_s", .kind = FIELD_IGNORED},
    {"scale", .kind = FIELD_IGNORED}, {"g", .kind = FIELD_IGNORED},
    {"Kr", FIELD_RGB_TEXTURE, AT(Kr), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Kt", FIELD_RGB_TEXTURE, AT(Kt), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), 1.33, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

static const struct field KDSUBSURFACE[] = {
    {"Kd", .kind = FIELD_IGNORED}, {"mfp", .kind = FIELD_IGNORED}, {"scale", .kind = FIELD_IGNORED},
    {"g", .kind = FIELD_IGNORED},
    {"Kr", FIELD_RGB_TEXTURE, AT(Kr), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"Kt", FIELD_RGB_TEXTURE, AT(Kt), 1, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), 1.33, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"uroughness", FIELD_FLOAT_TEXTURE, AT(rough.u), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"vroughness", FIELD_FLOAT_TEXTURE, AT(rough.v), 0, .high = MATERIAL_MAX_ROUGHNESS},
    {"remaproughness", FIELD_SWITCH, AT(rough.remap), .fallback = 1},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_glass = {
    .name = "glass", .fields = GLASS, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes, .is_brushed = is_brushed};
const struct material_row material_subsurface = {
    .name = "subsurface", .fields = SUBSURFACE, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes, .is_brushed = is_brushed, .is_deep = is_deep};
const struct material_row material_kdsubsurface = {
    .name = "kdsubsurface", .fields = KDSUBSURFACE, .size = sizeof(struct glass), .most_lobes = 2, .may_be_delta = true,
    .lobes = lobes, .is_brushed = is_brushed, .is_deep = is_deep};
