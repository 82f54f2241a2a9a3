/* heightfield.c: heights "Pz" over nu x nv points of the unit square, the first row at y = 0. */
#include <stddef.h>

#include "geometry/mesh.h"

struct heightfield {
    int nu, nv;
    struct field_list Pz;
};

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct heightfield *h = fields;
    int nu = h->nu, nv = h->nv;
    if (nu < 2 || nv < 2 || h->Pz.n != nu * nv)
        return error_set(&task->err, "a heightfield needs \"nu\" and \"nv\" of 2 at least, and nu nv heights \"Pz\"");
    mesh_grid(out, nu, nv, false);
    for (int i = 0; i < nu * nv; i++) {
        out->P[3 * i] = out->UV[2 * i] = (float)(i % nu) / (float)(nu - 1);
        out->P[3 * i + 1] = out->UV[2 * i + 1] = (float)(i / nu) / (float)(nv - 1);
        out->P[3 * i + 2] = (float)h->Pz.number[i]; /* within NUMBER_MAX */
    }
    return true;
}

#define AT(member) offsetof(struct heightfield, member)
static const struct field FIELDS[] = {{"nu", FIELD_INTEGER, AT(nu), 0, 0, .high = 1 << 14},
                                      {"nv", FIELD_INTEGER, AT(nv), 0, 0, .high = 1 << 14},
                                      {"Pz", FIELD_FLOATS, AT(Pz), .low = 1},
                                      {.name = NULL}};

const struct shape_row shape_heightfield = {
    .name = "heightfield", .fields = FIELDS, .size = sizeof(struct heightfield), .may_shine = true, .mesh = mesh};
