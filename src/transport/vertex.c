/* vertex.c: see vertex.h. */
#include "transport/vertex.h"

#include <string.h>

struct light_point vertex_light_point(const struct vertex *v)
{
    struct light_point at = {v->light, v->cell, v->p, v->ng, v->wo, v->prim_id, 0, 0};
    return at;
}

/* An eye sub-path that escapes meets all infinite lights at once, so their densities are added up for the weight.
 * [PBRT3 16.3.5] */
double vertex_light_pdf(const struct light_set *lights, const struct light_point *at)
{
    bool several = lights->n_infinite > 1 && lights->light[at->light].kind == LIGHT_INFINITE;
    return several ? light_pdf_environment(lights, at->w) : at->pdf;
}

void vertex_light_end(const struct scene *scene, const struct mis_counts *counts, const struct light_point *at,
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
    out->pdf_fwd = vertex_light_pdf(&scene->lights, at);
    out->mis_c = light_is_delta(l) ? 0 : counts->hit[LATER_HIT];
}
