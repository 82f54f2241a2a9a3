/* medium.h: what fills space: homogeneous media. passage.h says what becomes of light in them.
 *
 * Media are numbered from 1; 0 is none. A surface without material whose sides are in different media is an interface
 * of these, and nothing else.
 *
 * Where there are lights at infinity, a medium that has no bound ends on the sphere about the scene (light.h), which
 * then holds the lens, too. Beyond are these lights alone: they are in no medium, whatever a scene says before them.
 */
#ifndef ASBDPT_MEDIUM_H
#define ASBDPT_MEDIUM_H

#include "base/rgb.h"
#include "geometry/kdtree.h"

struct medium {
    rgb sigma_s, sigma_t; /* scattered, and scattered or absorbed, 1/m */
    int material;         /* its phase function, index into scene->material */
};

/* All media of a scene. */
struct medium_set {
    struct medium *medium; /* [n], owned */
    int n;
    struct kdtree interfaces;
    int outer;  /* what is about the scene; set by scene_prepare */
    bool ends;  /* and does it end on the sphere? */
};

/* medium_before: the medium before a surface that a ray of direction d comes to; -1 if its shape does not bound any. */
static inline int medium_before(const struct geometry *geo, const struct surface *at, vec3 d)
{
    const int *medium = shape_group_of(geo, shape_prim(at->prim_id))->medium;
    return medium[0] == medium[1] ? -1 : medium[!(dot(at->ng, d) > 0)];
}

#endif
