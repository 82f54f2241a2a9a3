/* passage.h: what becomes of light on a straight way through media (medium.h).
 *
 * Of light that goes a distance d the share T = exp(-sigma_t d) is left, in each channel [PBRT3 11.1]. A walk draws how
 * far it gets: a channel, each as likely, and a distance by its sigma_t T [PBRT3 15.2]. So it is scattered after d with
 * the channels' mean of sigma_t T for a density, and gets as far as d with the mean of T. An interface is passed, and
 * behind it the draw begins again. So the density of a way is the product of its pieces', and the same both ways
 * except for what happens at its ends.
 *
 * Tests: test_medium.c, test_mis.c.
 */
#ifndef ASBDPT_PASSAGE_H
#define ASBDPT_PASSAGE_H

#include "base/sampler.h"
#include "scene/scene.h"

/* A straight way. */
struct passage {
    rgb left;          /* share of light; of a walk that is scattered at the end, times sigma_s */
    double density[2]; /* of stopping at its start, for one who comes from its end, and of stopping at its end: 1, or
                        * 1/m where that is within a medium; of walks that go on as far as possible without media */
    int medium;        /* at its end */
};

/* medium_pass: the way from ray->o to ray->tmax.
 *   ng      normal of the primitive ray->from
 *   around  the medium that is there, unless the primitive bounds media */
struct passage medium_pass(const struct scene *s, const struct ray *ray, vec3 ng, int around);

/* medium_fly: the same of a walk towards the surface *at, if it is about to meet one.
 *   at  in-out: where it is scattered, if that is before
 * Returns whether it comes to anything. */
bool medium_fly(const struct scene *s, const struct ray *ray, vec3 ng, int around, struct sampler *sampler, bool meets,
                struct surface *at, struct passage *out);

#endif
