/* lobe.c: see lobe.h. Values [PBRT3 8.2-8.5], sampling [PBRT3 14.1]; Oren-Nayar [Oren & Nayar 1994]; rough
 * dielectrics [Walter 2007]; substrate [Ashikhmin & Shirley 2000]. */
#include "material/lobe.h"

#include "base/warp.h"
#include "material/microfacet.h"

bool lobe_is_delta(enum lobe_kind kind)
{
    return kind == LOBE_SPECULAR_REFLECTION || kind == LOBE_SPECULAR_TRANSMISSION || kind == LOBE_FRESNEL_SPECULAR;
}

/* A dielectric reflects 0.04 at normal incidence and 1 at grazing; a quarter is never wrong by more than a factor
 * of 6, and errs towards the highlights. */
static double reflected_share(const struct lobe *l)
{
    if (l->fresnel == FRESNEL_DISNEY)
        return 0.25 + 0.75 * l->of.tinted.metallic;
    return l->fresnel == FRESNEL_DIELECTRIC ? 0.25 : 1;
}

double lobe_albedo_guess(const struct lobe *l)
{
    double r = rgb_mean(rgb_mul(l->scale, l->R)), t = rgb_mean(rgb_mul(l->scale, l->T));
    switch (l->kind) {
    case LOBE_LAMBERT_REFLECTION:
    case LOBE_PHASE:
    case LOBE_OREN_NAYAR: return r;
    case LOBE_LAMBERT_TRANSMISSION:
    case LOBE_SPECULAR_TRANSMISSION:
    case LOBE_MICROFACET_TRANSMISSION: return t;
    case LOBE_SPECULAR_REFLECTION:
    case LOBE_MICROFACET_REFLECTION: return r * reflected_share(l);
    case LOBE_FRESNEL_SPECULAR: return fmax(r, t);
    case LOBE_FRESNEL_BLEND: return r + rgb_mean(rgb_mul(l->scale, l->of.coat));
    case LOBE_FORM: return l->form->guess(l);
    }
    return 0;
}

/* --- diffuse lobes ----------------------------------------------------------------------------------- */

/* NO_SCATTERING unless the directions are on the sides that the lobe is for. */
struct bsdf_value lobe_diffuse(bool there, rgb f, vec3 wo, vec3 wi)
{
    struct bsdf_value v = {f, fabs(wi.z) * INV_PI, fabs(wo.z) * INV_PI};
    return there ? v : NO_SCATTERING;
}

/* The original has sin(alpha) tan(beta) with alpha the larger and beta the smaller of the two angles, and the
 * cosine of the difference of azimuths; the two sines cancel against those of the azimuths. [Oren & Nayar 1994] */
static rgb oren_nayar(const struct lobe *l, vec3 wo, vec3 wi)
{
    double azimuth = fmax(0, wo.x * wi.x + wo.y * wi.y); /* sin_o sin_i cos(phi_o - phi_i) */
    double slant = azimuth / fmax(fabs(wo.z), fabs(wi.z));
    return rgb_scale(l->R, INV_PI * (l->of.oren_nayar.A + l->of.oren_nayar.B * slant));
}

vec3 lobe_sample_diffuse(vec3 wo, vec3 ng, bool reflect, double u1, double u2)
{
    vec3 wi = warp_cos_hemisphere(u1, u2);
    bool same_side = dot(wi, ng) * dot(wo, ng) > 0;
    return same_side == reflect ? wi : neg(wi);
}

/* --- rough reflection -------------------------------------------------------------------------------- */

/* The share that a facet reflects. cos_h is the cosine to the facet's normal, signed like fresnel_dielectric's. */
static rgb facet_fresnel(const struct lobe *l, double cos_h)
{
    switch (l->fresnel) {
    case FRESNEL_NONE: break;
    case FRESNEL_DIELECTRIC: return rgb_grey(fresnel_dielectric(cos_h, l->eta_a, l->eta_b));
    case FRESNEL_CONDUCTOR: return fresnel_conductor(cos_h, l->of.conductor.eta, l->of.conductor.k);
    case FRESNEL_DISNEY:
        return fresnel_disney(cos_h, l->eta_a, l->eta_b, l->of.tinted.normal, l->of.tinted.metallic);
    }
    return rgb_grey(1);
}

/* The area of all facets per area of those that both directions see. */
static double masking(const struct lobe *l, double lambda_o, double lambda_i)
{
    return 1 + lambda_o + lambda_i + (l->separate ? lambda_o * lambda_i : 0);
}

