/* parse_light.c: light sources, with pbrt-v3's parameters and defaults [pbrt-v3 lights/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "base/maths.h"

/* A light in the making. */
struct light_item {
    struct light light;
    struct light_frame frame;
    vec3 from, to;     /* in light space */
    double cone, edge; /* degrees */
    int group;         /* -1: its own */
};

/* "L" or "I" times "scale". Its green may be negative, but not the sum that luminance is. */
static rgb emitted(struct params *q, const char *name)
{
    rgb value = rgb_mul(params_rgb(q, name, rgb_grey(1)), params_rgb(q, "scale", rgb_grey(1)));
    if (!(rgb_luminance(value) >= 0 && rgb_max(value) <= NUMBER_MAX))
        type_error(q, "this light's %s times its scale is (%g %g %g): not a light, from 0 to %g", name, value.r,
                   value.g, value.b, NUMBER_MAX);
    return value;
}

/* pbrt-v3 adds "from" after the transform, so that CTM rotations and scales do not act on it. */
static void point_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    (void)p;
    item->frame.position = add(item->from, transform_point(&item->frame.to_world, vec(0, 0, 0)));
}

/* The unit vector along w, which leads from one point to another; fails where they coincide. */
static vec3 direction(struct params *q, vec3 w)
{
    w = normalize(w);
    if (!(fabs(length2(w) - 1) < 1e-6)) {
        type_error(q, "\"from\" and \"to\" give no direction; move them apart");
        return vec(0, 0, 1);
    }
    return w;
}

static void spot_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    struct light_frame *l = &item->frame;
    struct params *q = &p->params;
    l->cos_total = m_cos(item->cone * PI / 180);
    l->cos_falloff = m_cos((item->cone - item->edge) * PI / 180); /* of an angle below 0 too, as in pbrt-v3 */
    if (!(l->cos_total < 1))
        type_error(q, "\"coneangle\" is %g degrees: a cone without inside", item->cone);
    struct frame beam = frame_from_normal(direction(q, sub(item->to, item->from)));
    struct transform along_z;
    transform_look_at(vec(0, 0, 0), beam.n, beam.s, &along_z);
    along_z = transform_compose(transform_translate(item->from), transform_inverse(along_z));
    l->to_world = transform_compose(l->to_world, along_z);
    l->position = transform_point(&l->to_world, vec(0, 0, 0));
}

static int read_map(struct parser *p, const char *path, struct source_position at, struct error *err)
{
    struct light_set *set = &p->scene->lights;
    int id = light_read_map(set, path, p->named.memory, err);
    return id >= 0 && parse_picture(p, at, &set->map[id]->image, envmap_bytes(set->map[id]), err) ? id : -1;
}

/* The map of a file, or none. */
static void map_of(struct parser *p, struct light_frame *frame)
{
    int map = parse_file(p, "mapname", &p->maps, read_map);
    frame->env = map >= 0 ? p->scene->lights.map[map] : NULL;
}

/* The map's axis is y, so that pbrt-v3 exchanges y and z. */
static void goniometric_light(struct parser *p, void *object)
{
    static const double EXCHANGE[16] = {1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    struct light_item *item = object;
    struct transform from_map = transform_identity();
    map_of(p, &item->frame);
    point_light(p, item);
    transform_from_matrix(EXCHANGE, &from_map);
    item->frame.to_world = transform_compose(item->frame.to_world, from_map);
}

/* The screen is as wide as "fov" on its shorter side, and has the shape of its picture. (pbrt-v3's cone for light that
 * leaves the light does not hold a wide screen; this one does.) */
static void projection_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    struct light_frame *l = &item->frame;
    double sine, cosine;
    map_of(p, l);
    point_light(p, item);
    m_sincos(item->cone * PI / 360, &sine, &cosine);
    double half = sine / cosine, aspect = l->env == NULL ? 1 : (double)l->env->image.width / l->env->image.height;
    l->screen[0] = half * fmax(aspect, 1);
    l->screen[1] = half * fmax(1 / aspect, 1);
    l->cos_total = l->cos_falloff = 1 / sqrt(1 + sqr(l->screen[0]) + sqr(l->screen[1]));
}

static void distant_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    item->frame.direction = direction(&p->params, transform_vector(&item->frame.to_world, sub(item->from, item->to)));
}

static void infinite_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    map_of(p, &item->frame);
    item->light.hidden = !params_bool(&p->params, "visible", true);
}

