/* quadric.h: spheres, disks and cylinders, whole or cut, with pbrt-v3's parameters and (u,v).
 *
 * A quadric is defined in its object space and placed by an affine transform; rays are taken to object space
 * without rescaling t. The outside of a sphere or cylinder, and the +z side of a disk, is where the normal
 * points; ReverseOrientation turns it. A mirroring transform does not: emitters and hits follow the one rule.
 *
 * Tests: test_shape.c.
 */
#ifndef ASBDPT_QUADRIC_H
#define ASBDPT_QUADRIC_H

#include "geometry/surface.h"
#include "base/transform.h"

enum quadric_kind { QUADRIC_SPHERE, QUADRIC_DISK, QUADRIC_CYLINDER };

struct quadric {
    enum quadric_kind kind;
    struct transform to_world;
    double radius;       /* > 0 */
    double inner_radius; /* disk only */
    double zmin, zmax;   /* sphere and cylinder; a disk lies at z = zmin = zmax ("height") */
    double phi_max;      /* radians, (0, 2 pi] */
    int group;
};

/* quadric_normalise: parameters as pbrt understands them: zmin <= zmax, within the radius for a sphere,
 * phi_max at most 2 pi. */
void quadric_normalise(struct quadric *q);

/* quadric_bounds: a world box around the quadric (of the full turn, whatever phi_max). */
void quadric_bounds(const struct quadric *q, vec3 *lo, vec3 *hi);

/* quadric_intersect: the first t in (tmin, tmax) at which the ray meets the quadric; false if none. */
bool quadric_intersect(const struct quadric *q, const struct ray *ray, double *t);

/* quadric_surface_at: the surface point at object-space point p, which is moved onto the quadric first.
 * Fills all of *out but material and light. */
void quadric_surface_at(const struct quadric *q, bool reverse_orientation, vec3 p, struct surface *out);

/* quadric_sample: an object-space point, uniform by object-space area, from (u1,u2) in [0,1)^2. */
vec3 quadric_sample(const struct quadric *q, double u1, double u2);

/* quadric_area: world area, m^2. Exact if the transform is a similarity or the quadric a disk, otherwise by
 * numerical integration (relative error about 1e-4). */
double quadric_area(const struct quadric *q);

/* quadric_pdf_a: world-area density of quadric_sample where the unit world normal is ng, 1/m^2. */
double quadric_pdf_a(const struct quadric *q, vec3 ng);

#endif
