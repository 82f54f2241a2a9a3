/* passage.c: see passage.h. */
#include "scene/passage.h"

#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/warp.h"

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

/* Where a line passes an interface. */
struct crossing {
    double t, slack; /* the distance, and that to others that the scene file could not tell from this */
    int medium[2];   /* before it and behind it */
};

static struct crossing crossing_at(const struct scene *s, const struct ray *line, const struct hit *hit)
{
    struct surface at;
    shape_surface(&s->geo, hit, line, &at);
    double cosine = dot(line->d, at.ng);
    const int *medium = shape_group_of(&s->geo, hit->prim)->medium;
    return (struct crossing){hit->t, ray_margin(at.p) / fabs(cosine), {medium[!(cosine > 0)], medium[cosine > 0]}};
}

/* Which of n hits is passed next? Rounding decides on the order of interfaces in one place, so of those there one that
 * belongs to the medium before them comes first: it changes places with *hit. */
static struct crossing next_crossing(const struct scene *s, const struct ray *line, struct hit *hit, int n, int medium)
{
    enum { LOOK_AHEAD = 16 };
    struct crossing next = crossing_at(s, line, hit);
    for (int i = 1; next.medium[0] != medium && i < n && i < LOOK_AHEAD && hit[i].t <= next.t + next.slack; i++) {
        struct crossing other = crossing_at(s, line, &hit[i]);
        if (other.medium[0] == medium) {
            struct hit first = hit[0];
            hit[0] = hit[i];
            hit[i] = first;
            return other;
        }
    }
    return next;
}

/* From where to where on a ray may media be? One without a bound ends on a sphere (medium.h). */
static void extent(const struct scene *s, const struct ray *ray, double *begin, double *end)
{
    *begin = 0;
    *end = ray->tmax;
    if (!s->media.ends)
        return;
    vec3 o = sub(ray->o, s->lights.center);
    double middle = -dot(o, ray->d), half2 = sqr(s->lights.radius) - length2(add(o, mul(ray->d, middle)));
    *begin = fmax(middle - safe_sqrt(half2), 0);
    *end = fmax(fmin(middle + safe_sqrt(half2), ray->tmax), *begin);
}

/* What a ray passes before the next interface, or its end. */
struct piece {
    double end;
    int medium;
};

/* The pieces of a ray that begins in this medium and ends at `end`; of its hits some may lie beyond. Returns how many,
 * n + 1 at most.
 *
 * A surface may lie in an interface, and rounding then decides on which side of that a ray begins. So about its origin
 * an interface is passed if it belongs to the medium there, and none else. On which side it ends does not matter.
 *   wanted  the medium at the end, or -1: that is not known */
static int cut(const struct scene *s, const struct ray *line, double end, struct hit *hit, int n, int medium, int wanted,
               struct piece *out, bool *strayed)
{
    double passed = -line->tmin;
    int pieces = 0, i = 0;
    for (; i < n && hit[i].t < end; i++) {
        struct crossing x = next_crossing(s, line, &hit[i], n - i, medium);
        bool fits = x.medium[0] == medium;
        if (!fits && x.t <= passed)
            continue;
        out[pieces++] = (struct piece){x.t, medium};
        *strayed |= !fits;
        medium = x.medium[1];
        passed = x.t + x.slack;
    }
    out[pieces++] = (struct piece){end, medium};
    *strayed |= i == n && wanted >= 0 && medium != wanted;
    return pieces;
}

/* The way along a ray: all of it, or, with a sampler, as far as a walk gets. Returns the distance at which that is
 * scattered; infinity if it is not. */