/* f = R F D G / (4 cos_o cos_i). The density of wh given wo is D |wo.wh| / ((1 + lambda_o) |cos_o|), and
 * reflection spreads d(wi) = 4 |wo.wh| d(wh), so that |wo.wh| drops out of both pdfs. [PBRT3 8.4.4] [PBRT3 14.1.1] */
static struct bsdf_value microfacet_reflection(const struct lobe *l, vec3 wo, vec3 wi, bool reflect)
{
    if (!(wo.z * wi.z > 0))
        return NO_SCATTERING;
    vec3 wh = normalize(add(wo, wi));
    double lambda_o = microfacet_lambda(wo, l->alpha_x, l->alpha_y);
    double lambda_i = microfacet_lambda(wi, l->alpha_x, l->alpha_y);
    double d4 = 0.25 * microfacet_d(wh, l->alpha_x, l->alpha_y);
    struct bsdf_value v = NO_SCATTERING;
    v.pdf = d4 / ((1 + lambda_o) * fabs(wo.z));
    v.pdf_rev = d4 / ((1 + lambda_i) * fabs(wi.z));
    if (reflect) {
        double cos_h = dot(wi, wh) * (wh.z < 0 ? -1 : 1); /* positive above, on the eta_a side */
        double dg = d4 / (masking(l, lambda_o, lambda_i) * wo.z * wi.z);
        v.f = rgb_scale(rgb_mul(l->R, facet_fresnel(l, cos_h)), dg);
    }
    return v;
}

static bool sample_microfacet_reflection(const struct lobe *l, vec3 wo, double u1, double u2, vec3 *wi)
{
    vec3 wh = microfacet_sample(wo, l->alpha_x, l->alpha_y, u1, u2);
    *wi = sub(mul(wh, 2 * dot(wo, wh)), wo);
    return wo.z * wi->z > 0;
}

/* --- rough transmission ------------------------------------------------------------------------------ */

/* The facet normal half way between the two directions is wh ~ wo + eta wi with eta = eta_i/eta_o
 * [Walter 2007 eq. 16]. With n = wo.wh + eta wi.wh the density of wi is eta^2 |wi.wh| / n^2 times that of wh
 * [Walter 2007 eq. 17]. Written with
 *     J = D |wo.wh| |wi.wh| / n^2
 * all three numbers become short, and the symmetry shows: reversing the pair replaces eta by 1/eta, n by n/eta.
 *     pdf     = eta^2 J / ((1 + lambda_o) |cos_o|)
 *     pdf_rev = J / ((1 + lambda_i) |cos_i|)
 *     f       = eta^2 J (1-F) T / ((1 + lambda_o + lambda_i) |cos_o cos_i|)    for importance;
 * radiance is compressed by 1/eta^2 [V97 5.2]. */
static struct bsdf_value microfacet_transmission(const struct lobe *l, vec3 wo, vec3 wi, bool reflect,
                                                 enum transport mode)
{
    if (!(wo.z * wi.z < 0))
        return NO_SCATTERING;
    double eta = wo.z > 0 ? l->eta_b / l->eta_a : l->eta_a / l->eta_b;
    vec3 wh = normalize(add(wo, mul(wi, eta)));
    wh = wh.z * wo.z < 0 ? neg(wh) : wh;
    double cos_oh = dot(wo, wh), cos_ih = dot(wi, wh);
    if (!(cos_oh > 0 && cos_ih < 0)) /* the facet's back is turned to one of them */
        return NO_SCATTERING;
    double lambda_o = microfacet_lambda(wo, l->alpha_x, l->alpha_y);
    double lambda_i = microfacet_lambda(wi, l->alpha_x, l->alpha_y);
    double j = microfacet_d(wh, l->alpha_x, l->alpha_y) * cos_oh * -cos_ih / sqr(cos_oh + eta * cos_ih);
    struct bsdf_value v = NO_SCATTERING;
    v.pdf = eta * eta * j / ((1 + lambda_o) * fabs(wo.z));
    v.pdf_rev = j / ((1 + lambda_i) * fabs(wi.z));
    if (!reflect) {
        double cos_h = wo.z > 0 ? cos_oh : -cos_oh; /* positive above, on the eta_a side */
        double through = 1 - fresnel_dielectric(cos_h, l->eta_a, l->eta_b);
        double scale = (mode == RADIANCE ? 1 : eta * eta) * j / (masking(l, lambda_o, lambda_i) * fabs(wo.z * wi.z));
        v.f = rgb_scale(l->T, through * scale);
    }
    return v;
}

static bool sample_microfacet_transmission(const struct lobe *l, vec3 wo, double u1, double u2, vec3 *wi)
{
    vec3 wh = microfacet_sample(wo, l->alpha_x, l->alpha_y, u1, u2);
    double eta = wo.z > 0 ? l->eta_a / l->eta_b : l->eta_b / l->eta_a;
    return fresnel_refract(wo, wh, eta, wi) && wo.z * wi->z < 0;
}

