/* regularise.c: paths that no strategy makes, made by widening their last delta lobe: biased.       [Kaplanyan 2013]
 *
 * A light without extent is never hit (s = 0), and a delta vertex z cannot be joined to it (s = 1). If light sub-paths
 * cannot make the path either, since before z no two of its vertices in sequence scatter by other lobes (the lens
 * counts as one that does), z is joined to the light all the same: its lobes' deltas are spread evenly over cones,
 *     f |cos| = kappa K(angle between w and the lobe's direction),   K = 1 / (2 pi (1 - cos eps)) within eps, else 0.
 * Such a path has no rival, so its weight is 1; all others are as they were. Light seen directly in mirrors, with no
 * vertex before z that scatters by other lobes, stays invisible.
 *
 * Bias falls as eps^2, variance grows as 1/(n eps^2): iteration n = 1, 2 ... has eps = eps_1 n^(-1/6), so that the
 * picture converges, more slowly than others do, to one without bias.
 *
 * Tests: test_caustic.c.
 */
#include "caustics/derived.h"
#include "caustics/lamp.h"
#include "caustics/one_more.h"
#include "caustics/surfaces.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

struct regularise {
    struct one_more more;
    double eps_1;
};

/* Is there no strategy for the path of which z = eye[t-1], left by a delta lobe, is the last vertex before its light? A
 * vertex can be joined to where it was left by another lobe. */
static bool without_rival(const struct counts *counts, const struct vertex *eye, int t)
{
    bool scattered = false, light_paths = counts->lens > 0;
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
static int connect(const struct one_more *self, struct sample *sample, const struct vertex *eye, int t,
                   struct one_more_path out[ONE_MORE_MOST])
{
    const struct regularise *r = (const void *)self;
    const struct scene *scene = sample->pass->job->scene;
    const struct vertex *z = &eye[t - 1];
    struct sampler draws = sample->sampler;
    struct light_point y;
    if (z->bsdf.n_lobes == z->bsdf.n_smooth || !without_rival(sample->pass->counts, eye, t))
        return 0;
    if (!lamp_draw(scene, &draws, &y) || !light_is_delta(&scene->lights.light[y.light]))
        return 0;
    const struct lamp_way way = lamp_way(scene, z->p, &y);
    rgb f = spread(z, way.w, r->eps_1 * m_pow((double)sample->iteration + 1, -1.0 / 6));
    rgb value = rgb_scale(rgb_mul(rgb_mul(z->beta, f), light_Le(&scene->lights, &y, neg(way.w))),
                          1 / (y.pdf * way.d2));
    if (rgb_is_black(value) || !rgb_is_finite(value) || !lamp_seen(scene, z->p, z->prim_id, &y))
        return 0;
    out[0] = (struct one_more_path){{.value = value, .weight = 1, .light = y.light}, y, NULL, 0};
    return 1;
}

/* --- the row ----------------------------------------------------------------------------------------- */

struct regularise_own {
    struct one_more_own base;
    struct regularise own;
};

static void prepare(const struct render_job *job, struct prepared *p)
{
    struct regularise_own *s = p->own;
    one_more_prepare(job, p);
    s->own.more.connect = connect;
    s->base.more = &s->own.more;
}

static const struct field OWN[] = {
    ONE_MORE_WITH(regularise_own),
    {"angle", FIELD_NUMBER, offsetof(struct regularise_own, own.eps_1), 0.1, 1e-6, 1,
     "by which mirrors and glass are blurred, in radians, at first", NULL},
    {.name = NULL}};

const struct method method_regularise = {
    .name = "regularise", .check = surfaces_alone,
    .help = "mirrors and glass are blurred where nothing else finds a light; biased",
    .own = OWN, .own_size = sizeof(struct regularise_own), .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .release = one_more_release, .render = one_more_pass};
