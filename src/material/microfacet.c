/* microfacet.c: see microfacet.h. */
#include "material/microfacet.h"

/* The usual form has tan(theta), cos(phi) and sin(phi); multiplied out only the components are left. [PBRT3 8.4.2] */
double microfacet_d(vec3 wh, double alpha_x, double alpha_y)
{
    double stretched = sqr(wh.x / alpha_x) + sqr(wh.y / alpha_y) + sqr(wh.z);
    return 1 / (PI * alpha_x * alpha_y * sqr(stretched));
}

/* [PBRT3 8.4.3] */
double microfacet_lambda(vec3 w, double alpha_x, double alpha_y)
{
    double alpha2_tan2 = (sqr(alpha_x * w.x) + sqr(alpha_y * w.y)) / sqr(w.z);
    return 0.5 * (sqrt(1 + alpha2_tan2) - 1);
}

/* Stretching the surface by alpha turns its facets into a hemisphere. What wo sees of a hemisphere is what it would
 * mirror into the cap of directions around -wo ... +z: a uniform direction of that cap, and half way to wo. */
vec3 microfacet_sample(vec3 wo, double alpha_x, double alpha_y, double u1, double u2)
{
    double side = wo.z < 0 ? -1 : 1;
    vec3 v = normalize(vec(side * alpha_x * wo.x, side * alpha_y * wo.y, side * wo.z));
    double z = (1 - u2) * (1 + v.z) - v.z;
    double r = safe_sqrt(1 - z * z), phi = 2 * PI * u1;
    vec3 half = add(cylindrical(r, phi, z), v);
    return mul(normalize(vec(alpha_x * half.x, alpha_y * half.y, half.z)), side);
}
