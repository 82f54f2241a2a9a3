/* lamp.c: see lamp.h. */
#include "caustics/lamp.h"

bool lamp_point(const struct light_set *lights, const struct geometry *geo, const double u[3], struct light_point *out)
{
    const struct alias_table *choice = &lights->choice;
    return choice->n > 0 && light_sample_cell(lights, geo, alias_sample(choice, u[0], NULL, NULL), u[1], u[2], out);
}

bool lamp_draw(const struct scene *scene, struct sampler *sampler, struct light_point *out)
{
    double u[3];
    u[0] = sampler_number(sampler, DRAW_LIGHT);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    return lamp_point(&scene->lights, &scene->geo, u, out);
}

struct connection lamp_connect(const struct scene *scene, const struct mis_counts *counts, const struct vertex *z,
                               const struct light_point *at, double pdf)
{
    struct lit l = {.value = rgb_black()};
    if (vertex_connectible(z))
        connect_light(scene, z, at, pdf, &l);
    return connect_lit(scene, counts, &l);
}

struct lamp_way lamp_way(const struct scene *scene, vec3 p, const struct light_point *at)
{
    struct lamp_way way = {.d2 = 1, .parallel = light_at_infinity(&scene->lights.light[at->light])};
    vec3 d = way.parallel ? at->w : sub(at->p, p);
    double distance = length(d);
    way.w = mul(d, 1 / distance);
    way.length = way.parallel ? light_distance(&scene->lights, p, way.w) : distance;
    if (!way.parallel)
        way.d2 = length2(d);
    return way;
}

bool lamp_seen(const struct scene *scene, vec3 p, uint64_t prim_id, const struct light_point *at)
{
    return light_at_infinity(&scene->lights.light[at->light]) ? scene_lit_from(scene, p, prim_id, at->w)
                                                              : scene_lit(scene, p, prim_id, at->p, at->prim_id);
}
