/* light.c: see light.h. Intensities and fall-offs are those of [PBRT3 12]. */
#include "scene/light.h"

#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/warp.h"

const char *const LIGHT_KINDS[] = {
    [LIGHT_AREA] = "area", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot", [LIGHT_DISTANT] = "distant",
    [LIGHT_INFINITE] = "infinite"};

int light_add(struct light_set *set, struct light l, const struct light_frame *frame)
{
    l.frame = NULL;
    if (frame != NULL) {
        l.frame = mem_alloc(1, sizeof *l.frame);
        *l.frame = *frame;
        l.frame->volume = fabs(transform_determinant(&frame->to_world));
    }
    if (l.kind == LIGHT_INFINITE) {
        set->layer = mem_append(set->layer, (size_t)set->n_layers, sizeof *set->layer);
        set->layer[set->n_layers++] = l;
        if (set->n_layers > 1)
            return set->sky;
        set->sky = set->n;
        l.frame = NULL;
    }
    set->light = mem_append(set->light, (size_t)set->n, sizeof *set->light);
    set->light[set->n] = l;
    return set->n++;
}

int light_group(struct light_set *set, const char *name, enum light_kind kind)
{
    for (int i = 0; name != NULL && i < set->n_groups && i < LIGHT_MAX_GROUPS; i++)
        if (set->group[i].name != NULL && strcmp(set->group[i].name, name) == 0)
            return i;
    const struct light_group added = {name != NULL ? mem_copy_text(name) : NULL, kind};
    set->group = mem_append(set->group, (size_t)set->n_groups, sizeof *set->group);
    set->group[set->n_groups] = added;
    return set->n_groups++;
}

int light_read_map(struct light_set *set, const char *path, const struct budget *memory, struct error *err)
{
    struct envmap *added = envmap_load(path, memory, err);
    if (added == NULL)
        return -1;
    set->map = mem_append(set->map, (size_t)set->n_maps, sizeof *set->map);
    set->map[set->n_maps] = added;
    return set->n_maps++;
}

void light_set_free(struct light_set *set)
{
    for (int i = 0; i < set->n_groups; i++)
        free(set->group[i].name);
    free(set->group);
    for (int i = 0; i < set->n_maps; i++)
        envmap_free(set->map[i]);
    free(set->map);
    for (int i = 0; i < set->n; i++)
        free(set->light[i].frame);
    for (int i = 0; i < set->n_layers; i++)
        free(set->layer[i].frame);
    free(set->light);
    free(set->layer);
    envmap_free(set->sum);
    alias_free(&set->choice);
    free(set->cell);
    free(set->before);
    memset(set, 0, sizeof *set);
}

/* --- power and choice -------------------------------------------------------------------------------- */

static vec3 to_light_space(const struct light *l, vec3 w)
{
    return normalize(transform_vector_back(&l->frame->to_world, w));
}

/* Steradians of light space per steradian of the world, around the direction that is v in light space, and there as
 * long as 1 is in the world: a thin cone of length 1 and solid angle x has the volume x / 3, its image x' |v|^3 / 3. */
static double solid_angle_back(const struct light *l, vec3 v)
{
    double size = length(v);
    return 1 / (l->frame->volume * size * size * size);
}

/* Smooth step from 1 inside the inner cone to 0 outside the outer one. [PBRT3 12.3.1] */
static double spot_falloff(const struct light *l, vec3 w)
{
    vec3 v = transform_vector_back(&l->frame->to_world, w);
    double c = v.z / length(v);
    if (c < l->frame->cos_total)
        return 0;
    if (c >= l->frame->cos_falloff)
        return 1;
    double delta = (c - l->frame->cos_total) / (l->frame->cos_falloff - l->frame->cos_total);
    return sqr(sqr(delta));
}

