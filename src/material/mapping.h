/* mapping.h: which point (s,t) of a two-dimensional texture lies at a point of a surface [PBRT3 10.2].
 *
 * Tests: test_texture.c.
 */
#ifndef ASBDPT_MAPPING_H
#define ASBDPT_MAPPING_H

#include "base/transform.h"
#include "geometry/surface.h"

enum mapping_kind {
    MAPPING_UV,          /* s = su u + du, t = sv v + dv, of the surface's own u and v */
    MAPPING_SPHERICAL,   /* s: angle from the z axis of texture space over pi, t: azimuth over 2 pi */
    MAPPING_CYLINDRICAL, /* s: half a turn plus azimuth over 2 pi, t: cosine of that angle, as pbrt-v3 has it */
    MAPPING_PLANAR       /* s = p v1 + du, t = p v2 + dv, of the point's position in the world */
};

/* What a kind does not use is 0. */
struct mapping {
    enum mapping_kind kind;
    int space; /* spherical, cylindrical: which transform takes the texture's space to the world */
    double su, sv, du, dv;
    vec3 v1, v2;
};

struct st {
    double s, t;
};

/* map_point: (s,t) of a surface point; may be NaN where coordinates are.
 *   spaces  the transforms that mapping.space counts */
struct st map_point(const struct mapping *m, const struct transform *spaces, const struct surface *at);

#endif
