/* medium.h: what fills space, homogeneous media, and what becomes of light on a straight way through them.
 *
 * Media are numbered from 1; 0 is none. A surface without material whose sides are in different media is an interface
 * of these, and nothing else.
 *
 * Where there are lights at infinity, a medium that has no bound ends on the sphere about the scene (light.h), which
 * then holds the lens, too. Beyond are these lights alone: they are in no medium, whatever a scene says before them.
 *
 * Of light that goes a distance d the share T = exp(-sigma_t d) is left, in each channel [PBRT3 11.1]. A walk draws how
 * far it gets: a channel, each as likely, and a distance by its sigma_t T [PBRT3 15.2]. So it is scattered after d with
 * the channels' mean of sigma_t T for a density, and gets as far as d with the mean of T. An interface is passed, and
 * behind it the draw begins again. So the density of a way is the product of its pieces', and the same both ways
 * except for what happens at its ends.
 *
 * Tests: test_medium.c, test_mis.c.
 */
#ifndef ASBDPT_MEDIUM_H
#define ASBDPT_MEDIUM_H

#include "base/rgb.h"
#include "base/sampler.h"
#include "geometry/kdtree.h"

struct light_set;

struct medium {
    rgb sigma_s, sigma_t; /* scattered, and scattered or absorbed, 1/m */
    int material;         /* its phase function, index into scene->material */
};

/* All that a scene has of media. */
struct space {
    struct medium *medium; /* [n], owned */
    int n;
    /* set by scene_prepare: */
    const struct geometry *geo;
    const struct light_set *lights; /* of that sphere */
    struct kdtree interfaces;
    int outer; /* what is about the scene */
    bool ends; /* and does it end on the sphere? */
};

/* space_add: one more medium, in a space that is made for the first; returns its number. */
int space_add(struct space **space, struct medium m);
void space_free(struct space *space);

/* medium_before: the medium before a surface that a ray of direction d comes to; -1 if its shape does not bound any. */
static inline int medium_before(const struct geometry *geo, const struct surface *at, vec3 d)
{
    const struct shape_group *group = shape_group_of(geo, shape_prim(at->prim_id));
    return shape_is_interface(group) ? group->medium[!(dot(at->ng, d) > 0)] : -1;
}

/* medium_outermost: what is about the scene, no surface of which is `far` from the lens: `around`, the lens' own
 * medium, if a straight way there is free, else what the shapes that bound media say on the ways to it, the least
 * number if they differ. */
int medium_outermost(const struct space *space, const struct kdtree *surfaces, vec3 lens, int around, double far);

/* What media do to light on an edge, and to walks. */
struct edge {
    rgb left;          /* share of light; of a walk that is scattered at the end, times sigma_s */
    double density[2]; /* of stopping at its start, for one who comes from its end, and of stopping at its end: 1, or
                        * 1/m where that is within a medium; of walks that go on as far as possible without media */
    int medium;        /* at its end */
};

static const struct edge EMPTY_EDGE = {{1, 1, 1}, {1, 1}, 0};

/* medium_towards: the medium into which direction d leads from a point of a primitive of normal ng: `around` unless
 * that bounds media. */
int medium_towards(const struct space *space, uint64_t prim_id, vec3 ng, vec3 d, int around);

/* medium_pass: the edge from ray->o to ray->tmax, which begins in this medium.
 * medium_fly: the same of a walk towards the surface *at, if it is about to meet one.
 *   at   in-out: where it is scattered, if that is before
 *   out  in-out: EMPTY_EDGE so far
 * Returns whether it comes to anything. */
void medium_pass(const struct space *space, const struct ray *ray, int medium, struct edge *out);
bool medium_fly(const struct space *space, const struct ray *ray, int medium, struct sampler *sampler, bool meets,
                struct surface *at, struct edge *out);

#endif
