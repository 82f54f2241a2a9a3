/* scene.c: see scene.h. */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

#include "mem.h"

void scene_init(struct scene *s)
{
    memset(s, 0, sizeof *s);
    s->camera = camera_default();
    filter_default("box", &s->filter);
    s->width = 640;
    s->height = 480;
    s->crop[1] = s->crop[3] = 1;
    s->film_scale = 1;
}

void scene_free(struct scene *s)
{
    kd_free(&s->kd);
    geometry_free(&s->geo);
    texture_set_free(&s->textures);
    free(s->material);
    light_set_free(&s->lights);
    free(s->film_filename);
    free(s->integrator);
    settings_clear(&s->settings);
    memset(s, 0, sizeof *s);
}

int scene_add_material(struct scene *s, struct material m)
{
    s->material = mem_grow(s->material, &s->material_capacity, (size_t)s->n_materials + 1, sizeof *s->material);
    s->material[s->n_materials] = m;
    return s->n_materials++;
}
