/* microfacet.c: see microfacet.h. Fresnel's equations are in every optics book [Born & Wolf 1999 1.5]; the conductor's
 * are in the form that avoids complex numbers [Lagarde 2013]. */
#include "material/microfacet.h"

#include <math.h>

/* [PBRT3 8.2.1] */
double fresnel_dielectric(double cos_i, double eta_a, double eta_b)
{
    double eta_i = cos_i > 0 ? eta_a : eta_b, eta_t = cos_i > 0 ? eta_b : eta_a;
    cos_i = fmin(fabs(cos_i), 1);
    double sin2_t = sqr(eta_i / eta_t) * (1 - cos_i * cos_i);
    if (sin2_t >= 1)
        return 1;
    double cos_t = sqrt(1 - sin2_t);
    double parallel = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
    double perpendicular = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
    return 0.5 * (sqr(parallel) + sqr(perpendicular));
}

/* [Lagarde 2013] Where there is hardly a boundary (eta 1, k 0) rounding would make it less than 0, and grazing light
 * 0/0, which fmax drops. */
static double conductor_channel(double cos_i, double eta, double k)
{
    double cos2 = cos_i * cos_i, sin2 = 1 - cos2;
    double difference = eta * eta - k * k - sin2;
    double a2_plus_b2 = sqrt(sqr(difference) + 4 * sqr(eta * k));
    double a = safe_sqrt(0.5 * (a2_plus_b2 + difference));
    double sum = a2_plus_b2 + cos2, cross_term = 2 * cos_i * a;
    double perpendicular = fmax((sum - cross_term) / (sum + cross_term), 0);
    double sum_p = cos2 * a2_plus_b2 + sin2 * sin2, cross_p = cross_term * sin2;
    double parallel = fmax(perpendicular * (sum_p - cross_p) / (sum_p + cross_p), 0);
    return 0.5 * (parallel + perpendicular);
}

rgb fresnel_conductor(double cos_i, rgb eta, rgb k)
{
    cos_i = fmin(fabs(cos_i), 1);
    return rgb_make(conductor_channel(cos_i, eta.r, k.r), conductor_channel(cos_i, eta.g, k.g),
                    conductor_channel(cos_i, eta.b, k.b));
}

bool fresnel_refract(vec3 wo, vec3 n, double eta, vec3 *wi)
{
    double cos_o = dot(n, wo);
    double sin2_i = eta * eta * fmax(0, 1 - cos_o * cos_o);
    if (sin2_i >= 1)
        return false;
    double cos_i = sqrt(1 - sin2_i);
    *wi = add(mul(wo, -eta), mul(n, eta * cos_o - cos_i));
    return true;
}

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

double fresnel_schlick(double cosine)
{
    double m = clamp(1 - cosine, 0, 1);
    return sqr(sqr(m)) * m;
}

rgb fresnel_disney(double cos_h, double eta_a, double eta_b, rgb colour, double metallic)
{
    double weight = fresnel_schlick(cos_h);
    rgb metal = rgb_add(rgb_scale(colour, 1 - weight), rgb_grey(weight));
    double clear = fresnel_dielectric(cos_h, eta_a, eta_b);
    return rgb_add(rgb_scale(metal, metallic), rgb_grey((1 - metallic) * clear));
}
