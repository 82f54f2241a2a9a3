/* passage.c: see passage.h. */
#include "scene/passage.h"

#include "base/maths.h"

/* Nothing has happened to it yet. */
static struct passage begin(const struct scene *s, const struct ray *ray, vec3 ng, int around)
{
    struct passage p = {rgb_grey(1), {1, 1}, around, 0};
    if (ray->from != 0 && ray->from != WITHIN_MEDIUM) {
        const int *medium = shape_group_of(&s->geo, (int)(ray->from - 1))->medium;
        p.medium = medium[0] == medium[1] ? around : medium[dot(ng, ray->d) > 0];
    }
    return p;
}

/* How far until a walk is scattered. */
static double draw_distance(const struct medium *m, struct sampler *sampler)
{
    const double sigma[3] = {m->sigma_t.r, m->sigma_t.g, m->sigma_t.b};
    double channel = sampler_number(sampler, DRAW_FLIGHT), u = sampler_number(sampler, DRAW_FLIGHT);
    return -m_log1p(-u) / sigma[(int)(3 * channel)]; /* a sampler's numbers are below 1 */
}

static double left_of(double sigma, double d) { return sigma > 0 ? m_exp(-sigma * d) : 1; }

static rgb transmittance(rgb sigma, double d)
{
    return rgb_make(left_of(sigma.r, d), left_of(sigma.g, d), left_of(sigma.b, d));
}

/* The mean of sigma T over that of T, where both may be too small for a double. */
static double scattered_share(rgb sigma, double d)
{
    double least = fmin(sigma.r, fmin(sigma.g, sigma.b));
    rgb T = transmittance(rgb_make(sigma.r - least, sigma.g - least, sigma.b - least), d);
    return rgb_mean(rgb_mul(sigma, T)) / rgb_mean(T);
}

/* A piece of length d within one medium; does the way start within it, or stop? */
static void go(const struct scene *s, double d, bool starts, bool stops, struct passage *p)
{
    const struct medium vacuum = {.material = -1}, *m = p->medium > 0 ? &s->media.medium[p->medium - 1] : &vacuum;
    rgb T = transmittance(m->sigma_t, d);
    double share = starts || stops ? scattered_share(m->sigma_t, d) : 0;
    p->left = rgb_mul(p->left, T);
    p->density[0] *= rgb_mean(T) * (starts ? share : 1);
    p->density[1] *= rgb_mean(T) * (stops ? share : 1);
}

/* Pass an interface; what is left of the ray begins behind it. */
static void cross_interface(const struct scene *s, const struct hit *hit, struct ray *rest, struct passage *p)
{
    struct surface at;
    shape_surface(&s->geo, hit, rest, &at);
    const int *medium = shape_group_of(&s->geo, hit->prim)->medium;
    bool along = dot(rest->d, at.ng) > 0;
    p->strayed += medium[!along] != p->medium;
    p->medium = medium[along];
    *rest = (struct ray){at.p, rest->d, ray_margin(at.p), rest->tmax - hit->t, at.prim_id, rest->to};
}

/* The way along the ray: all of it, or, with a sampler, as far as a walk gets. Returns the distance at which that is
 * scattered; infinity if it is not. */
static double pass(const struct scene *s, struct ray rest, struct sampler *sampler, struct passage *p)
{
    for (double done = 0;;) {
        struct hit hit;
        bool interface = kd_closest(&s->media.interfaces, &s->geo, &rest, &hit);
        double d = interface ? hit.t : rest.tmax, drawn = INFINITY;
        if (sampler != NULL && p->medium > 0)
            drawn = draw_distance(&s->media.medium[p->medium - 1], sampler);
        bool scattered = drawn < d, ends = scattered || !interface;
        go(s, fmin(d, drawn), rest.from == WITHIN_MEDIUM, scattered || (ends && rest.to == WITHIN_MEDIUM), p);
        if (ends)
            return scattered ? done + drawn : INFINITY;
        done += d;
        cross_interface(s, &hit, &rest, p);
    }
}

struct passage medium_pass(const struct scene *s, const struct ray *ray, vec3 ng, int around)
{
    struct passage out = begin(s, ray, ng, around);
    pass(s, *ray, NULL, &out);
    return out;
}

bool medium_fly(const struct scene *s, const struct ray *ray, vec3 ng, int around, struct sampler *sampler, bool meets,
                struct surface *at, struct passage *out)
{
    struct ray way = *ray;
    if (meets) {
        way.tmax = length(sub(at->p, ray->o));
        way.to = at->prim_id;
    }
    *out = begin(s, ray, ng, around);
    double d = pass(s, way, sampler, out);
    if (d == INFINITY)
        return meets;
    const struct medium *m = &s->media.medium[out->medium - 1];
    out->left = rgb_mul(out->left, m->sigma_s);
    *at = (struct surface){.p = add(ray->o, mul(ray->d, d)), .ns = neg(ray->d), .material = m->material,
                           .prim_id = WITHIN_MEDIUM, .light = -1};
    return true;
}
