/* parse_light.c: light sources, with pbrt-v3's parameters and defaults [pbrt-v3 lights/]. See parse.h. */
#include "parser/parse.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/frame.h"
#include "base/maths.h"

/* A light in the making. */
struct light_item {
    struct light light;
    struct light_frame frame;
    vec3 from, to;     /* in light space */
    double cone, edge; /* degrees */
    double fov;        /* degrees */
    int group;         /* -1: its own */
};

/* "L" or "I" times "scale". Its green may be negative, but not the sum that luminance is. */
static void emitted(struct parser *p, const struct parameter *row, void *field)
{
    struct params *q = &p->params;
    rgb value = rgb_mul(params_rgb(q, row->name, row->fallback), params_rgb(q, "scale", rgb_grey(1)));
    if (!(rgb_luminance(value) >= 0 && rgb_max(value) <= NUMBER_MAX))
        type_error(q, "this light's %s times its scale is (%g %g %g): not a light, from 0 to %g", row->name, value.r,
                   value.g, value.b, NUMBER_MAX);
    *(rgb *)field = value;
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

static void distant_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    item->frame.direction =
        direction(&p->params, transform_vector(&item->frame.to_world, sub(item->from, item->to)));
}

/* The picture of a light, if it names one. */
static void picture(struct parser *p, const struct parameter *row, void *field)
{
    struct params *q = &p->params;
    struct light_set *lights = &p->scene->lights;
    struct light_frame *l = field;
    struct source_position at;
    struct error inner;
    char *path = params_file(q, row->name, &at);
    if (path != NULL && !q->failed) {
        int known = lights->n_pictures;
        const struct image *image = light_read_picture(lights, (enum light_kind)p->type->kind, l, path, &inner);
        uint64_t tables = l->env != NULL ? envmap_bytes(l->env) : 0;
        parse_picture(q, at, image, lights->n_pictures > known, tables, &inner);
    }
    free(path);
}

static void slide_light(struct parser *p, void *object)
{
    struct light_item *item = object;
    struct light_frame *l = &item->frame;
    l->position = transform_point(&l->to_world, vec(0, 0, 0));
    if (item->light.kind != LIGHT_PROJECTION)
        return;
    l->tan_half = m_tan(item->fov * PI / 360);
    l->cos_total = slide_cos_corner(l->slide, l->tan_half);
    if (!(l->cos_total < 1))
        type_error(&p->params, "\"fov\" is %g degrees: a picture without inside", item->fov);
}

