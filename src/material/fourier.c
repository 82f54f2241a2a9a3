/* fourier.c: a layered material that is a table (fourier_table.h). */
#include "material/lobe_list.h"

struct fourier {
    struct material is;
    int table; /* of the texture set */
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    struct lobe *l = lobe_add(list, LOBE_FOURIER, rgb_grey(1), rgb_black());
    l->of.table = &list->textures->table[((const struct fourier *)m)->table];
}

#define AT(member) offsetof(struct fourier, member)
static const struct field FIELDS[] = {
    {"bsdffile", .kind = FIELD_FOURIER_TABLE, .place = AT(table)},
    LAST_FIELDS};

const struct material_row material_fourier = {
    .name = "fourier", .fields = FIELDS, .size = sizeof(struct fourier), .most_lobes = 1, .lobes = lobes};
