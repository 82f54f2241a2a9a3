/* surface.h: a segment of a straight line, where it meets a primitive, and the point of the surface found there. */
#ifndef ASBDPT_SURFACE_H
#define ASBDPT_SURFACE_H

#include <stdint.h>

#include "base/vec.h"

/* A ray segment: the open interval (tmin, tmax) of o + t d. d is unit, so t is a world distance. */
struct ray {
    vec3 o, d;
    double tmin, tmax; /* tmin < 0: the ray begins on a light, tmin being -GRAZING margins; tmax may be HUGE_VAL */
    uint64_t from, to; /* primitives that the segment begins and ends on, as shape_prim_id numbers them; 0: none
                        * known. A line meets a triangle once and others more often, so these meetings are left out. */
};

/* Where a ray begins or ends, or a surface is, that is a point within a medium, instead of a primitive. */
#define WITHIN_MEDIUM UINT64_MAX

/* A ray that grazes surfaces in one place meets them farther from each other than they are, but we look no farther than
 * for so many margins. */
enum { GRAZING = 100 };

/* ray_margin: how far from a point p of a surface, which is not met again (`from`, `to`), a ray meets others.
 * Corners are floats: surfaces nearer to each other than a float's step at p are one.
 * end_margin: the same where the point is on `prim`; none within a medium, where it may be close to a surface.
 * start_margin: that of a ray's origin. */
static inline double ray_margin(vec3 p) { return 1e-7 * (fabs(p.x) + fabs(p.y) + fabs(p.z)); }
static inline double end_margin(vec3 p, uint64_t prim) { return prim == WITHIN_MEDIUM ? 0 : ray_margin(p); }
static inline double start_margin(const struct ray *ray) { return ray->tmin < 0 ? ray->tmin / -GRAZING : ray->tmin; }

/* Where a ray meets a primitive. */
struct hit {
    double t;      /* distance along the ray */
    double b1, b2; /* triangle: barycentric coordinates of vertices 1 and 2; quadric: unused, 0; curve: place
                    * in its net, in pieces along it and in sides around it */
    int prim;      /* primitive number */
    int instance;  /* in which it is, from 1; 0: none */
};

/* A point on a surface with everything that shading needs to know about it. */
struct surface {
    vec3 p;          /* world position */
    vec3 ng;         /* unit geometric normal; on the side of ns wherever the shape defines normals of its own */
    vec3 ns;         /* unit shading normal (before bump mapping) */
    vec3 dpdu, dpdv; /* partial derivatives of p; dpdu gives the tangent of anisotropic BSDFs */
    vec3 dndu, dndv; /* partial derivatives of ns; zero where the shape does not define them */
    double u, v;     /* texture coordinates */
    int material;    /* index into scene->materials, or -1 */
    uint64_t prim_id; /* the primitive it is on, see shape_prim_id */
    int light;       /* index into scene->lights of the area light that sits here, or -1 */
};

#endif
