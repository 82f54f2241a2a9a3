/* vec.h: points, directions and normals.
 *
 * All of light transport is computed in `double`: no reader has to follow roundings, products of many densities stay
 * in range, and a hit point is so exact that rays need no offset tricks (see kdtree.h).
 * Bulk data (vertices, triangles, texels) is stored as `float`.
 *
 * Points, vectors and normals share one type; what a value is, its name says: p a point, n a normal, w a
 * direction of length 1. Values are passed by value; nothing here can fail.
 * Tests: test_vec.c. */
#ifndef ASBDPT_VEC_H
#define ASBDPT_VEC_H

#include <stddef.h>

#include "base/maths.h"
#include "base/number.h"

typedef struct {
    double x, y, z;
} vec3;

static inline vec3 vec(double x, double y, double z) { return (vec3){x, y, z}; }

/* load3, store3: number i of an array of vectors, three floats each. What is stored must fit a float. */
static inline vec3 load3(const float *v, size_t i) { return vec(v[3 * i], v[3 * i + 1], v[3 * i + 2]); }
static inline void store3(float *v, size_t i, vec3 a)
{
    v[3 * i] = (float)a.x;
    v[3 * i + 1] = (float)a.y;
    v[3 * i + 2] = (float)a.z;
}

/* cylindrical: the point at distance r from the z axis, at the angle phi. */
static inline vec3 cylindrical(double r, double phi, double z)
{
    double s, c;
    m_sincos(phi, &s, &c);
    return vec(r * c, r * s, z);
}

static inline vec3 add(vec3 a, vec3 b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline vec3 sub(vec3 a, vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline vec3 mul(vec3 a, double s) { return vec(a.x * s, a.y * s, a.z * s); }
static inline vec3 neg(vec3 a) { return vec(-a.x, -a.y, -a.z); }
static inline double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double abs_dot(vec3 a, vec3 b) { return fabs(dot(a, b)); }
static inline double length2(vec3 a) { return dot(a, a); }
static inline double length(vec3 a) { return sqrt(dot(a, a)); }
static inline vec3 lerp3(double t, vec3 a, vec3 b) { return add(mul(a, 1 - t), mul(b, t)); }

/* barycentric3: the mean of three values with the weights 1 - b1 - b2, b1 and b2. */
static inline vec3 barycentric3(const vec3 v[3], double b1, double b2)
{
    return add(add(mul(v[0], 1 - b1 - b2), mul(v[1], b1)), mul(v[2], b2));
}

static inline vec3 cross(vec3 a, vec3 b)
{
    return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* normalize: the unit vector along a; the zero vector stays zero. */
static inline vec3 normalize(vec3 a)
{
    double l = length(a);
    return l > 0 ? mul(a, 1 / l) : a;
}

/* faceforward: n or -n, whichever lies on the side of v. */
static inline vec3 faceforward(vec3 n, vec3 v) { return dot(n, v) < 0 ? neg(n) : n; }

/* is_place: can something of the scene be at p? A kd-tree's planes are as thick as 1e-14 of the scene (kdtree.c):
 * with something farther away than this, things of everyday size could not be distinguished. */
static inline bool is_place(vec3 p)
{
    const double limit = 1e12;
    return fabs(p.x) <= limit && fabs(p.y) <= limit && fabs(p.z) <= limit;
}

static inline bool is_finite3(vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

/* A right-handed orthonormal frame, used to write a BSDF in coordinates where the normal is z. */
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
