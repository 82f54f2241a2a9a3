/* scene.c: see scene.h. */
#include "scene/scene.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "material/fourier.h"

void scene_init(struct scene *s)
{
    memset(s, 0, sizeof *s);
    s->camera = camera_default();
    filter_default("box", &s->filter);
    s->width = 1280;
    s->height = 720;
    s->crop[1] = s->crop[3] = 1;
    s->film_scale = 1;
}

void scene_free(struct scene *s)
{
    kd_free(&s->kd);
    kd_free(&s->kd_lamps);
    space_free(s->space);
    geometry_free(&s->geo);
    texture_set_free(&s->textures);
    for (int i = 0; i < s->n_materials; i++)
        free(s->material[i]);
    free(s->material);
    for (int i = 0; i < s->n_tables; i++) {
        fourier_free(s->table[i]);
        free(s->table[i]);
    }
    free(s->table);
    arena_free(&s->lobes);
    light_set_free(&s->lights);
    free(s->film_filename);
    free(s->integrator);
    settings_clear(&s->settings);
    while (s->n_files > 0)
        free(s->file[--s->n_files]);
    free(s->file);
    memset(s, 0, sizeof *s);
}

void scene_set_origin(struct scene *s)
{
    struct transform *t = &s->camera.world_to_camera;
    vec3 at = transform_point_back(t, vec(0, 0, 0));
    int power;
    frexp(fmax(fabs(at.x), fmax(fabs(at.y), fabs(at.z))), &power);
    double unit = ldexp(1, power - 20);
    s->origin = vec(unit * floor(at.x / unit + 0.5), unit * floor(at.y / unit + 0.5), unit * floor(at.z / unit + 0.5));
    s->textures.origin = s->origin;
    *t = transform_compose(*t, transform_translate(s->origin));
}

int scene_add_material(struct scene *s, struct material *m)
{
    material_settle(m, s->material);
    s->material = mem_append(s->material, (size_t)s->n_materials, sizeof *s->material);
    s->material[s->n_materials] = m;
    return s->n_materials++;
}

/* --- ready to render --------------------------------------------------------------------------------- */

/* Is the surface there at this hit? Holes are where an alpha texture is exactly 0, as in pbrt-v3. The context is the
 * scene's set of textures. */
static bool opaque_at(const void *context, const struct geometry *geo, const struct hit *hit)
{
    const struct texture_set *textures = context;
    const struct shape_group *group = shape_group_of(geo, hit->prim);
    const struct ray anywhere = {vec(0, 0, 0), vec(0, 0, 1), 0, INFINITY, 0, 0};
    struct surface at;
    shape_surface(geo, hit, &anywhere, &at);
    return texture_float(textures, group->alpha, &at) != 0;
}

/* Widen *lo and *hi to the bounds of a tree. */
static void widen(const struct kdtree *kd, vec3 *lo, vec3 *hi)
{
    if (kd->n_nodes == 0)
        return;
    *lo = vec(fmin(lo->x, (double)kd->lo[0]), fmin(lo->y, (double)kd->lo[1]), fmin(lo->z, (double)kd->lo[2]));
    *hi = vec(fmax(hi->x, (double)kd->hi[0]), fmax(hi->y, (double)kd->hi[1]), fmax(hi->z, (double)kd->hi[2]));
}

void scene_bounds(const struct scene *s, vec3 *lo, vec3 *hi)
{
    *lo = *hi = vec(0, 0, 0);
    if (geometry_primitives(&s->geo) == 0)
        return;
    *lo = vec(INFINITY, INFINITY, INFINITY);
    *hi = neg(*lo);
    widen(&s->kd, lo, hi);
    widen(&s->kd_lamps, lo, hi);
    if (s->space != NULL)
        widen(&s->space->interfaces, lo, hi);
}

void scene_resize(struct scene *s, int width, int height)
{
    s->height = height > 0 ? height : int_within((double)width * s->height / s->width + 0.5, 1, 1 << 30);
    s->width = width;
}

/* The tree of its interfaces. Does what is about the scene end on the scene's sphere? That then reaches as far as the
 * lens. */
static void settle_space(struct scene *s, vec3 *lo, vec3 *hi)
{
    struct space *space = s->space;
    space->geo = &s->geo;
    space->lights = &s->lights;
    kd_build(&space->interfaces, &s->geo, KD_INTERFACES);
    scene_bounds(s, lo, hi);
    const vec3 lens = s->camera.position;
    double far = 2 * (length(sub(*hi, *lo)) + length(sub(lens, *lo)));
    space->outer = medium_outermost(space, &s->kd, lens, s->camera.medium, far);
    for (int i = 0; space->outer > 0 && i < s->lights.n; i++)
        if (light_at_infinity(&s->lights.light[i])) {
            s->lights.light[i].medium = space->outer;
            space->ends = true;
        }
    if (space->ends) {
        *lo = vec(fmin(lo->x, lens.x), fmin(lo->y, lens.y), fmin(lo->z, lens.z));
        *hi = vec(fmax(hi->x, lens.x), fmax(hi->y, lens.y), fmax(hi->z, lens.z));
    }
}