static double pass(const struct scene *s, const struct ray *ray, struct sampler *sampler, int wanted, struct passage *p)
{
    enum { FEW = 8 };
    struct ray line = {ray->o, ray->d, -ray_margin(ray->o), ray->tmax, 0, 0};
    struct piece few[FEW], *piece = few;
    struct hit *hit;
    double done, end, scattered = INFINITY;
    extent(s, ray, &done, &end);
    line.tmax = end < INFINITY ? end + ray_margin(add(ray->o, mul(ray->d, end))) : end;
    int n = kd_all(&s->media.interfaces, &s->geo, &line, &hit);
    if (n >= FEW)
        piece = mem_alloc((size_t)n + 1, sizeof *piece);
    n = cut(s, &line, end, hit, n, p->medium, wanted, piece, &p->strayed);
    for (int i = 0; i < n && scattered == INFINITY; i++) {
        double d = fmax(piece[i].end - done, 0), drawn = INFINITY;
        p->medium = piece[i].medium;
        if (sampler != NULL && p->medium > 0)
            drawn = draw_distance(&s->media.medium[p->medium - 1], sampler);
        if (drawn < d)
            scattered = done + drawn;
        go(s, fmin(d, drawn), i == 0 && ray->from == WITHIN_MEDIUM,
           drawn < d || (i == n - 1 && ray->to == WITHIN_MEDIUM), p);
        done += d;
    }
    if (piece != few)
        free(piece);
    free(hit);
    return scattered;
}

struct passage medium_pass(const struct scene *s, const struct ray *ray, vec3 ng, int around)
{
    struct passage out = begin(s, ray, ng, around);
    pass(s, ray, NULL, ray->tmax == INFINITY ? s->media.outer : -1, &out);
    return out;
}

/* The medium before a surface that a ray comes to; -1 if it does not bound any. */
static int medium_before(const struct scene *s, const struct surface *at, vec3 d)
{
    const int *medium = shape_group_of(&s->geo, (int)(at->prim_id - 1))->medium;
    return medium[0] == medium[1] ? -1 : medium[!(dot(at->ng, d) > 0)];
}

bool medium_fly(const struct scene *s, const struct ray *ray, vec3 ng, int around, struct sampler *sampler, bool meets,
                struct surface *at, struct passage *out)
{
    struct ray way = *ray;
    if (meets)
        way.tmax = length(sub(at->p, ray->o));
    *out = begin(s, ray, ng, around);
    double d = pass(s, &way, sampler, meets ? medium_before(s, at, ray->d) : s->media.outer, out);
    if (d == INFINITY)
        return meets;
    const struct medium *m = &s->media.medium[out->medium - 1];
    out->left = rgb_mul(out->left, m->sigma_s);
    *at = (struct surface){.p = add(ray->o, mul(ray->d, d)), .ns = neg(ray->d), .material = m->material,
                           .prim_id = WITHIN_MEDIUM, .light = -1};
    return true;
}

/* --- what is about the scene -------------------------------------------------------------------------- */

/* The medium before the first shape on a ray that bounds any, -1 if none does. Is another surface before it? */
static int first_medium(const struct scene *s, const struct ray *ray, bool *hidden)
{
    struct hit surface, bound;
    struct surface at;
    bool bounded = kd_closest(&s->media.interfaces, &s->geo, ray, &bound);
    *hidden = kd_closest(&s->kd, &s->geo, ray, &surface) && !(bounded && bound.t < surface.t);
    if (*hidden) {
        shape_surface(&s->geo, &surface, ray, &at);
        int medium = medium_before(s, &at, ray->d);
        *hidden = medium < 0;
        if (medium >= 0)
            return medium;
    }
    return bounded ? crossing_at(s, ray, &bound).medium[0] : -1;
}

int medium_outermost(const struct scene *s, vec3 lo, vec3 hi)
{
    enum { TRIES = 64 };
    const vec3 lens = s->camera.position;
    double far = 2 * (length(sub(hi, lo)) + length(sub(lens, lo)));
    int seen = -1, behind = s->camera.medium;
    for (int i = 0; i < TRIES; i++) {
        double u, v;
        bool hidden;
        sampler_r2(i, &u, &v);
        vec3 w = warp_sphere(u, v);
        const struct ray inwards = {add(lens, mul(w, far)), neg(w), 0, far, 0, 0};
        int medium = first_medium(s, &inwards, &hidden);
        if (medium < 0 && !hidden)
            return s->camera.medium;
        if (hidden)
            behind = medium >= 0 ? medium : behind;
        else
            seen = seen < 0 || medium < seen ? medium : seen;
    }
    return seen >= 0 ? seen : behind;
}