/* The share of its intensity that a point or spot sends in direction w. [PBRT3 12.3.2] [PBRT3 12.3.3] */
static rgb share_along(const struct light *l, vec3 w)
{
    const struct light_frame *f = l->frame;
    if (l->kind == LIGHT_POINT)
        return f->env == NULL ? rgb_grey(1) : envmap_lookup(f->env, to_light_space(l, w));
    if (f->screen[0] == 0)
        return rgb_grey(spot_falloff(l, w));
    vec3 v = transform_vector_back(&f->to_world, w);
    double x = v.x / (v.z * f->screen[0]), y = v.y / (v.z * f->screen[1]);
    if (!(v.z > 0 && fabs(x) <= 1 && fabs(y) <= 1))
        return rgb_black();
    return f->env == NULL ? rgb_grey(1) : envmap_picture(f->env, (x + 1) / 2, (y + 1) / 2);
}

/* Powers are those of [PBRT3 12.1-12.6]; of lights at infinity, what meets the disk of the scene's sphere, of the sky
 * from all directions of a half space: pi times pbrt's. */
static double light_power(const struct light *l, const struct geometry *geo, double scene_radius)
{
    double disk = PI * sqr(scene_radius);
    const struct envmap *map = l->frame != NULL ? l->frame->env : NULL;
    double lum = rgb_worth(map != NULL ? rgb_mul(l->L, map->mean) : l->L);
    switch (l->kind) {
    case LIGHT_AREA: return lum * PI * shape_area(geo, l->prim) * (l->two_sided ? 2 : 1);
    case LIGHT_POINT: return lum * 4 * PI;
    case LIGHT_SPOT: return lum * 2 * PI * (1 - 0.5 * (l->frame->cos_falloff + l->frame->cos_total));
    case LIGHT_DISTANT: return lum * disk;
    case LIGHT_INFINITE: return disk * PI * lum;
    }
    return 0;
}

/* A sky of one constant layer is cut into SKY_BANDS x SKY_SECTORS cells of equal solid angle, by z and by azimuth. */
enum { SKY_BANDS = 8, SKY_SECTORS = 16 };

/* The map by which directions of the sky are drawn, in the light space of its only layer or, of several, of the world;
 * NULL: uniformly. */
static const struct envmap *sky_map(const struct light_set *set)
{
    return set->n_layers > 1 ? set->sum : set->layer[0].frame->env;
}

static int sky_cells(const struct light_set *set)
{
    return set->n_layers == 0 ? 0 : sky_map(set) != NULL ? envmap_blocks(sky_map(set)) : SKY_BANDS * SKY_SECTORS;
}

/* The map of several layers: the luminance of their sum, with a little everywhere. It is coarser than their pictures
 * where there are so many that making it would take LOOKUPS (seconds). */
static struct envmap *sum_of_layers(const struct light_set *set)
{
    enum { LOOKUPS = 1 << 26 };
    int width = 64, height = 32;
    double mean = 0;
    for (int i = 0; i < set->n_layers; i++) {
        const struct envmap *env = set->layer[i].frame->env;
        width = env != NULL && env->image.width > width ? env->image.width : width;
        height = env != NULL && env->image.height > height ? env->image.height : height;
    }
    for (; (double)width * height * set->n_layers > LOOKUPS && width > 1; width = (width + 1) / 2)
        height = (height + 1) / 2;
    double *luminance = mem_alloc((size_t)width * (size_t)height, sizeof *luminance);
    for (int i = 0; i < width * height; i++) {
        vec3 w = envmap_direction((i % width + 0.5) / width, (i / width + 0.5) / height);
        luminance[i] = rgb_worth(light_Le_sky(set, w, false));
        mean += luminance[i] / width / height;
    }
    for (int i = 0; i < width * height; i++)
        luminance[i] += 0.01 * mean;
    struct envmap *sum = envmap_of(luminance, width, height);
    free(luminance);
    return sum;
}

/* What a light is chosen in proportion to. The sky is as many lights as it has layers; what emits nothing is none. */
static double weight_of(const struct light_set *set, int light)
{
    const struct light *l = &set->light[light];
    return !set->uniform ? l->power : l->power > 0 ? (l->kind == LIGHT_INFINITE ? set->n_layers : 1) : 0;
}

/* Make the cells: all lights except the sky are divided into cells of equal numbers. The sky's own cells follow.
 *   weight  out, [LIGHT_CELLS] */
