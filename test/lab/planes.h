/* planes.h: more pictures of the paths that a render makes: the light of each group of lights (scene/light.h), alpha,
 * and the variance of the pixels. An observer fills them; each is a film of its own.
 *
 * A sample's value grows from 0 by what its paths add, one after the other. To the plane of its light every step adds
 * two terms, the value after it less the value before it. Added up, all but the last value cancel: so the planes of all
 * lights together are the picture, to the bit. The squares of values are summed in the same way.
 *
 * The variance is a bound from above: that of the mean of as many independent samples, whose splats are rare events.
 * Samples of a pixel are points of nets (sampler.h), and their mean errs less.
 *
 * Tests: test_lights.c, test_aov.c.
 */
#ifndef ASBDPT_LAB_PLANES_H
#define ASBDPT_LAB_PLANES_H

#include "render/render.h"

struct plane_slot; /* what a tile pass adds to the planes */

struct planes {
    const struct film *picture; /* what the render fills; borrowed */
    const struct light_set *lights;
    int n_groups;               /* planes of lights, the first; 0: lights are not told apart */
    bool alpha, variance;
    int n;                      /* planes, which are the groups, alpha, and two for the variance */
    struct film *film;          /* [n], owned */
    struct plane_slot *slot;    /* [n_slots], owned */
    int n_slots;
};

/* planes_init: for a render by so many threads (0: one per processor) of this film, which has nothing in it yet.
 * planes_observers: who is to look on at it. planes_end: call this when it is over, before the planes are read. */
void planes_init(struct planes *p, const struct scene *scene, const struct film *picture, bool lights, bool alpha,
                 bool variance, int n_threads);
struct observers planes_observers(struct planes *p);
void planes_end(struct planes *p);
void planes_free(struct planes *p);

/* planes_alpha: the film of alpha, grey; NULL if there is none. */
const struct film *planes_alpha(const struct planes *p);

/* planes_variance: of each value of the picture at this scale, [height*width*3]; infinite with fewer than two samples.
 */
void planes_variance(const struct planes *p, double scale, float *out);

#endif
