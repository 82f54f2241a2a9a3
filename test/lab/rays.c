/* rays.c: see rays.h. */
#include "lab/rays.h"

#include "base/sampler.h"
#include "base/warp.h"

static vec3 cosine_direction(struct sampler *sampler, vec3 n)
{
    struct frame f = frame_from_normal(n);
    double u[2];
    sampler_pair(sampler, DRAW_SCATTERING, u);
    return to_world(&f, warp_cos_hemisphere(u[0], u[1]));
}

/* Replace the ray by one leaving the surface it meets. False if it meets none. */
static bool bounce(const struct scene *s, struct ray *ray, struct sampler *sampler)
{
    struct surface at;
    if (!scene_intersect(s, ray, &at))
        return false;
    struct ray next = {at.p, cosine_direction(sampler, faceforward(at.ng, neg(ray->d))), ray_margin(at.p), INFINITY,
                       at.prim_id, 0};
    *ray = next;
    return true;
}

int bench_rays(const struct scene *s, struct ray *out)
{
    int n = 0;
    for (int i = 0; n < N_RAYS && i < 8 * N_RAYS; i++) {
        struct sampler sampler = sampler_start(0, RNG_TEST, (uint64_t)i, 0);
        double u[2];
        sampler_pair(&sampler, DRAW_FILM_POINT, u);
        out[n] = camera_ray(&s->camera, u[0] * s->width, u[1] * s->height, 0.5, 0.5);
        n += bounce(s, &out[n], &sampler) && bounce(s, &out[n], &sampler);
    }
    return n;
}
