/* medium.c: see medium.h. */
#include "scene/medium.h"

#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/warp.h"
#include "scene/light.h"

int space_add(struct space **space, struct medium m)
{
    struct space *s = *space = *space != NULL ? *space : mem_alloc(1, sizeof *s);
    s->medium = mem_append(s->medium, (size_t)s->n, sizeof *s->medium);
    s->medium[s->n] = m;
    return ++s->n;
}

void space_free(struct space *space)
{
    if (space == NULL)
        return;
    kd_free(&space->interfaces);
    free(space->medium);
    free(space);
}

/* --- what is about the scene --------------------------------------------------------------------------- */

int medium_outermost(const struct space *space, const struct kdtree *surfaces, vec3 lens, int around, double far)
{
    enum { WAYS = 64 };
    int seen = -1, behind = around;
    for (int i = 0; i < WAYS; i++) {
        double u, v;
        struct hit hit;
        struct surface at;
        sampler_r2(i, &u, &v);
        vec3 w = warp_sphere(u, v);
        struct ray inwards = {add(lens, mul(w, far)), neg(w), 0, far, 0, 0};
        bool bounded = kd_closest(&space->interfaces, space->geo, &inwards, &hit);
        if (bounded) {
            shape_surface(space->geo, &hit, &inwards, &at);
            behind = medium_before(space->geo, &at, inwards.d);
            inwards.tmax = hit.t;
        }
        if (!kd_closest(surfaces, space->geo, &inwards, &hit) && !bounded)
            return around;
        shape_surface(space->geo, &hit, &inwards, &at);
        int medium = medium_before(space->geo, &at, inwards.d);
        if (medium >= 0 && (seen < 0 || medium < seen))
            seen = medium;
    }
    return seen >= 0 ? seen : behind;
}

/* --- edges -------------------------------------------------------------------------------------------- */

int medium_towards(const struct space *space, uint64_t prim_id, vec3 ng, vec3 d, int around)
{
    if (prim_id == 0 || prim_id == WITHIN_MEDIUM)
        return around;
    const struct shape_group *group = shape_group_of(space->geo, shape_prim(prim_id));
    return shape_is_interface(group) ? group->medium[dot(ng, d) > 0] : around;
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
static void go(const struct space *space, double d, bool starts, bool stops, struct edge *e)
{
    const struct medium vacuum = {.material = -1}, *m = e->medium > 0 ? &space->medium[e->medium - 1] : &vacuum;
    rgb T = transmittance(m->sigma_t, d);
    double share = starts || stops ? scattered_share(m->sigma_t, d) : 0;
    e->left = rgb_mul(e->left, T);
    e->density[0] *= rgb_mean(T) * (starts ? share : 1);
    e->density[1] *= rgb_mean(T) * (stops ? share : 1);
}

/* Where a line passes an interface. */
struct crossing {
    double t, slack; /* the distance, and that to others that the scene file could not tell from this */
    int medium[2];   /* before it and behind it */
};

static struct crossing crossing_at(const struct space *space, const struct ray *line, const struct hit *hit)
{
    struct surface at;
    shape_surface(space->geo, hit, line, &at);
    double cosine = dot(line->d, at.ng);
    const int *medium = shape_group_of(space->geo, hit->prim)->medium;
    return (struct crossing){hit->t, ray_margin(at.p) / fabs(cosine), {medium[!(cosine > 0)], medium[cosine > 0]}};
}

/* Which of n hits is passed next? Rounding decides on the order of interfaces in one place: of those there the first
 * that belongs to this medium, if any does. The others stay in hit[1] and after. */
static struct crossing next_crossing(const struct space *space, const struct ray *line, struct hit *hit, int n,
                                     int medium)
{
    enum { LOOK_AHEAD = 16 };
    struct crossing next = crossing_at(space, line, hit);
    double last = next.t + next.slack;
    for (int i = 1; next.medium[0] != medium && i < n && i < LOOK_AHEAD && hit[i].t <= last; i++) {
        struct crossing other = crossing_at(space, line, &hit[i]);
        if (other.medium[0] == medium) {
            next = other;
            hit[i] = hit[0];
        }
    }
    return next;
}

/* From where to where on a ray may media be? One without a bound ends on a sphere (medium.h). */
static void extent(const struct space *space, const struct ray *ray, double *begin, double *end)
{
    *begin = 0;
    *end = ray->tmax;
    if (!space->ends)
        return;
    vec3 o = sub(ray->o, space->lights->center);
    double middle = -dot(o, ray->d), half2 = sqr(space->lights->radius) - length2(add(o, mul(ray->d, middle)));
    *begin = fmax(middle - safe_sqrt(half2), 0);
    *end = fmax(fmin(middle + safe_sqrt(half2), ray->tmax), *begin);
}

/* The way along a ray: all of it, or, with a sampler, as far as a walk gets. Returns the distance at which that is
 * scattered; infinity if it is not.
 *
 * A surface may lie in an interface, and rounding then decides on which side of that a ray begins. So about its origin
 * an interface is passed if it belongs to the medium there, and none else. On which side it ends does not matter. */
static double pass(const struct space *space, const struct ray *ray, struct sampler *sampler, struct edge *e)
{
    struct ray line = {ray->o, ray->d, -ray_margin(ray->o), ray->tmax, 0, 0};
    struct hit *hit;
    double done, end, passed = -line.tmin;
    bool starts = ray->from == WITHIN_MEDIUM, more = true, scattered = false;
    extent(space, ray, &done, &end);
    line.tmax = end < INFINITY ? end + ray_margin(add(ray->o, mul(ray->d, end))) : end;
    int i = 0, n = kd_all(&space->interfaces, space->geo, &line, &hit);
    while (more && !scattered) {
        struct crossing x = {end, 0, {e->medium, e->medium}};
        more = i < n && hit[i].t < end;
        if (more)
            x = next_crossing(space, &line, &hit[i], n - i, e->medium);
        i += more;
        bool fits = x.medium[0] == e->medium;
        if (!fits && x.t <= passed)
            continue;
        double d = fmax(fmin(x.t, end) - done, 0), drawn = INFINITY;
        if (sampler != NULL && e->medium > 0)
            drawn = draw_distance(&space->medium[e->medium - 1], sampler);
        scattered = drawn < d;
        go(space, fmin(d, drawn), starts, scattered || (!more && ray->to == WITHIN_MEDIUM), e);
        starts = false;
        done += fmin(d, drawn);
        if (!scattered) {
            e->medium = x.medium[1];
            passed = x.t + x.slack;
        }
    }
    free(hit);
    return scattered ? done : INFINITY;
}

void medium_pass(const struct space *space, const struct ray *ray, int medium, struct edge *out)
{
    out->medium = medium;
    pass(space, ray, NULL, out);
}

bool medium_fly(const struct space *space, const struct ray *ray, int medium, struct sampler *sampler, bool meets,
                struct surface *at, struct edge *out)
{
    struct ray free = *ray;
    if (meets)
        free.tmax = length(sub(at->p, ray->o));
    out->medium = medium;
    double d = pass(space, &free, sampler, out);
    if (d == INFINITY)
        return meets;
    const struct medium *m = &space->medium[out->medium - 1];
    out->left = rgb_mul(out->left, m->sigma_s);
    *at = (struct surface){.p = add(ray->o, mul(ray->d, d)), .ns = neg(ray->d), .material = m->material,
                           .prim_id = WITHIN_MEDIUM, .light = -1};
    return true;
}
