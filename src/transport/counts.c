/* counts.c: see counts.h. */
#include "transport/counts.h"

struct mis_counts counts_of(struct numbers n, struct credits c, double pixels)
{
    struct mis_counts m = {.splat = n.path_pixels > 0 ? pixels / n.path_pixels : 0};
    for (int end = 0; end < EYE_ENDS; end++) {
        double direct = end == FIRST_HIT ? c.direct : 1;
        int points = !n.path_tracing ? 0 : end == FIRST_HIT ? n.light_points : 1;
        m.hit[end] = n.path_tracing ? direct : 0;
        m.direct[end] = points * direct;
        m.connect[end] = n.path_pixels > 0 ? n.draws[end] * c.draw : 0;
    }
    return m;
}

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
