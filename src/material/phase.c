/* phase.c: how a medium scatters light, wherever it does: no material of scene files. [PBRT3 11.2] */
#include "material/phase.h"

struct phase {
    struct material is;
    double g;
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    lobe_add(list, LOBE_PHASE, rgb_grey(1), rgb_black())->of.g = ((const struct phase *)m)->g;
}

static const struct field FIELDS[] = {{.name = NULL}};
static const struct material_row ROW = {
    .name = "medium", .fields = FIELDS, .size = sizeof(struct phase), .most_lobes = 1, .lobes = lobes};

struct material *phase_new(double g)
{
    struct material *m = material_new(&ROW);
    ((struct phase *)m)->g = g;
    return m;
}
