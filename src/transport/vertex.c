/* vertex.c: see vertex.h. */
#include "transport/vertex.h"

struct light_point vertex_light_point(const struct vertex *v)
{
    vec3 w = v->kind == VERTEX_ESCAPED ? neg(v->wo) : v->wo; /* of lights at infinity: towards them */
    return (struct light_point){v->light, v->cell, v->p, v->ng, w, v->prim_id, 0, 0};
}

void vertex_light(const struct scene *scene, const struct light_point *at, rgb beta, double hit, struct vertex *out)
{
    const struct light *l = &scene->lights.light[at->light];
    *out = (struct vertex){.kind = VERTEX_LIGHT, .light = at->light, .cell = at->cell, .p = at->p, .ng = at->n,
                           .prim_id = at->prim_id, .medium = l->medium, .wo = at->w, .beta = beta, .pdf_fwd = at->pdf,
                           .mis_c = light_is_delta(l) ? 0 : hit};
}

/* pdf_fwd never enters a weight: no strategy finds the lens by chance. */
void vertex_lens(const struct camera *camera, vec3 p, rgb beta, struct vertex *out)
{
    *out = (struct vertex){.kind = VERTEX_LENS, .light = -1, .cell = -1, .p = p, .medium = camera->medium,
                           .beta = beta, .pdf_fwd = 1};
}
