/* parse_light.c: light sources, with pbrt-v3's parameters and defaults [PBRT3 lights/]. See parse.h. */
#include "parser/parse.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"

/* "L" or "I" times "scale". */
static rgb emitted(struct params *q, const char *name)
{
    rgb value = rgb_mul(params_rgb(q, name, rgb_grey(1)), params_rgb(q, "scale", rgb_grey(1)));
    if (!rgb_is_finite(value) || rgb_luminance(value) < 0)
        params_fail(q, q->place, "this light's %s times its scale is (%g %g %g); a light must not take light away",
                    name, value.r, value.g, value.b);
    if (!(rgb_max(value) <= NUMBER_MAX)) /* its green may be negative, but not the sum that luminance is */
        params_fail(q, q->place, "this light's %s times its scale is (%g %g %g); light goes up to %g here", name, value.r,
                    value.g, value.b, NUMBER_MAX);
    return value;
}

/* How often pbrt-v3 samples a light per hit: no matter here. */
static void ignore_samples(struct params *q)
{
    params_ignore(q, "samples");
    params_ignore(q, "nsamples");
}

bool parse_area_light(struct parser *p, struct area_light *out)
{
    static const char *const KNOWN[] = {"diffuse", "area", NULL};
    static const char *const REFUSED[] = {NULL};
    struct params *q = &p->params;
    if (parse_name(p, KNOWN, REFUSED) < 0)
        return false;
    out->on = true;
    out->L = emitted(q, "L");
    out->two_sided = params_bool(q, "twosided", false);
    ignore_samples(q);
    return params_done(q);
}

/* pbrt-v3 adds "from" after the transform, so that CTM rotations and scales do not act on it. */
static void point_light(struct params *q, struct light *l)
{
    l->kind = LIGHT_POINT;
    l->L = emitted(q, "I");
    l->position = add(params_point(q, "from", vec(0, 0, 0)), transform_point(&l->to_world, vec(0, 0, 0)));
}

/* Unit vector in world space from one point of light space to another; fails where they coincide. */
static vec3 direction(struct params *q, const struct light *l, vec3 from, vec3 to)
{
    vec3 w = normalize(transform_vector(&l->to_world, sub(to, from)));
    if (!(fabs(length2(w) - 1) < 1e-6)) {
        params_fail(q, q->place, "\"from\" and \"to\" give no direction; move them apart");
        return vec(0, 0, 1);
    }
    return w;
}

static void spot_light(struct params *q, struct light *l)
{
    l->kind = LIGHT_SPOT;
    l->L = emitted(q, "I");
    double cone = params_positive(q, "coneangle", 30), delta = params_at_least(q, "conedeltaangle", 5, 0);
    if (cone > 180)
        params_fail(q, q->place, "\"coneangle\" is %g degrees; the whole sphere is 180", cone);
    l->cos_total = cos(cone * PI / 180);
    l->cos_falloff = cos(fmax(cone - delta, 0) * PI / 180);
    if (!(l->cos_total < 1))
        params_fail(q, q->place, "\"coneangle\" is %g degrees: a cone without inside", cone);
    vec3 from = params_point(q, "from", vec(0, 0, 0)), to = params_point(q, "to", vec(0, 0, 1));
    l->position = transform_point(&l->to_world, from);
    l->axis = frame_from_normal(direction(q, l, from, to));
}

static void distant_light(struct params *q, struct light *l)
{
    l->kind = LIGHT_DISTANT;
    l->L = emitted(q, "L");
    vec3 from = params_point(q, "from", vec(0, 0, 0)), to = params_point(q, "to", vec(0, 0, 1));
    l->direction = direction(q, l, to, from);
}

static void infinite_light(struct params *q, struct light *l)
{
    l->kind = LIGHT_INFINITE;
    l->L = emitted(q, "L");
    ignore_samples(q);
    struct place at;
    char *path = params_file(q, "mapname", &at);
    if (path == NULL)
        return;
    struct error inner;
    size_t n = strlen(path);
    if (n > 4 && (strcmp(path + n - 4, ".exr") == 0 || strcmp(path + n - 4, ".EXR") == 0))
        params_fail(q, at, "OpenEXR pictures are not read; convert it to PFM (magick map.exr map.pfm)");
    else if (!q->failed && !light_load_env(l, path, &inner))
        params_fail(q, at, "%s", inner.text);
    else if (!q->failed && l->env->image.replaced > 0)
        place_warn(q->messages, at, "environment", "%ld numbers of this picture are negative or not finite; 0 instead",
                   l->env->image.replaced);
    free(path);
}

bool parse_light(struct parser *p)
{
    static const char *const KNOWN[] = {"point", "spot", "distant", "infinite", "exinfinite", NULL};
    static const char *const REFUSED[] = {"goniometric", "projection", NULL};
    struct params *q = &p->params;
    struct light l = {.to_world = p->state.ctm, .prim = -1};
    switch (parse_name(p, KNOWN, REFUSED)) {
    case 0: point_light(q, &l); break;
    case 1: spot_light(q, &l); break;
    case 2: distant_light(q, &l); break;
    case 3:
    case 4: infinite_light(q, &l); break;
    default: return false;
    }
    if (!is_place(l.position))
        params_fail(q, q->place, "this light would stand at (%g %g %g); places go up to 1e18", l.position.x,
                    l.position.y, l.position.z);
    light_add(&p->scene->lights, l); /* even where it failed: the scene releases its map */
    return params_done(q);
}
