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
rgb disney_diffuse(const struct lobe *l, vec3 wo, vec3 wi)
{
    double cos2_d = fmax(0, 0.5 * (1 + dot(wo, wi)));
    double cos_o = fabs(wo.z), cos_i = fabs(wi.z), fo = schlick(cos_o), fi = schlick(cos_i);
    double grazing = l->of.disney.roughness * cos2_d, back = 2 * grazing;
    double beneath = mix(fo, 1, grazing) * mix(fi, 1, grazing);
    rgb f = rgb_scale(l->R, INV_PI * (1 - 0.5 * fo) * (1 - 0.5 * fi));
    f = rgb_add(f, rgb_scale(l->of.disney.flat, INV_PI * 1.25 * (beneath * (1 / (cos_o + cos_i) - 0.5) + 0.5)));
    f = rgb_add(f, rgb_scale(l->of.disney.retro, INV_PI * back * (fo + fi + fo * fi * (back - 1))));
    return rgb_add(f, rgb_scale(l->of.disney.sheen, schlick(sqrt(cos2_d))));
}

rgb disney_fresnel(const struct lobe *l, double cos_h)
{
    double weight = schlick(cos_h), metallic = l->of.tinted.metallic;
    rgb metal = rgb_add(rgb_scale(l->of.tinted.normal, 1 - weight), rgb_grey(weight));
    double clear = fresnel_dielectric(cos_h, l->eta_a, l->eta_b);
    return rgb_add(rgb_scale(metal, metallic), rgb_grey((1 - metallic) * clear));
}

/* --- clear coat -------------------------------------------------------------------------------------- */

/* The distribution "GTR1", of longer tails than Trowbridge and Reitz's: the area of facets of normal wh, per area of
 * surface, 1/sr. The integral of D(wh) |cos(wh)| over a hemisphere is 1. [Burley 2012 appendix B] */
static double coat_d(vec3 wh, double alpha)
{
    double alpha2 = alpha * alpha;
    return (1 - alpha2) / (-PI * m_log(alpha2) * (sqr(wh.x) + sqr(wh.y) + alpha2 * sqr(wh.z)));
}

/* Masking of a roughness of 0.25, over 4 cos_o cos_i. [Burley 2012 5.6] */
static double coat_masking(double cosine)
{
    const double alpha2 = 0.25 * 0.25;
    return 1 / (cosine + sqrt(alpha2 + (1 - alpha2) * sqr(cosine)));
}

/* Normals are drawn as there are facets, seen or not: pdf = D cos_h / (4 wo.wh). */
struct bsdf_value disney_coat(const struct lobe *l, vec3 wo, vec3 wi, bool reflect)
{
    if (!(wo.z * wi.z > 0))
        return NO_SCATTERING;
    vec3 wh = normalize(add(wo, wi));
    double d = coat_d(wh, l->of.gloss), pdf = d * fabs(wh.z) / (4 * dot(wo, wh));
    double fresnel = mix(schlick(dot(wo, wh)), 0.04, 1);
    double value = reflect ? 0.25 * d * fresnel * coat_masking(fabs(wo.z)) * coat_masking(fabs(wi.z)) : 0;
    return (struct bsdf_value){rgb_scale(l->R, value), pdf, pdf};
}

/* sin^2 = (alpha2^(1-u) - alpha2) / (1 - alpha2) turns the cumulative distribution round. */
bool disney_coat_sample(const struct lobe *l, vec3 wo, double u1, double u2, vec3 *wi)
{
    double alpha2 = sqr(l->of.gloss), sin2 = alpha2 * m_expm1(-u1 * m_log(alpha2)) / (1 - alpha2);
    vec3 wh = cylindrical(sqrt(sin2), 2 * PI * u2, safe_sqrt(1 - sin2));
    *wi = sub(mul(wh, 2 * dot(wo, wh)), wo);
    return wo.z * wi->z > 0;
}
