/* warp.h: maps from the unit square to disks, hemispheres and spheres, each with its density.
 *
 * Every warp takes (u1,u2) uniform in [0,1)^2. pdf_w is a density per steradian, pdf_a per unit area.
 * Tests: test_sampler.c, chi-square of each map against its density. */
#ifndef ASBDPT_WARP_H
#define ASBDPT_WARP_H

#include "base/vec.h"

/* warp_disk: uniform on the unit disk, area-preserving and with little distortion [Shirley 1997]. Squares around the
 * middle become circles; the angle is counted from the nearer axis. */
static inline void warp_disk(double u1, double u2, double *x, double *y)
{
    double a = 2 * u1 - 1, b = 2 * u2 - 1;
    bool wide = fabs(a) > fabs(b);
    double r = wide ? a : b, other = wide ? b : a;
    vec3 p = cylindrical(r, r != 0 ? PI / 4 * (other / r) : 0, 0);
    *x = wide ? p.x : p.y;
    *y = wide ? p.y : p.x;
}

/* warp_disk_inverse: the (u1,u2), in [0,1), that warp_disk maps to (x,y); beyond the disk, those of a point on its
 * edge. */
static inline void warp_disk_inverse(double x, double y, double *u1, double *u2)
{
    bool wide = fabs(x) > fabs(y);
    double r = sqrt(x * x + y * y), near = wide ? x : y, far = wide ? y : x;
    double a = near < 0 ? -r : r, b = near != 0 ? a * (4 / PI) * m_atan2(far / near, 1) : 0;
    *u1 = below_one(fmax(((wide ? a : b) + 1) / 2, 0));
    *u2 = below_one(fmax(((wide ? b : a) + 1) / 2, 0));
}

/* warp_cos_hemisphere: direction around +z with density cos(theta)/pi [PBRT3 13.6.3]. */
static inline vec3 warp_cos_hemisphere(double u1, double u2)
{
    double x, y;
    warp_disk(u1, u2, &x, &y);
    return vec(x, y, safe_sqrt(1 - x * x - y * y));
}

static inline double warp_cos_hemisphere_pdf_w(double cos_theta) { return cos_theta > 0 ? cos_theta * INV_PI : 0; }

/* warp_sphere: uniform over the unit sphere, density 1/(4 pi) [PBRT3 13.6.1]. */
static inline vec3 warp_sphere(double u1, double u2)
{
    double z = 1 - 2 * u1, r = safe_sqrt(1 - z * z), phi = 2 * PI * u2;
    return cylindrical(r, phi, z);
}

/* warp_sphere_inverse: the (u1,u2), in [0,1), that warp_sphere maps to w. */
static inline void warp_sphere_inverse(vec3 w, double *u1, double *u2)
{
    double phi = m_atan2(w.y, w.x) / (2 * PI);
    *u1 = below_one(fmax((1 - w.z) / 2, 0));
    *u2 = below_one(phi < 0 ? phi + 1 : phi);
}

static inline double warp_sphere_pdf_w(void) { return INV_PI / 4; }

/* warp_cone: uniform over the cone around +z with half angle acos(cos_max) [PBRT3 13.6.4]. */
static inline vec3 warp_cone(double u1, double u2, double cos_max)
{
    double z = 1 - u1 * (1 - cos_max), r = safe_sqrt(1 - z * z), phi = 2 * PI * u2;
    return cylindrical(r, phi, z);
}

/* warp_cone_inverse: the (u1,u2), in [0,1), that warp_cone maps to w; beyond the cone, those of a direction on its
 * edge. 1 - z is written so that nothing cancels in a narrow cone. */
static inline void warp_cone_inverse(vec3 w, double cos_max, double *u1, double *u2)
{
    double from_axis = w.z > 0 ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z, phi = m_atan2(w.y, w.x) / (2 * PI);
    *u1 = below_one(fmax(from_axis / (1 - cos_max), 0));
    *u2 = below_one(phi < 0 ? phi + 1 : phi);
}

static inline double warp_cone_pdf_w(double cos_max) { return 1 / (2 * PI * (1 - cos_max)); }

/* warp_triangle: barycentric coordinates (b1,b2) of a uniform point of a triangle, by the square-root map
 * [PBRT3 13.6.5]; density 1/area. */
static inline void warp_triangle(double u1, double u2, double *b1, double *b2)
{
    double s = sqrt(u1);
    *b1 = 1 - s;
    *b2 = u2 * s;
}

#endif
