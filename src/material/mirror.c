/* mirror.c: a smooth mirror of one reflectance at all angles. */
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
    COLOUR_FIELD("Kr", AT(Kr), 0.9),
    LAST_FIELDS};

const struct material_row material_mirror = {.name = "mirror", .fields = FIELDS, .size = sizeof(struct mirror),
                                             .most_lobes = 1, .may_be_delta = true, .lobes = lobes};
