/* frame.h: a right-handed orthonormal frame, used to write a BSDF in coordinates where the normal is z.
 * Tests: test_vec.c. */
#ifndef ASBDPT_FRAME_H
#define ASBDPT_FRAME_H

#include "base/vec.h"

struct frame {
    vec3 s, t, n; /* unit, mutually orthogonal, s x t = n */
};

/* frame_from_normal: any frame around the unit vector n. Frisvad's construction in the branch-free form
 * of [Duff 2017]: accurate for every n, including -z. */
static inline struct frame frame_from_normal(vec3 n)
{
    double sign = copysign(1.0, n.z);
    double a = -1 / (sign + n.z);
    double b = n.x * n.y * a;
    return (struct frame){vec(1 + sign * n.x * n.x * a, sign * b, -sign * n.x),
                          vec(b, sign + n.y * n.y * a, -n.y), n};
}

/* frame_from_tangent: the frame around n whose s is nearest to `tangent`; any frame if tangent is parallel
 * to n or zero. */
static inline struct frame frame_from_tangent(vec3 n, vec3 tangent)
{
    vec3 s = sub(tangent, mul(n, dot(n, tangent)));
    double l = length(s);
    if (!(l > 1e-9 * length(tangent)))
        return frame_from_normal(n);
    s = mul(s, 1 / l);
    return (struct frame){s, cross(n, s), n};
}

static inline vec3 to_local(const struct frame *f, vec3 w) { return vec(dot(w, f->s), dot(w, f->t), dot(w, f->n)); }

static inline vec3 to_world(const struct frame *f, vec3 w)
{
    return add(add(mul(f->s, w.x), mul(f->t, w.y)), mul(f->n, w.z));
}

#endif
