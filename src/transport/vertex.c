/* vertex.c: see vertex.h. */
#include "transport/vertex.h"

struct light_point vertex_light_point(const struct scene *scene, const struct vertex *v)
{
    const struct light_set *lights = &scene->lights;
    struct light_point at = {.light = v->light, .cell = v->place, .p = v->p, .n = v->ng, .w = v->wo,
                             .prim_id = v->prim_id, .pdf = v->pdf_fwd};
    if (v->kind == VERTEX_ESCAPED) {
        at.w = neg(v->wo); /* of lights at infinity: towards them */
        at.pdf = light_pdf_sky(lights, at.w, &at.cell);
    } else if (v->kind == VERTEX_SURFACE) {
        const struct surface on = {.light = v->light, .ng = v->ng};
        at.cell = lights->light[v->light].cell;
        at.pdf = light_pdf_surface(lights, &scene->geo, &on);
    }
    return at;
}

void vertex_light(const struct scene *scene, const struct light_point *at, rgb beta, double n_s0, struct vertex *out)
{
    const struct light *l = &scene->lights.light[at->light];
    *out = (struct vertex){.kind = VERTEX_LIGHT, .light = at->light, .place = at->cell, .p = at->p, .ng = at->n,
                           .prim_id = at->prim_id, .medium = l->medium, .wo = at->w, .beta = beta, .pdf_fwd = at->pdf,
                           .mis_c = light_is_delta(l) ? 0 : n_s0};
}

/* pdf_fwd never enters a weight: no strategy finds the lens by chance. */
void vertex_lens(const struct camera *camera, vec3 p, rgb beta, struct vertex *out)
{
    *out = (struct vertex){.kind = VERTEX_LENS, .light = -1, .p = p, .medium = camera->medium,
                           .beta = beta, .pdf_fwd = 1};
}
