/* planes.c: the planes that films have in addition to the image (scene/tile.h), by an observer:
 * groups of lights, and alpha.
 *
 * Tests: test_lights.c.
 */
#include "render/render.h"

/* The sample's value is about to change by the path's contribution: the plane of the light's group takes that step. A
 * splat tells the film its group itself. */
static void add_light(void *context, const struct sample *sample, const struct joined *path)
{
    (void)context;
    if (path->t == 1 || rgb_is_black(path->c->value))
        return;
    int group = sample->pass->job->scene->lights.light[joined_light(path)].group;
    tile_add_light(sample->pass->tile, sample->x, sample->y, group, rgb_add(sample->value, path->added), sample->value);
}

/* Does the lens see anything there, be it light? */
static bool covered(const struct scene *scene, const struct vertex *eye, int n)
{
    const struct light_set *lights = &scene->lights;
    const struct vertex *z = n > 1 ? &eye[1] : NULL;
    return z != NULL && (z->kind != VERTEX_ESCAPED || (z->lamp != NULL && !lights->light[z->lamp->light].hidden) ||
                         (z->lamp == NULL && light_sky_seen(lights)));
}

static void add_alpha(void *context, const struct sample *sample, enum transport mode, const struct vertex *path,
                      int n)
{
    (void)context;
    if (mode == RADIANCE && covered(sample->pass->job->scene, path, n))
        tile_add_alpha(sample->pass->tile, sample->x, sample->y, sample->filter_weight);
}

struct observer planes_observer(struct planes planes)
{
    return (struct observer){.walked = planes.alpha ? add_alpha : NULL, .joined = planes.lights > 0 ? add_light : NULL};
}
