/* mirror.c: a smooth mirror of one reflectance at all angles. */
#include <stddef.h>

#include "material/lobe_list.h"

struct mirror {
    struct material is;
    int Kr;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    lobe_add(list, LOBE_SPECULAR_REFLECTION, colour_at(list, ((const struct mirror *)m)->Kr), rgb_black());
}

#define AT(member) offsetof(struct mirror, member)
static const struct field FIELDS[] = {
    {"Kr", FIELD_RGB_TEXTURE, AT(Kr), 0.9, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR},
    {"bumpmap", FIELD_FLOAT_TEXTURE, AT(is.bump), .fallback = FIELD_KEPT},
    {.name = NULL}};

const struct material_row material_mirror = {.name = "mirror", .fields = FIELDS, .size = sizeof(struct mirror),
                                             .most_lobes = 1, .may_be_delta = true, .lobes = lobes};
