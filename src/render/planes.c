/* planes.c: what films have beside the picture (scene/tile.h), by an observer: groups of lights, and alpha.
 *
 * Tests: test_lights.c.
 */
#include "render/render.h"

/* Of the steps that the sample's two sums are about to take the light's group has its share. A splat tells the film its
 * group itself. */
static void add_light(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct tile *tile = sample->tile;
    double length = path->c->length;
    (void)context;
    if (path->t == 1 || rgb_is_black(path->c->value))
        return;
    int group = sample->scene->lights.light[joined_light(path)].group;
    if (gate_before(length, tile->gate.end))
        tile_add_light(tile, sample->x, sample->y, group, rgb_add(sample->until, path->added), sample->until);
    if (gate_before(length, tile->gate.begin))
        tile_add_light(tile, sample->x, sample->y, group, sample->before, rgb_add(sample->before, path->added));
}

/* Does the lens see anything there, be it light? */
static bool covered(const struct scene *scene, const struct vertex *eye, int n)
{
    const struct light_set *lights = &scene->lights;
    const struct vertex *z = n > 1 ? &eye[1] : NULL;
    return z != NULL && (z->kind != VERTEX_ESCAPED || (z->lamp != NULL && !lights->light[z->lamp->light].hidden) ||
                         (z->lamp == NULL && lights->seen_infinite));
}

static void add_alpha(void *context, const struct pixel_sample *sample, enum transport mode, const struct vertex *path,
                      int n)
{
    (void)context;
    if (mode == RADIANCE && covered(sample->scene, path, n))
        tile_add_alpha(sample->tile, sample->x, sample->y, sample->filter_weight);
}

struct observer planes_observer(struct planes planes)
{
    struct observer o = {NULL, planes.alpha ? add_alpha : NULL, planes.lights > 0 ? add_light : NULL, NULL, NULL};
    return o;
}
