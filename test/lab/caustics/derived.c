/* derived.c: see derived.h. */
#include "caustics/derived.h"

double light_distance(const struct light_set *set, vec3 p, vec3 w)
{
    return fmax(set->radius - dot(sub(p, set->center), w), 0);
}

static double lens_distance(const struct scene *scene, vec3 p)
{
    return length(sub(p, camera_sample_lens(&scene->camera, p, 0.5, 0.5)));
}

static double edge_length(const struct scene *scene, const struct vertex *a, const struct vertex *b)
{
    bool through_lens = a->kind == VERTEX_LENS && scene->camera.lens_radius > 0;
    if (vertex_at_infinity(scene, a))
        return light_distance(&scene->lights, b->p, a->wo);
    if (b->kind == VERTEX_ESCAPED)
        return light_distance(&scene->lights, through_lens ? scene->camera.position : a->p, neg(b->wo));
    return a->kind == VERTEX_LENS ? lens_distance(scene, b->p) : length(sub(b->p, a->p));
}

double subpath_length(const struct scene *scene, const struct vertex *path, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        sum += edge_length(scene, &path[i - 1], &path[i]);
    return sum;
}

double path_length(const struct scene *scene, const struct joined *j)
{
    if ((j->t > 1 && j->z == NULL) || (j->s > 0 && j->path == NULL))
        return NAN;
    double light = j->s > 1 ? subpath_length(scene, j->path, j->s) : 0;
    if (j->t == 1)
        return light + lens_distance(scene, j->path[j->s - 1].p);
    const struct vertex *eye = j->z + 1 - j->t, *z = j->z;
    if (j->s == 0)
        return subpath_length(scene, eye, j->t - 1) + edge_length(scene, z - 1, z->lamp != NULL ? z->lamp : z);
    return light + subpath_length(scene, eye, j->t) + edge_length(scene, &j->path[j->s - 1], z);
}

vec3 lens_drawn(const struct camera *camera, vec3 p, struct sampler sampler)
{
    double u[2] = {0, 0};
    if (camera->lens_radius > 0)
        sampler_pair(&sampler, DRAW_LENS_POINT, u);
    return camera_sample_lens(camera, p, u[0], u[1]);
}

const char *vertex_material(const struct scene *scene, const struct vertex *v)
{
    return scene->material[shape_group_of(&scene->geo, shape_prim(v->prim_id))->material]->row->name;
}
