/* ray.h: a segment of a straight line, and where it meets a primitive.
 * Used by: triangle, quadric, shape, kdtree, camera.
 */
#ifndef ASBDPT_RAY_H
#define ASBDPT_RAY_H

#include <stdint.h>

#include "base/vec.h"

/* A ray segment: the open interval (tmin, tmax) of o + t d. d is unit, so t is a world distance. */
struct ray {
    vec3 o, d;
    double tmin, tmax; /* tmin >= 0; tmax may be HUGE_VAL */
    uint32_t from, to; /* triangles that the segment begins and ends on, as shape_triangle_id numbers them; 0: none known. A line
                        * meets a plane only once, so they need not be tested again; they may be left 0. */
};

/* Where a ray meets a primitive. */
struct hit {
    double t;      /* distance along the ray */
    double b1, b2; /* triangle: barycentric coordinates of vertices 1 and 2; quadric: unused, 0 */
    int prim;      /* primitive number */
};

#endif
