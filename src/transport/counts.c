/* counts.c: see counts.h. */
#include "transport/counts.h"

double c_light(const struct mis_counts *c, const struct light_set *lights, const struct vertex *prev,
               const struct vertex *y, enum eye_end end)
{
    if (y->prev_delta)
        return 0;
    return prev->kind == VERTEX_LIGHT ? n_direct(c, lights, y->eye_region, end, prev->cell, prev->wo)
                                      : n_connect(c, prev->light_region, y->eye_region, end);
}

double c_eye(const struct mis_counts *c, const struct vertex *prev, const struct vertex *z)
{
    if (z->prev_delta)
        return 0;
    return prev->kind == VERTEX_LENS ? c->splat : n_connect(c, z->light_region, prev->eye_region, prev->eye_end);
}