/* --- substrate --------------------------------------------------------------------------------------- */

/* A diffuse base under a glossy coat, by Schlick's form of Fresnel's share. [Ashikhmin & Shirley 2000] [PBRT3 8.5] */
static double pow5(double x) { return sqr(sqr(x)) * x; }

static rgb fresnel_blend(const struct lobe *l, vec3 wo, vec3 wi, vec3 wh)
{
    double cos_o = fabs(wo.z), cos_i = fabs(wi.z), cos_h = dot(wi, wh);
    rgb white = rgb_grey(1), coat = l->of.coat;
    double base = 28 / (23 * PI) * (1 - pow5(1 - 0.5 * cos_i)) * (1 - pow5(1 - 0.5 * cos_o));
    rgb diffuse_part = rgb_scale(rgb_mul(l->R, rgb_sub(white, coat)), base);
    rgb schlick = rgb_add(coat, rgb_scale(rgb_sub(white, coat), pow5(1 - cos_h)));
    double d = microfacet_d(wh, l->alpha_x, l->alpha_y) / (4 * fabs(cos_h) * fmax(cos_o, cos_i));
    return rgb_add(diffuse_part, rgb_scale(schlick, d));
}

/* Half of the samples come from each of the two layers. */
static struct bsdf_value substrate(const struct lobe *l, vec3 wo, vec3 wi, bool reflect)
{
    struct bsdf_value coat = microfacet_reflection(l, wo, wi, false);
    struct bsdf_value v = lobe_diffuse(reflect, fresnel_blend(l, wo, wi, normalize(add(wo, wi))), wo, wi);
    v.pdf = 0.5 * (v.pdf + coat.pdf);
    v.pdf_rev = 0.5 * (v.pdf_rev + coat.pdf_rev);
    return v;
}

/* --- media -------------------------------------------------------------------------------------------- */

/* [PBRT3 11.2] [PBRT3 15.2]; wo and wi point away, so that straight on is -1. */
static struct bsdf_value phase(double g, double cosine)
{
    double d = 1 + g * g + 2 * g * cosine, p = INV_PI / 4 * (1 - g * g) / (d * sqrt(d));
    return (struct bsdf_value){rgb_grey(p), p, p};
}

static vec3 sample_phase(double g, vec3 wo, double u1, double u2)
{
    double s = (1 - g * g) / (1 - g + 2 * g * u1);
    double c = fabs(g) < 1e-6 ? 1 - 2 * u1 : clamp((1 + g * g - s * s) / (2 * g), -1, 1);
    struct frame f = frame_from_normal(neg(wo));
    return to_world(&f, cylindrical(safe_sqrt(1 - c * c), 2 * PI * u2, c));
}

/* --- all lobes that are not delta -------------------------------------------------------------------- */

struct bsdf_value lobe_eval(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode)
{
    struct bsdf_value v = NO_SCATTERING;
    if (l->kind != LOBE_PHASE && (wo.z == 0 || wi.z == 0)) /* along the surface */
        return NO_SCATTERING;
    switch (l->kind) {
    case LOBE_LAMBERT_REFLECTION: v = lobe_diffuse(reflect, rgb_scale(l->R, INV_PI), wo, wi); break;
    case LOBE_LAMBERT_TRANSMISSION: v = lobe_diffuse(!reflect, rgb_scale(l->T, INV_PI), wo, wi); break;
    case LOBE_OREN_NAYAR: v = lobe_diffuse(reflect, oren_nayar(l, wo, wi), wo, wi); break;
    case LOBE_MICROFACET_REFLECTION: v = microfacet_reflection(l, wo, wi, reflect); break;
    case LOBE_MICROFACET_TRANSMISSION: v = microfacet_transmission(l, wo, wi, reflect, mode); break;
    case LOBE_FRESNEL_BLEND: v = substrate(l, wo, wi, reflect); break;
    case LOBE_PHASE: v = phase(l->of.g, dot(wo, wi)); break;
    case LOBE_FORM: v = l->form->eval(l, wo, wi, reflect, mode); break;
    case LOBE_SPECULAR_REFLECTION:
    case LOBE_SPECULAR_TRANSMISSION:
    case LOBE_FRESNEL_SPECULAR: break;
    }
    v.f = rgb_mul(v.f, l->scale);
    return v;
}