static void make_cells(struct light_set *set, double *weight)
{
    int lamps = set->n - (set->n_layers > 0), each = (lamps + LAMP_CELLS - 1) / LAMP_CELLS, sky = sky_cells(set);
    set->cell = mem_alloc(LIGHT_CELLS, sizeof *set->cell);
    set->before = mem_alloc((size_t)set->n, sizeof *set->before);
    set->n_cells = 0;
    for (int i = 0; i < set->n; i++) {
        struct light *l = &set->light[i];
        if (l->kind == LIGHT_INFINITE)
            continue;
        int c = set->n_cells - 1;
        if (c < 0 || set->cell[c].n == each || set->cell[c].light + set->cell[c].n != i)
            set->cell[c = set->n_cells++] = (struct light_cell){i, 0};
        l->cell = c;
        set->cell[l->cell].n++;
        set->before[i] = weight[l->cell];
        weight[l->cell] += weight_of(set, i);
    }
    if (sky > 0)
        set->light[set->sky].cell = set->n_cells;
    double all = 0;
    for (int c = 0; c < sky && sky_map(set) != NULL; c++)
        all += sky_map(set)->block[c].total;
    for (int c = 0; c < sky; c++) {
        double share = sky_map(set) == NULL ? 1.0 / sky : all > 0 ? sky_map(set)->block[c].total / all : 0;
        weight[set->n_cells] = weight_of(set, set->sky) * share;
        set->cell[set->n_cells++] = (struct light_cell){set->sky, 1};
    }
}

static void build_choice(struct light_set *set)
{
    double *weight = mem_alloc(LIGHT_CELLS, sizeof *weight);
    make_cells(set, weight);
    alias_build(&set->choice, weight, set->n_cells);
    free(weight);
}

void light_prepare(struct light_set *set, const struct geometry *geo, vec3 center, double radius)
{
    set->center = center;
    set->radius = radius;
    if (set->n_layers > 1)
        set->sum = sum_of_layers(set);
    for (int i = 0; i < set->n; i++)
        set->light[i].power = set->light[i].kind == LIGHT_INFINITE ? 0 : light_power(&set->light[i], geo, radius);
    for (int i = 0; i < set->n_layers; i++)
        set->light[set->sky].power += light_power(&set->layer[i], geo, radius);
    build_choice(set);
}

void light_uniform(const struct light_set *set, struct light_set *out)
{
    *out = *set;
    out->uniform = true;
    out->choice = (struct alias_table){.n = 0};
    build_choice(out);
}

void light_uniform_free(struct light_set *set)
{
    free(set->cell);
    free(set->before);
    alias_free(&set->choice);
}

/* --- the end point y0 -------------------------------------------------------------------------------- */

/* The probability of a light in its cell. */
static double share_of(const struct light_set *set, int light)
{
    const struct light_cell *c = &set->cell[set->light[light].cell];
    int last = c->light + c->n - 1;
    double all = set->before[last] + weight_of(set, last);
    return c->n == 1 ? 1 : all > 0 ? weight_of(set, light) / all : 0;
}

/* Draw a light of a cell with the uniform number u. */
static int light_of(const struct light_set *set, int cell, double u)
{
    const struct light_cell *c = &set->cell[cell];
    int last = c->light + c->n - 1;
    double all = set->before[last] + weight_of(set, last);
    int i = c->n == 1 ? last : c->light + cumulative_find(&set->before[c->light], c->n, u * all);
    while (i > c->light && set->light[i].power == 0)
        i--;
    return i;
}

static vec3 sky_sample(const struct light_set *set, int cell, double u1, double u2, double *pdf_dir)
{
    const struct light *l = &set->layer[0];
    if (sky_map(set) == NULL) {
        *pdf_dir = warp_sphere_pdf_w() * SKY_BANDS * SKY_SECTORS;
        return warp_sphere((cell / SKY_SECTORS + u1) / SKY_BANDS, (cell % SKY_SECTORS + u2) / SKY_SECTORS);
    }
    vec3 w = envmap_sample(sky_map(set), cell, u1, u2, pdf_dir);
    if (set->n_layers > 1)
        return w;
    w = normalize(transform_vector(&l->frame->to_world, w));
    *pdf_dir *= solid_angle_back(l, transform_vector_back(&l->frame->to_world, w));
    return w;
}

