/* lamp.c: see lamp.h. */
#include "caustics/lamp.h"

#include "caustics/visible.h"

bool lamp_point(const struct light_set *lights, const struct geometry *geo, const double u[3], struct light_point *out)
{
    const struct alias_table *choice = &lights->choice;
    double in_cell[3] = {0, u[1], u[2]};
    if (choice->n == 0)
        return false;
    int cell = alias_sample(choice, u[0], NULL, &in_cell[0]);
    return light_sample_cell(lights, geo, cell, in_cell, out);
}

bool lamp_draw(const struct scene *scene, struct sampler *sampler, struct light_point *out)
{
    double u[3];
    u[0] = sampler_number(sampler, DRAW_LIGHT);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    return lamp_point(&scene->lights, &scene->geo, u, out);
}

struct connection lamp_connect(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                               const struct light_point *at, double pdf)
{
    struct lit l = {.value = rgb_black()};
    if (vertex_connectible(z))
        connect_light(scene, z, at, pdf, &l);
    return connect_lit(scene, counts, &l);
}

struct lamp_way lamp_way(const struct scene *scene, vec3 p, const struct light_point *at)
{
    if (light_at_infinity(&scene->lights.light[at->light]))
        return (struct lamp_way){at->w, 1};
    vec3 d = sub(at->p, p);
    return (struct lamp_way){normalize(d), length2(d)};
}

bool lamp_seen(const struct scene *scene, vec3 p, uint64_t prim_id, const struct light_point *at)
{
    return light_at_infinity(&scene->lights.light[at->light]) ? scene_lit_from(scene, p, prim_id, at->w)
                                                              : scene_lit(scene, p, prim_id, at->p, at->prim_id);
}
