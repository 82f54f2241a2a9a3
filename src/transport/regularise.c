/* regularise.c: see regularise.h. */
#include "transport/regularise.h"

double regularise_eps(double eps_1, long iteration) { return eps_1 * m_pow((double)iteration + 1, -1.0 / 6); }

/* Is there no strategy for the path of which z = eye[t-1], left by a delta lobe, is the last vertex before its light? A
 * vertex can be joined to where it was left by another lobe. */
static bool without_rival(const struct mis_counts *counts, const struct vertex *eye, int t)
{
    bool scattered = false, light_paths = counts->splat > 0;
    for (int i = 1; i < t - 1; i++) {
        bool here = !eye[i + 1].prev_delta;
        if (here && light_paths && !eye[i].prev_delta)
            return false;
        scattered |= here;
    }
    return scattered;
}

/* Both cones' kappa K towards w. */
static rgb spread(const struct vertex *z, vec3 w, double eps)
{
    rgb sum = rgb_black();
    double cos_eps = m_cos(eps), K = 1 / (2 * PI * (1 - cos_eps));
    for (int transmit = 0; transmit < 2; transmit++) {
        struct bsdf_sample s;
        if (bsdf_delta(&z->bsdf, z->wo, transmit, RADIANCE, &s) && dot(s.wi, w) > cos_eps)
            sum = rgb_add(sum, rgb_scale(s.f, K));
    }
    return sum;
}

struct connection regularise_connect(const struct scene *scene, const struct mis_counts *counts,
                                     const struct vertex *eye, int t, double eps, struct sampler *sampler)
{
    const struct vertex *z = &eye[t - 1];
    struct connection c = {.light = -1, .cell = -1};
    struct light_point y;
    double u[3];
    if (z->bsdf.n_lobes == z->bsdf.n_smooth || !without_rival(counts, eye, t))
        return c;
    u[0] = sampler_number(sampler, DRAW_LIGHT);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    if (!light_sample_point(&scene->lights, &scene->geo, u, &y) || !light_is_delta(&scene->lights.light[y.light]))
        return c;
    bool parallel = light_at_infinity(&scene->lights.light[y.light]);
    vec3 d = parallel ? y.w : sub(y.p, z->p), w = normalize(d);
    rgb f = spread(z, w, eps);
    rgb value = rgb_scale(rgb_mul(rgb_mul(z->beta, f), light_Le(&scene->lights, &y, neg(w))),
                          1 / (y.pdf * (parallel ? 1 : length2(d))));
    if (rgb_is_black(value) || !rgb_is_finite(value) ||
        !(parallel ? scene_lit_from(scene, z->p, z->prim_id, w) : scene_lit(scene, z->p, z->prim_id, y.p, y.prim_id)))
        return c;
    c.value = value;
    c.weight = 1;
    c.length = z->length + (parallel ? light_distance(&scene->lights, z->p, w) : length(d));
    c.end = parallel ? w : y.p;
    c.light = y.light;
    c.cell = y.cell;
    c.pdf = y.pdf;
    return c;
}
