/* mix.c: the lobes of two materials, those of the first times `amount`, those of the second times the rest. */
#include "material/lobe_list.h"

struct mix {
    struct material is;
    int part[2]; /* materials made before */
    int amount;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct mix *mix = (const struct mix *)m;
    rgb share = colour_at(list, mix->amount);
    for (int branch = 0; branch < 2; branch++) {
        const struct material *part = list->materials[mix->part[branch]];
        int first = list->n;
        part->row->lobes(list, part);
        for (struct lobe *l = list->lobe + first; l < list->lobe + list->n; l++)
            l->scale = rgb_mul(l->scale, share);
        share = limited_rgb(rgb_sub(rgb_grey(1), share));
    }
}

#define AT(member) offsetof(struct mix, member)
static const struct field FIELDS[] = {
    {"namedmaterial1", .kind = FIELD_MATERIAL, .place = AT(part[0])},
    {"namedmaterial2", .kind = FIELD_MATERIAL, .place = AT(part[1])},
    COLOUR_FIELD("amount", AT(amount), 0.5),
    {.name = NULL}};

const struct material_row material_mix = {
    .name = "mix", .fields = FIELDS, .size = sizeof(struct mix), .lobes = lobes, .may_be_brushed = true};
