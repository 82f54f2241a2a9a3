/* burley.c: see burley.h. */
#include "material/burley.h"

#include "base/maths.h"
#include "base/number.h"
#include "material/microfacet.h"

static double mix(double t, double a, double b) { return (1 - t) * a + t * b; }

/* Darker at grazing angles; what retro-reflection adds there on rough surfaces; a flat look, as if light was scattered
 * beneath; the sheen of cloth. The angle between wi and half way to wo has the cosine
 * sqrt((1 + wo.wi)/2). [Burley 2012 5.3] [Burley 2015 3] */
static struct bsdf_value diffuse_eval(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode)
{
    (void)mode;
    double cos2_d = fmax(0, 0.5 * (1 + dot(wo, wi)));
    double cos_o = fabs(wo.z), cos_i = fabs(wi.z), fo = fresnel_schlick(cos_o), fi = fresnel_schlick(cos_i);
    double grazing = l->of.disney.roughness * cos2_d, back = 2 * grazing;
    double beneath = mix(fo, 1, grazing) * mix(fi, 1, grazing);
    rgb f = rgb_scale(l->R, INV_PI * (1 - 0.5 * fo) * (1 - 0.5 * fi));
    f = rgb_add(f, rgb_scale(l->of.disney.flat, INV_PI * 1.25 * (beneath * (1 / (cos_o + cos_i) - 0.5) + 0.5)));
    f = rgb_add(f, rgb_scale(l->of.disney.retro, INV_PI * back * (fo + fi + fo * fi * (back - 1))));
    f = rgb_add(f, rgb_scale(l->of.disney.sheen, fresnel_schlick(sqrt(cos2_d))));
    return lobe_diffuse(reflect, f, wo, wi);
}

static bool diffuse_sample(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi)
{
    (void)l;
    *wi = lobe_sample_diffuse(wo, ng, true, u[1], u[2]);
    return true;
}

static double diffuse_guess(const struct lobe *l)
{
    return rgb_mean(rgb_mul(l->scale, l->R)) + rgb_mean(rgb_mul(l->scale, l->of.disney.flat)) +
           0.25 * rgb_mean(rgb_mul(l->scale, rgb_add(l->of.disney.retro, l->of.disney.sheen)));
}

const struct lobe_form form_disney = {diffuse_guess, diffuse_eval, diffuse_sample, false};

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
static struct bsdf_value coat_eval(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode)
{
    (void)mode;
    if (!(wo.z * wi.z > 0))
        return NO_SCATTERING;
    vec3 wh = normalize(add(wo, wi));
    double d = coat_d(wh, l->of.gloss), pdf = d * fabs(wh.z) / (4 * dot(wo, wh));
    double schlick = mix(fresnel_schlick(dot(wo, wh)), 0.04, 1);
    double value = reflect ? 0.25 * d * schlick * coat_masking(fabs(wo.z)) * coat_masking(fabs(wi.z)) : 0;
    return (struct bsdf_value){rgb_scale(l->R, value), pdf, pdf};
}

/* sin^2 = (alpha2^(1-u) - alpha2) / (1 - alpha2) turns the cumulative distribution round. */
static bool coat_sample(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi)
{
    (void)ng;
    double alpha2 = sqr(l->of.gloss), sin2 = alpha2 * m_expm1(-u[1] * m_log(alpha2)) / (1 - alpha2);
    vec3 wh = cylindrical(sqrt(sin2), 2 * PI * u[2], safe_sqrt(1 - sin2));
    *wi = sub(mul(wh, 2 * dot(wo, wh)), wo);
    return wo.z * wi->z > 0;
}

static double coat_guess(const struct lobe *l) { return 0.1 * rgb_mean(rgb_mul(l->scale, l->R)); }

const struct lobe_form form_coat = {coat_guess, coat_eval, coat_sample, false};