/* A name that lights share whose pictures are to be one (light_group), or -1; pbrt-v3 warns of it and goes on. */
static int group(struct parser *p)
{
    enum { LONGEST = 40 };
    static const char FIT[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    struct source_position at;
    const char *name = params_text(&p->params, "group", PARAM_STRING, &at);
    if (name == NULL)
        return -1;
    if (name[0] != '\0' && strlen(name) <= LONGEST && name[strspn(name, FIT)] == '\0')
        return light_group(&p->scene->lights, name, (enum light_kind)p->type.kind);
    params_fail(&p->params, at, "\"group\" becomes the name of a file: up to %d letters, digits, - and _", LONGEST);
    return -1;
}

/* "group" and "visible" are no parameters of pbrt-v3; its "samples" is how often it samples a light per hit. */
#define AT(member) offsetof(struct light_item, member)
static const struct field SPOT_LIGHT[] = {
    {"coneangle", FIELD_NUMBER, AT(cone), 30, NUMBER_MIN, .high = 180}, /* these three of a spot alone */
    {"conedeltaangle", FIELD_NUMBER, AT(edge), 5, 0, .high = NUMBER_MAX},
    {"to", FIELD_POINT, AT(to), .fallback = FIELD_KEPT},
    {.name = "I"}, {.name = "scale"}, {.name = "group"}, {"from", .kind = FIELD_POINT, .place = AT(from)},
    {.name = NULL}};
static const struct field PROJECTION_LIGHT[] = {
    {"fov", FIELD_NUMBER, AT(cone), 45, 1e-3, .high = 179.999}, /* of a projection alone */
    {.name = "mapname"}, {.name = "I"}, {.name = "scale"}, {.name = "group"}, {.name = NULL}};
static const struct field DISTANT_LIGHT[] = {
    {.name = "L"}, {.name = "scale"}, {.name = "group"}, {"from", .kind = FIELD_POINT, .place = AT(from)},
    {"to", FIELD_POINT, AT(to), .fallback = FIELD_KEPT}, {.name = NULL}};
static const struct field INFINITE_LIGHT[] = {
    {.name = "L"}, {.name = "scale"}, {.name = "group"}, {.name = "mapname"}, {.name = "visible"},
    {"samples", .kind = FIELD_IGNORED}, {"nsamples", .kind = FIELD_IGNORED}, {.name = NULL}};

static const struct object_type LIGHTS[] = {
    {"point", SPOT_LIGHT + 3, LIGHT_POINT, point_light},
    {"spot", SPOT_LIGHT, LIGHT_SPOT, spot_light},
    {"goniometric", PROJECTION_LIGHT + 1, LIGHT_POINT, goniometric_light},
    {"projection", PROJECTION_LIGHT, LIGHT_SPOT, projection_light},
    {"distant", DISTANT_LIGHT, LIGHT_DISTANT, distant_light},
    {"infinite", INFINITE_LIGHT, LIGHT_INFINITE, infinite_light},
    {"exinfinite", INFINITE_LIGHT, LIGHT_INFINITE, infinite_light}, {.name = NULL}};

/* pbrt-v3 turns directions by the upper left part of any matrix. So does a light at infinity, which has no place. */
static bool is_turned(struct parser *p, struct light_item *item)
{
    const double *last = p->place.ctm.m[3];
    struct transform *t = &item->frame.to_world;
    double part[16] = {[15] = 1};
    for (int i = 0; i < 9; i++)
        part[i / 3 * 4 + i % 3] = p->place.ctm.m[i % 3][i / 3];
    if (!light_at_infinity(&item->light) || (last[0] == 0 && last[1] == 0 && last[2] == 0) ||
        !transform_from_matrix(part, t) || !transform_is_usable(t))
        return false;
    source_warn(&p->messages, p->directive.position, "the last row of the current transform is %g %g %g %g: as in "
                "pbrt-v3, its upper left 3x3 part turns this light", last[0], last[1], last[2], last[3]);
    return true;
}

static bool light(struct parser *p)
{
    struct params *q = &p->params;
    struct light_item item = {.light = {.kind = (enum light_kind)p->type.kind, .prim = -1,
                                        .medium = parse_medium(p, 1)},
                              .frame.to_world = parse_to_world(p, p->place.ctm), .to = {0, 0, 1}};
    if (!is_turned(p, &item) && !parse_placed(p))
        return false;
    parse_fields(p, &item);
    item.light.L = emitted(q, field_find(p->type.fields, "L") != NULL ? "L" : "I");
    item.group = group(p);
    vec3 position = item.frame.position;
    if (!is_place(position))
        type_error(q, "this light would be (%g %g %g) from the camera; places go up to 1e12", position.x, position.y,
                   position.z);
    struct light_set *set = &p->scene->lights;
    bool layer = item.light.kind == LIGHT_INFINITE && set->n_layers > 0;
    if (layer && set->n_layers >= LIGHT_MAX_LAYERS)
        type_error(q, "more than %d infinite lights; use fewer", LIGHT_MAX_LAYERS);
    if (!parse_done(p))
        return false;
    if (light_at_infinity(&item.light)) /* of none, as in pbrt-v3 */
        item.light.medium = 0;
    if (layer)
        item.group = set->light[set->sky].group;
    item.light.group = item.group >= 0 ? item.group : light_group(set, NULL, item.light.kind);
    light_add(set, item.light, &item.frame);
    return true;
}

static void emitter(struct parser *p, void *object)
{
    struct area_light *area = object;
    area->on = true;
    area->L = emitted(&p->params, "L");
    area->hidden = !params_bool(&p->params, "visible", true);
    area->group = group(p);
}

static const struct field AREA_LIGHT[] = {
    {"twosided", .kind = FIELD_SWITCH, .place = offsetof(struct area_light, two_sided)},
    {.name = "L"}, {.name = "scale"}, {.name = "visible"}, {.name = "group"},
    {"samples", .kind = FIELD_IGNORED}, {"nsamples", .kind = FIELD_IGNORED}, {.name = NULL}};

static const struct object_type AREA_LIGHTS[] = {
    {"diffuse", AREA_LIGHT, LIGHT_AREA, emitter}, {"area", AREA_LIGHT, LIGHT_AREA, emitter}, {.name = NULL}};

static bool area_light(struct parser *p) { return parse_object(p, &p->state.area); }

const struct directive LIGHT_DIRECTIVES[] = {{"AreaLightSource", IN_WORLD, area_light, AREA_LIGHTS},
                                             {"LightSource", IN_WORLD, light, LIGHTS}, {.name = NULL}};
