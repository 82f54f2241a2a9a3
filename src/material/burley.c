/* burley.c: see burley.h. */
#include "material/burley.h"

#include "base/maths.h"
#include "base/number.h"
#include "material/microfacet.h"

static double mix(double t, double a, double b) { return (1 - t) * a + t * b; }

/* What Schlick adds to the reflectance at normal incidence, of what is left to 1. */
static double schlick(double cosine)
{
    double m = clamp(1 - cosine, 0, 1);
    return sqr(sqr(m)) * m;
}

/* Darker at grazing angles; what retro-reflection adds there on rough surfaces; a flat look, as if light was scattered
 * beneath; the sheen of cloth. The angle between wi and half way to wo has the cosine
 * sqrt((1 + wo.wi)/2). [Burley 2012 5.3] [Burley 2015 3] */
rgb disney_diffuse(rgb base, rgb flat, rgb retro, rgb sheen, double roughness, vec3 wo, vec3 wi)
{
    double cos2_d = fmax(0, 0.5 * (1 + dot(wo, wi)));
    double cos_o = fabs(wo.z), cos_i = fabs(wi.z), fo = schlick(cos_o), fi = schlick(cos_i);
    double grazing = roughness * cos2_d, back = 2 * grazing;
    double beneath = mix(fo, 1, grazing) * mix(fi, 1, grazing);
    rgb f = rgb_scale(base, INV_PI * (1 - 0.5 * fo) * (1 - 0.5 * fi));
    f = rgb_add(f, rgb_scale(flat, INV_PI * 1.25 * (beneath * (1 / (cos_o + cos_i) - 0.5) + 0.5)));
    f = rgb_add(f, rgb_scale(retro, INV_PI * back * (fo + fi + fo * fi * (back - 1))));
    return rgb_add(f, rgb_scale(sheen, schlick(sqrt(cos2_d))));
}

rgb disney_fresnel(double cos_h, rgb colour, double metallic, double eta_a, double eta_b)
{
    double weight = schlick(cos_h);
    rgb metal = rgb_add(rgb_scale(colour, 1 - weight), rgb_grey(weight));
    double clear = fresnel_dielectric(cos_h, eta_a, eta_b);
    return rgb_add(rgb_scale(metal, metallic), rgb_grey((1 - metallic) * clear));
}

/* The distribution "GTR1", of longer tails than Trowbridge and Reitz's. [Burley 2012 appendix B] */
double disney_coat_d(vec3 wh, double alpha)
{
    double alpha2 = alpha * alpha;
    return (1 - alpha2) / (-PI * m_log(alpha2) * (sqr(wh.x) + sqr(wh.y) + alpha2 * sqr(wh.z)));
}

/* sin^2 = (alpha2^(1-u) - alpha2) / (1 - alpha2) turns the cumulative distribution round. */
vec3 disney_coat_sample(double alpha, double u1, double u2)
{
    double alpha2 = alpha * alpha, sin2 = alpha2 * m_expm1(-u1 * m_log(alpha2)) / (1 - alpha2);
    return cylindrical(sqrt(sin2), 2 * PI * u2, safe_sqrt(1 - sin2));
}

/* Masking of a roughness of 0.25, over 4 cos_o cos_i. [Burley 2012 5.6] */
static double coat_masking(double cosine)
{
    const double alpha2 = 0.25 * 0.25;
    return 1 / (cosine + sqrt(alpha2 + (1 - alpha2) * sqr(cosine)));
}

double disney_coat(double alpha, vec3 wo, vec3 wi, vec3 wh)
{
    double fresnel = mix(schlick(dot(wo, wh)), 0.04, 1);
    return 0.25 * disney_coat_d(wh, alpha) * fresnel * coat_masking(fabs(wo.z)) * coat_masking(fabs(wi.z));
}