/* Density of w within its cell; *cell is that cell's number within the sky. */
static double sky_pdf(const struct light_set *set, vec3 w, int *cell)
{
    const struct light *l = &set->layer[0];
    if (set->n_layers > 1)
        return envmap_pdf(set->sum, w, cell);
    if (l->frame->env != NULL) {
        vec3 v = transform_vector_back(&l->frame->to_world, w);
        return envmap_pdf(l->frame->env, normalize(v), cell) * solid_angle_back(l, v);
    }
    double u1, u2;
    warp_sphere_inverse(w, &u1, &u2);
    int band = int_within(u1 * SKY_BANDS, 0, SKY_BANDS - 1), sector = int_within(u2 * SKY_SECTORS, 0, SKY_SECTORS - 1);
    *cell = band * SKY_SECTORS + sector;
    return warp_sphere_pdf_w() * SKY_BANDS * SKY_SECTORS;
}

bool light_sample_cell(const struct light_set *set, const struct geometry *geo, int cell, const double u[3],
                       struct light_point *out)
{
    double pdf = 1;
    memset(out, 0, sizeof *out);
    out->cell = cell;
    out->light = light_of(set, cell, u[0]);
    const struct light *l = &set->light[out->light];
    switch (l->kind) {
    case LIGHT_AREA: {
        struct surface at;
        if (!shape_sample(geo, l->prim, u[1], u[2], &at, &pdf))
            return false;
        out->p = at.p;
        out->n = at.ng;
        out->prim_id = shape_prim_id(l->prim, 0);
        break;
    }
    case LIGHT_POINT:
    case LIGHT_SPOT: out->p = l->frame->position; break;
    case LIGHT_DISTANT: out->w = l->frame->direction; break;
    case LIGHT_INFINITE: out->w = sky_sample(set, cell - l->cell, u[1], u[2], &pdf); break;
    }
    out->pdf_cell = share_of(set, out->light) * pdf;
    out->pdf = alias_pmf(&set->choice, cell) * out->pdf_cell;
    return pdf > 0;
}

/* --- emission ---------------------------------------------------------------------------------------- */

static rgb area_Le(const struct light *l, vec3 n, vec3 w)
{
    return l->two_sided || dot(n, w) > 0 ? l->L : rgb_black();
}

/* Parallel rays enter through a disk as wide as the scene, placed before it. [PBRT3 16.1.2] */
static struct ray ray_from_infinity(const struct light_set *set, vec3 towards_light, const double u[2])
{
    double x, y;
    warp_disk(u[0], u[1], &x, &y);
    struct frame f = frame_from_normal(towards_light);
    vec3 o = add(set->center, mul(to_world(&f, vec(x, y, 1)), set->radius));
    return (struct ray){o, neg(towards_light), 0, INFINITY, 0, 0};
}

rgb light_sample_emission(const struct light_set *set, const struct light_point *y0, const double u[2],
                          struct ray *ray, double *pdf)
{
    const struct light *l = &set->light[y0->light];
    vec3 w = vec(0, 0, 1);
    double cosine = 1;
    switch (l->kind) {
    case LIGHT_AREA: {
        double u1 = u[0], side = 1;
        if (l->two_sided) {
            side = u1 < 0.5 ? 1 : -1;
            u1 = u1 < 0.5 ? 2 * u1 : 2 * u1 - 1;
        }
        struct frame f = frame_from_normal(mul(y0->n, side));
        vec3 local = warp_cos_hemisphere(u1, u[1]);
        cosine = local.z;
        w = to_world(&f, local);
        break;
    }
    case LIGHT_POINT: w = warp_sphere(u[0], u[1]); break;
    case LIGHT_SPOT:
        w = normalize(transform_vector(&l->frame->to_world, warp_cone(u[0], u[1], l->frame->cos_total)));
        break;
    case LIGHT_DISTANT:
    case LIGHT_INFINITE:
        *ray = ray_from_infinity(set, y0->w, u);
        *pdf = light_pdf_emission(set, y0, ray->d);
        return light_Le(set, y0, ray->d);
    }
    *ray = (struct ray){y0->p, w, 0, INFINITY, y0->prim_id, 0};
    *pdf = light_pdf_emission(set, y0, w);
    return *pdf > 0 ? rgb_scale(light_Le(set, y0, w), cosine) : rgb_black();
}

