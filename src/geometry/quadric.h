/* quadric.h: spheres, disks, cylinders, cones, paraboloids and hyperboloids, whole or cut, with pbrt-v3's parameters
 * and (u,v), each in an object space of its own and placed by an affine transform.
 *
 * The normal points to the outside, the +z side of a disk, and of a hyperboloid whose p2 is below p1 to the inside;
 * ReverseOrientation turns it, a mirroring transform does not. As in pbrt-v3, points are sampled only on spheres, disks
 * and cylinders: the others cannot be lights.
 *
 * Tests: test_shape.c.
 */
#ifndef ASBDPT_QUADRIC_H
#define ASBDPT_QUADRIC_H

#include "base/transform.h"
#include "geometry/surface.h"

enum quadric_kind {
    QUADRIC_SPHERE,
    QUADRIC_DISK,
    QUADRIC_CYLINDER,
    QUADRIC_CONE,       /* from a circle at z = 0 to its tip at zmax */
    QUADRIC_PARABOLOID, /* its vertex is the origin, its circle at zmax has the radius */
    QUADRIC_HYPERBOLOID /* what the segment from p1 to p2 sweeps as it turns around the z axis */
};

struct quadric {
    enum quadric_kind kind;
    struct transform to_world;
    double radius;       /* > 0; hyperboloid: the larger of p1's and p2's */
    double inner_radius; /* disk only */
    double zmin, zmax;   /* what is kept lies between; a disk lies at z = zmin = zmax ("height") */
    double phi_max;      /* radians, (0, 2 pi] */
    int group;           /* its number among the groups of the geometry, set by shape_add_quadric */
    vec3 p1, p2;         /* hyperboloid only; of different heights */
};

/* quadric_normalise: parameters as pbrt understands them: zmin <= zmax, within the radius for a sphere, from p1 and p2
 * for a hyperboloid; phi_max at most 2 pi. */
void quadric_normalise(struct quadric *q);

/* quadric_bounds: a world box around the quadric (of the full turn, whatever phi_max). */
void quadric_bounds(const struct quadric *q, vec3 *lo, vec3 *hi);

/* quadric_intersect: the first t in (tmin, tmax) at which the ray meets the quadric; false if none.
 *   begins, ends  the ray does so on this quadric: where it meets it nearest to 0, or to tmax, does not count */
bool quadric_intersect(const struct quadric *q, const struct ray *ray, bool begins, bool ends, double *t);

/* quadric_surface_at: the surface point at object-space point p, near the quadric, which is moved onto it first.
 * Fills in what the shape knows of *out; if skip_uv is set, only its position and normals. */
void quadric_surface_at(const struct quadric *q, bool reverse_orientation, bool skip_uv, vec3 p, struct surface *out);

/* quadric_sample: an object-space point of a sphere, disk or cylinder, uniform by object-space area, from (u1,u2) in
 * [0,1)^2. */
vec3 quadric_sample(const struct quadric *q, double u1, double u2);

/* quadric_area: world area of a sphere, disk or cylinder, m^2; 0 of the others. Exact if the transform is a
 * similarity or the quadric a disk, otherwise by numerical integration (relative error about 1e-4). */
double quadric_area(const struct quadric *q);

/* quadric_pdf_a: world-area density of quadric_sample where the unit world normal is ng, 1/m^2. */
double quadric_pdf_a(const struct quadric *q, vec3 ng);

#endif
