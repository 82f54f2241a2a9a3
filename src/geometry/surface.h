/* surface.h: a point on a surface with everything shading needs to know about it.
 * Filled by: shape. Read by: texture, material, light, path.
 */
#ifndef ASBDPT_SURFACE_H
#define ASBDPT_SURFACE_H

#include <stdint.h>

#include "base/vec.h"

struct surface {
    vec3 p;          /* world position */
    vec3 ng;         /* unit geometric normal; on the side of ns wherever the shape defines normals of its own */
    vec3 ns;         /* unit shading normal (before bump mapping) */
    vec3 dpdu, dpdv; /* partial derivatives of p; dpdu gives the tangent of anisotropic BSDFs */
    vec3 dndu, dndv; /* partial derivatives of ns; zero where the shape does not define them */
    double u, v;     /* texture coordinates */
    int material;    /* index into scene->materials, or -1 */
    uint32_t triangle_id; /* the triangle it is on, see shape_triangle_id; 0: none */
    int light;       /* index into scene->lights of the area light that sits here, or -1 */
};

#endif