bool lobe_sample(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi)
{
    switch (l->kind) {
    case LOBE_LAMBERT_REFLECTION:
    case LOBE_OREN_NAYAR: *wi = lobe_sample_diffuse(wo, ng, true, u[1], u[2]); return true;
    case LOBE_LAMBERT_TRANSMISSION: *wi = lobe_sample_diffuse(wo, ng, false, u[1], u[2]); return true;
    case LOBE_MICROFACET_REFLECTION: return sample_microfacet_reflection(l, wo, u[1], u[2], wi);
    case LOBE_PHASE: *wi = sample_phase(l->of.g, wo, u[1], u[2]); return true;
    case LOBE_FORM: return l->form->sample(l, wo, ng, u, wi);
    case LOBE_MICROFACET_TRANSMISSION: return sample_microfacet_transmission(l, wo, u[1], u[2], wi);
    case LOBE_FRESNEL_BLEND:
        if (u[0] >= 0.5)
            return sample_microfacet_reflection(l, wo, u[1], u[2], wi);
        *wi = lobe_sample_diffuse(wo, ng, true, u[1], u[2]);
        return true;
    case LOBE_SPECULAR_REFLECTION:
    case LOBE_SPECULAR_TRANSMISSION:
    case LOBE_FRESNEL_SPECULAR: break;
    }
    return false;
}

/* --- delta lobes ------------------------------------------------------------------------------------- */

static bool sample_mirror(const struct lobe *l, vec3 wo, rgb share, double probability, struct bsdf_sample *out)
{
    out->wi = vec(-wo.x, -wo.y, wo.z);
    out->f = rgb_scale(rgb_mul(rgb_mul(l->R, l->scale), share), 1 / fabs(wo.z));
    out->pdf = out->pdf_rev = probability;
    out->eta = 1;
    return true;
}

/* Refraction, and the density of walking it backwards.
 *
 * Forwards, wi is drawn with density P delta(wi - r(wo)) with respect to d(wi), where r refracts and P is the
 * probability of choosing to. Backwards, wo is drawn with P' delta(wo - r^-1(wi)) with respect to d(wo). MIS
 * divides one by the other, so both must be multiples of the *same* delta. Changing its variable,
 *     delta(wo - r^-1(wi)) = |d(wi)/d(wo)| delta(wi - r(wo)),
 * hence pdf_rev = P' d(wi)/d(wo). Refraction keeps eta^2 cos d(w) [V97 5.2], so with eta = eta_i/eta_o
 *     d(wi)/d(wo) = eta_o^2 cos_o / (eta_i^2 cos_i) = cos_o / (eta^2 cos_i).
 * For the reversed walk eta, cos_o and cos_i change places and the ratio pdf_rev/pdf turns into its inverse, as
 * it must. P' = P: both depend on Fresnel's share only, which is the same from both sides. */
static bool sample_refraction(const struct lobe *l, vec3 wo, double share, double probability, enum transport mode,
                              struct bsdf_sample *out)
{
    double eta = wo.z > 0 ? l->eta_b / l->eta_a : l->eta_a / l->eta_b; /* eta_i/eta_o */
    if (!fresnel_refract(wo, vec(0, 0, wo.z > 0 ? 1 : -1), 1 / eta, &out->wi))
        return false;
    double cos_i = fabs(out->wi.z), compression = mode == RADIANCE ? 1 / (eta * eta) : 1;
    out->f = rgb_scale(rgb_mul(l->T, l->scale), share * compression / cos_i);
    out->pdf = probability;
    out->pdf_rev = probability * fabs(wo.z) / (eta * eta * cos_i);
    out->eta = eta;
    return true;
}

/* The probability with which smooth glass reflects: in proportion to what is reflected and transmitted; this keeps
 * a black R or T from being chosen, and is Fresnel's share for clear glass. */
static double reflection_probability(const struct lobe *l, double fresnel)
{
    double r = fresnel * rgb_mean(l->R), t = (1 - fresnel) * rgb_mean(l->T);
    return r + t > 0 ? r / (r + t) : 0;
}

bool lobe_sample_delta(const struct lobe *l, vec3 wo, double u, enum transport mode, struct bsdf_sample *out)
{
    out->delta = true;
    if (l->kind == LOBE_SPECULAR_REFLECTION)
        return sample_mirror(l, wo, facet_fresnel(l, wo.z), 1, out);
    double fresnel = fresnel_dielectric(wo.z, l->eta_a, l->eta_b);
    double p = l->kind == LOBE_FRESNEL_SPECULAR ? reflection_probability(l, fresnel) : 0;
    if (u < p)
        return sample_mirror(l, wo, rgb_grey(fresnel), p, out);
    return sample_refraction(l, wo, 1 - fresnel, 1 - p, mode, out);
}
