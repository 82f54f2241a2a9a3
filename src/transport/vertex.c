/* vertex.c: see vertex.h. */
#include "transport/vertex.h"

#include <string.h>

struct light_point vertex_light_point(const struct vertex *v)
{
    vec3 w = v->kind == VERTEX_ESCAPED ? neg(v->wo) : v->wo; /* of lights at infinity: towards them */
    return (struct light_point){v->light, v->cell, v->p, v->ng, w, v->prim_id, 0, 0};
}

void vertex_light_end(const struct scene *scene, const struct counts *counts, const struct light_point *at,
                      struct vertex *out)
{
    const struct light *l = &scene->lights.light[at->light];
    memset(out, 0, sizeof *out);
    out->kind = VERTEX_LIGHT;
    out->light = at->light;
    out->cell = at->cell;
    out->p = at->p;
    out->ng = at->n;
    out->prim_id = at->prim_id;
    out->medium = l->medium;
    out->wo = at->w;
    out->pdf_fwd = at->pdf;
    out->mis_c = light_is_delta(l) ? 0 : counts->hit[LATER_HIT];
}