/* A name that lights share whose pictures are to be one (light_group); pbrt-v3 warns of it and goes on. */
static void group(struct parser *p, const struct parameter *row, void *field)
{
    enum { LONGEST = 40 };
    static const char FIT[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    struct source_position at;
    const char *name = params_text(&p->params, row->name, PARAM_STRING, &at);
    *(int *)field = -1;
    if (name == NULL)
        return;
    if (name[0] == '\0' || strlen(name) > LONGEST || name[strspn(name, FIT)] != '\0')
        params_fail(&p->params, at, "\"%s\" becomes the name of a file: up to %d letters, digits, - and _", row->name,
                    LONGEST);
    else
        *(int *)field = light_group(&p->scene->lights, name, (enum light_kind)p->type->kind);
}

static void hidden(struct parser *p, const struct parameter *row, void *field)
{
    *(bool *)field = !params_bool(&p->params, row->name, true);
}

#define GROUP(type) {"group", group, offsetof(type, group), GREY(0), 0, 0} /* these two are no parameters of pbrt-v3 */
#define VISIBLE(type, field) {"visible", hidden, offsetof(type, field), GREY(0), 0, 0}
#define EMITTED(name) \
    {name, emitted, offsetof(struct light_item, light.L), GREY(1), 0, 0}, BY_BUILD("scale"), GROUP(struct light_item)
#define PICTURE {"mapname", picture, offsetof(struct light_item, frame), GREY(0), 0, 0}
#define POINT(f, x, y, z) {#f, parse_point, offsetof(struct light_item, f), {x, y, z}, 0, 0}
#define SAMPLES IGNORED("samples"), IGNORED("nsamples") /* how often pbrt-v3 samples a light per hit: no matter here */

static const struct parameter POINT_LIGHT[] = {EMITTED("I"), POINT(from, 0, 0, 0), END_OF_PARAMETERS};
static const struct parameter SPOT_LIGHT[] = {
    EMITTED("I"),
    {"coneangle", parse_number, offsetof(struct light_item, cone), GREY(30), NUMBER_MIN, 180},
    {"conedeltaangle", parse_number, offsetof(struct light_item, edge), GREY(5), AT_LEAST_0},
    POINT(from, 0, 0, 0),
    POINT(to, 0, 0, 1),
    END_OF_PARAMETERS};
static const struct parameter DISTANT_LIGHT[] = {
    EMITTED("L"), POINT(from, 0, 0, 0), POINT(to, 0, 0, 1), END_OF_PARAMETERS};
static const struct parameter INFINITE_LIGHT[] = {
    EMITTED("L"), PICTURE, SAMPLES, VISIBLE(struct light_item, light.hidden), END_OF_PARAMETERS};
static const struct parameter GONIOMETRIC_LIGHT[] = {EMITTED("I"), PICTURE, END_OF_PARAMETERS};
static const struct parameter PROJECTION_LIGHT[] = {
    EMITTED("I"), PICTURE,
    {"fov", parse_number, offsetof(struct light_item, fov), GREY(45), FIELD_OF_VIEW}, END_OF_PARAMETERS};

static const struct object_type LIGHTS[] = {
    {"point", POINT_LIGHT, LIGHT_POINT, point_light},
    {"spot", SPOT_LIGHT, LIGHT_SPOT, spot_light},
    {"distant", DISTANT_LIGHT, LIGHT_DISTANT, distant_light},
    {"infinite", INFINITE_LIGHT, LIGHT_INFINITE, NULL},
    {"exinfinite", INFINITE_LIGHT, LIGHT_INFINITE, NULL},
    {"goniometric", GONIOMETRIC_LIGHT, LIGHT_GONIOMETRIC, slide_light},
    {"projection", PROJECTION_LIGHT, LIGHT_PROJECTION, slide_light},
    END_OF_TYPES};

static bool light(struct parser *p)
{
    struct params *q = &p->params;
    struct light_item item = {.light = {.kind = (enum light_kind)p->type->kind, .prim = -1},
                              .frame.to_world = p->place.ctm};
    if (!parse_placed(p))
        return false;
    parse_fields(p, &item);
    vec3 position = item.frame.position;
    if (!is_place(position))
        type_error(q, "this light would stand at (%g %g %g); places go up to 1e12", position.x, position.y, position.z);
    if (item.light.kind == LIGHT_INFINITE && ++p->n_infinite > LIGHT_MAX_INFINITE)
        type_error(q, "more than %d infinite lights; use fewer", LIGHT_MAX_INFINITE);
    if (!parse_done(p))
        return false;
    struct light_set *set = &p->scene->lights;
    if (item.light.kind == LIGHT_INFINITE && p->n_infinite > 1)
        item.group = p->infinite_group;
    item.light.group = item.group >= 0 ? item.group : light_group(set, NULL, item.light.kind);
    if (item.light.kind == LIGHT_INFINITE)
        p->infinite_group = item.light.group;
    light_add(set, item.light, &item.frame);
    return true;
}

static const struct parameter AREA_LIGHT[] = {
    {"L", emitted, offsetof(struct area_light, L), GREY(1), 0, 0},
    BY_BUILD("scale"),
    {"twosided", parse_bool, offsetof(struct area_light, two_sided), GREY(0), 0, 0},
    VISIBLE(struct area_light, hidden),
    GROUP(struct area_light),
    SAMPLES,
    END_OF_PARAMETERS};

static const struct object_type AREA_LIGHTS[] = {
    {"diffuse", AREA_LIGHT, LIGHT_AREA, NULL}, {"area", AREA_LIGHT, LIGHT_AREA, NULL}, END_OF_TYPES};

static bool area_light(struct parser *p)
{
    p->state.area.on = true;
    return parse_object(p, &p->state.area);
}

const struct directive LIGHT_DIRECTIVES[] = {{"AreaLightSource", IN_WORLD, area_light, AREA_LIGHTS},
                                             {"LightSource", IN_WORLD, light, LIGHTS},
                                             END_OF_DIRECTIVES};
