/* regularise.c: see regularise.h. */
#include "caustics/regularise.h"

#include <stdlib.h>

struct regularise {
    struct extra extra;
    double eps_1;
};

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

/* By a copy of the sampler: what other strategies draw is the same as without. */
static int connect(const struct extra *self, struct pixel_sample *sample, const struct vertex *eye, int t,
                   struct connection out[EXTRA_MOST])
{
    const struct regularise *r = (const void *)self;
    const struct scene *scene = sample->scene;
    const struct vertex *z = &eye[t - 1];
    struct sampler draws = sample->sampler;
    struct light_point y;
    double u[3];
    if (z->bsdf.n_lobes == z->bsdf.n_smooth || !without_rival(sample->counts, eye, t))
        return 0;
    u[0] = sampler_number(&draws, DRAW_LIGHT);
    sampler_pair(&draws, DRAW_LIGHT_POINT, &u[1]);
    if (!light_sample_point(&scene->lights, &scene->geo, u, &y) || !light_is_delta(&scene->lights.light[y.light]))
        return 0;
    bool parallel = light_at_infinity(&scene->lights.light[y.light]);
    vec3 d = parallel ? y.w : sub(y.p, z->p), w = normalize(d);
    rgb f = spread(z, w, r->eps_1 * m_pow((double)sample->iteration + 1, -1.0 / 6));
    rgb value = rgb_scale(rgb_mul(rgb_mul(z->beta, f), light_Le(&scene->lights, &y, neg(w))),
                          1 / (y.pdf * (parallel ? 1 : length2(d))));
    if (rgb_is_black(value) || !rgb_is_finite(value) ||
        !(parallel ? scene_lit_from(scene, z->p, z->prim_id, w) : scene_lit(scene, z->p, z->prim_id, y.p, y.prim_id)))
        return 0;
    double edge = parallel ? light_distance(&scene->lights, z->p, w) : length(d);
    const struct connection c = {.value = value, .weight = 1, .length = z->length + edge, .end = parallel ? w : y.p,
                                 .light = y.light, .cell = y.cell, .pdf = y.pdf};
    out[0] = c;
    return 1;
}

static void release(struct extra *self) { free(self); }

struct extra *regularise_new(double eps_1)
{
    const struct regularise r = {{connect, NULL, release}, eps_1};
    struct regularise *out = mem_alloc(1, sizeof *out);
    *out = r;
    return &out->extra;
}