void scene_prepare(struct scene *s)
{
    s->geo.opaque = opaque_at;
    s->geo.opaque_context = &s->textures;
    for (int i = 0; i < s->n_materials; i++)
        material_prepare(s->material, i, &s->textures, &s->lobes);
    for (struct shape_group *g = s->geo.group; g < s->geo.group + s->geo.n_groups; g++) {
        g->skip_partials = g->material < 0 || !s->material[g->material]->reads_partials;
        g->skip_uv = g->skip_partials && g->alpha < 0 &&
                     (g->material < 0 || !s->material[g->material]->reads_uv);
    }
    kd_build(&s->kd, &s->geo, KD_SURFACES);
    kd_build(&s->kd_lamps, &s->geo, KD_LAMPS);
    camera_prepare(&s->camera, s->width, s->height);
    vec3 lo, hi;
    scene_bounds(s, &lo, &hi);
    if (s->space != NULL)
        settle_space(s, &lo, &hi);
    double radius = length(sub(hi, lo)) / 2;
    light_prepare(&s->lights, &s->geo, lerp3(0.5, lo, hi), radius > 0 ? radius : 1);
    filter_prepare(&s->filter);
}

struct scene *scene_uniform(const struct scene *s)
{
    struct scene *copy = mem_alloc(1, sizeof *copy);
    *copy = *s;
    light_uniform(&s->lights, &copy->lights);
    return copy;
}

void scene_uniform_free(struct scene *s)
{
    if (s != NULL)
        light_uniform_free(&s->lights);
    free(s);
}

bool scene_intersect(const struct scene *s, const struct ray *ray, struct surface *out)
{
    struct hit hit;
    if (!kd_closest(&s->kd, &s->geo, ray, &hit))
        return false;
    shape_surface(&s->geo, &hit, ray, out);
    return true;
}

bool scene_lamp(const struct scene *s, const struct ray *ray, bool from_lens, const struct surface *end,
                struct surface *out)
{
    struct hit hit;
    if (s->kd_lamps.n_nodes == 0)
        return false;
    struct ray before = *ray;
    if (end != NULL)
        before.tmax = length(sub(end->p, ray->o)) +
                      end_margin(end->p, end->prim_id) / fmax(abs_dot(end->ng, ray->d), 1.0 / GRAZING);
    while (kd_closest(&s->kd_lamps, &s->geo, &before, &hit)) {
        shape_surface(&s->geo, &hit, &before, out);
        if (!from_lens || !s->lights.light[out->light].hidden)
            return true;
        before = (struct ray){out->p, ray->d, ray_margin(out->p), before.tmax - hit.t, out->prim_id, 0};
    }
    return false;
}

bool scene_lamp_stops(const struct scene *s, const struct ray *ray, const struct surface *end)
{
    double distance = length(sub(end->p, ray->o)), margin = start_margin(ray);
    if (ray->tmin < 0 && distance < GRAZING * margin &&
        (distance <= margin || distance * abs_dot(end->ng, ray->d) <= margin))
        return true;
    if (s->kd_lamps.n_nodes == 0)
        return false;
    struct ray before = *ray;
    before.tmax = distance - end_margin(end->p, end->prim_id);
    before.to = end->prim_id;
    return kd_occluded(&s->kd_lamps, &s->geo, &before, INFINITY);
}

bool scene_edge(const struct scene *s, struct ray *ray, int medium, bool emitted, struct edge *out)
{
    const double length = ray->tmax;
    double margin = length < INFINITY ? end_margin(add(ray->o, mul(ray->d, length)), ray->to) : 0;
    double end = length - margin;
    ray->tmin = end_margin(ray->o, ray->from);
    if (ray->tmin < end) {
        bool on_light = emitted && ray->to != 0;
        double light = on_light ? end : INFINITY;
        ray->tmax = on_light ? length + GRAZING * margin : end;
        if (kd_occluded(&s->kd, &s->geo, ray, light) ||
            (emitted && s->kd_lamps.n_nodes > 0 && kd_occluded(&s->kd_lamps, &s->geo, ray, light)))
            return false;
        ray->tmax = length;
    }
    scene_pass(s, ray, medium, out);
    return true;
}