/* Uniform in a cone of light space. */
static double cone_pdf(const struct light *l, vec3 w)
{
    vec3 v = transform_vector_back(&l->frame->to_world, w);
    return v.z >= l->frame->cos_total * length(v) ? warp_cone_pdf_w(l->frame->cos_total) * solid_angle_back(l, v) : 0;
}

double light_pdf_emission(const struct light_set *set, const struct light_point *y0, vec3 w)
{
    const struct light *l = &set->light[y0->light];
    switch (l->kind) {
    case LIGHT_AREA: {
        double c = dot(y0->n, w);
        return l->two_sided ? 0.5 * warp_cos_hemisphere_pdf_w(fabs(c)) : warp_cos_hemisphere_pdf_w(c);
    }
    case LIGHT_POINT: return warp_sphere_pdf_w();
    case LIGHT_SPOT: return cone_pdf(l, w);
    case LIGHT_DISTANT:
    case LIGHT_INFINITE: return 1 / (PI * sqr(set->radius));
    }
    return 0;
}

void light_emission_numbers(const struct light_set *set, const struct light_point *y0, vec3 p, vec3 w, double u[2])
{
    const struct light *l = &set->light[y0->light];
    switch (l->kind) {
    case LIGHT_AREA: {
        bool back = l->two_sided && dot(y0->n, w) < 0;
        struct frame f = frame_from_normal(mul(y0->n, back ? -1 : 1));
        vec3 local = to_local(&f, w);
        warp_disk_inverse(local.x, local.y, &u[0], &u[1]);
        if (l->two_sided)
            u[0] = (u[0] + back) / 2;
        return;
    }
    case LIGHT_POINT: warp_sphere_inverse(w, &u[0], &u[1]); return;
    case LIGHT_SPOT: warp_cone_inverse(to_light_space(l, w), l->frame->cos_total, &u[0], &u[1]); return;
    case LIGHT_DISTANT:
    case LIGHT_INFINITE: {
        struct frame f = frame_from_normal(y0->w);
        vec3 local = to_local(&f, mul(sub(p, set->center), 1 / set->radius));
        warp_disk_inverse(local.x, local.y, &u[0], &u[1]);
        return;
    }
    }
}

rgb light_Le(const struct light_set *set, const struct light_point *y0, vec3 w)
{
    const struct light *l = &set->light[y0->light];
    switch (l->kind) {
    case LIGHT_AREA: return area_Le(l, y0->n, w);
    case LIGHT_POINT:
    case LIGHT_SPOT: return rgb_mul(l->L, share_along(l, w));
    case LIGHT_DISTANT: return l->L;
    case LIGHT_INFINITE: return light_Le_sky(set, neg(w), false);
    }
    return rgb_black();
}

/* --- lights met by eye sub-paths --------------------------------------------------------------------- */

double light_pdf_surface(const struct light_set *set, const struct geometry *geo, const struct surface *at)
{
    if (at->light < 0)
        return 0;
    const struct light *l = &set->light[at->light];
    return alias_pmf(&set->choice, l->cell) * share_of(set, at->light) * shape_pdf_a(geo, l->prim, at);
}

static rgb layer_Le(const struct light *l, vec3 w)
{
    return l->frame->env == NULL ? l->L : rgb_mul(l->L, envmap_lookup(l->frame->env, to_light_space(l, w)));
}

rgb light_Le_sky(const struct light_set *set, vec3 w, bool seen)
{
    rgb sum = rgb_black();
    for (const struct light *l = set->layer; l < set->layer + set->n_layers; l++)
        if (!(seen && l->hidden))
            sum = rgb_add(sum, layer_Le(l, w));
    return sum;
}

double light_pdf_sky(const struct light_set *set, vec3 w, int *cell)
{
    *cell = -1;
    if (set->n_layers == 0)
        return 0;
    double pdf = sky_pdf(set, w, cell);
    *cell += set->light[set->sky].cell;
    return alias_pmf(&set->choice, *cell) * pdf;
}
