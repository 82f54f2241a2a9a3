/* lobe.h: one way of scattering, in the shading frame (the normal is z, on the eta_a side).
 *
 * wo and wi are unit vectors pointing away from the surface; wo is the direction the walk came from, wi the one it goes
 * to. Formulas are pbrt-v3's, so that images agree; sampling is our own where it can be better.
 *
 * Two planes decide on which side a direction is. The *geometric* one says whether a pair (wo, wi) is reflection or
 * transmission (`reflect` below, found by bsdf.c); the *shading* one enters the formulas. Where they disagree
 *   - diffuse lobes have the value they have everywhere, and a sample that falls on the wrong side of the geometric
 *     plane is turned round to -wi: that keeps its density |cos|/pi and reaches all directions where it is not black;
 *   - facets are only met by pairs that lie on the right sides of the shading plane too, and whose facet faces both
 *     directions; other pairs are black, but of LOBE_FRESNEL_BLEND, which draws them too. (pbrt-v3 evaluates its
 *     formulas there although it never samples such pairs, so that its own integrators disagree: by 1 % on glass of
 *     alpha 0.7, not visibly below 0.1.)
 *
 * Tests: test_lobe.c, test_bsdf.c.
 */
#ifndef ASBDPT_LOBE_H
#define ASBDPT_LOBE_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/vec.h"

/* What is being carried against the walk's direction: radiance when walking from the eye, importance when
 * walking from a light. Refraction compresses radiance by (eta_i/eta_t)^2 but not importance [V97 5.2]. */
enum transport { RADIANCE, IMPORTANCE };

enum lobe_kind {
    LOBE_LAMBERT_REFLECTION,
    LOBE_LAMBERT_TRANSMISSION,
    LOBE_OREN_NAYAR,
    LOBE_SPECULAR_REFLECTION,   /* delta; fresnel may be none (mirror) */
    LOBE_SPECULAR_TRANSMISSION, /* delta; dielectric */
    LOBE_FRESNEL_SPECULAR,      /* delta; smooth glass: reflection or transmission by Fresnel's share */
    LOBE_MICROFACET_REFLECTION,
    LOBE_MICROFACET_TRANSMISSION,
    LOBE_FRESNEL_BLEND, /* pbrt's substrate [Ashikhmin & Shirley 2000] */
    LOBE_PHASE, /* of a medium, in no plane: the frame does not matter */
    LOBE_FORM   /* of a file of its own */
};

enum fresnel_kind { FRESNEL_NONE, FRESNEL_DIELECTRIC, FRESNEL_CONDUCTOR, FRESNEL_DISNEY };

struct fourier_table;
struct lobe_form;

/* One lobe. */
struct lobe {
    enum lobe_kind kind;
    const struct lobe_form *form; /* of LOBE_FORM */
    enum fresnel_kind fresnel; /* what share facets and mirrors reflect */
    bool separate;             /* facets hide from wo and from wi independently */
    rgb scale;                 /* multiplies the lobe's value: shares of mix materials; 1 otherwise */
    rgb R, T;                  /* reflectance, transmittance; black where there is none */
    double eta_a, eta_b;       /* dielectric: index above (side of the normal) and below */
    double alpha_x, alpha_y;   /* Trowbridge-Reitz roughness along s and t, > 0 */
    double choice;             /* probability with which bsdf_sample takes this lobe; set by bsdf_make */
    union {
        rgb diffuse; /* f of LOBE_LAMBERT_REFLECTION, if it is the only one; set by bsdf_make */
        struct {
            double A, B; /* the two coefficients of the formula */
        } oren_nayar;
        struct {
            rgb eta, k; /* complex index relative to the outside */
        } conductor;    /* of FRESNEL_CONDUCTOR */
        struct {
            rgb normal;      /* reflectance at normal incidence */
            double metallic; /* how much of a metal it is */
        } tinted;            /* of FRESNEL_DISNEY */
        rgb coat;            /* reflectance of the layer above, of LOBE_FRESNEL_BLEND; R is of what is below */
        struct {
            rgb flat, retro, sheen; /* the three parts besides R */
            double roughness;
        } disney;     /* of burley.h's form_disney */
        double gloss; /* alpha of form_coat's own distribution */
        double g;     /* of LOBE_PHASE */
        const struct fourier_table *table; /* of fourier.h's form_fourier */
    } of;
};

/* What is known about a pair of directions. */
struct bsdf_value {
    rgb f;          /* 1/sr, without any cosine; delta lobes left out */
    double pdf;     /* density of sampling wi given wo, 1/sr; delta lobes left out */
    double pdf_rev; /* density of sampling wo given wi, 1/sr */
};
static const struct bsdf_value NO_SCATTERING = {{0, 0, 0}, 0, 0};

/* A drawn direction. A walk multiplies its throughput by f / pdf and by the cosine of scatter_cosine (vertex.h). */
struct bsdf_sample {
    vec3 wi;
    rgb f;      /* value for wi, 1/sr; of a delta lobe: the coefficient of the delta over |cos(wi, ns)| */
    double pdf; /* 1/sr; of a delta lobe: the probability of choosing it (and of LOBE_FRESNEL_SPECULAR the branch) */
    double pdf_rev; /* the same for the reversed pair, 1/sr; of a delta lobe: the probability of choosing it from
                     * wi, times d(wi)/d(wo) = cos_o / (eta^2 cos_i) when it transmits, see lobe.c */
    bool delta;
    double eta; /* (index on wi's side)/(index on wo's side) for refraction, else 1 */
};

/* lobe_albedo_guess, lobe_eval without the scale, and lobe_sample of a LOBE_FORM. No form is delta. */
struct lobe_form {
    double (*guess)(const struct lobe *l);
    struct bsdf_value (*eval)(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode);
    bool (*sample)(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi);
    bool transmits;
};

bool lobe_is_delta(enum lobe_kind kind);

/* lobe_albedo_guess: about how much of the light it gets the lobe sends on, in every direction the same, so that it
 * can be a choice probability for both directions of a walk. > 0 unless the lobe is black. */
double lobe_albedo_guess(const struct lobe *l);

/* lobe_eval: value and densities of a lobe that is not delta; all zero for a delta lobe, and on a
 * surface for a direction along it.
 *   reflect  whether wo and wi lie on the same side of the geometric plane
 * A pdf may be positive where f is 0: such samples are drawn and then absorbed. */
struct bsdf_value lobe_eval(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode);

/* lobe_sample: draw wi given wo from a lobe that is not delta, with lobe_eval's density.
 *   ng  geometric normal in the shading frame
 *   u   three uniform numbers in [0,1)
 * Returns false when the facet drawn sends nothing on: total internal reflection, or into the surface. */
bool lobe_sample(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi);

/* lobe_diffuse: what is diffuse, of value f, on one side alone; is wi there? lobe_sample_diffuse: as lobe_sample. */
struct bsdf_value lobe_diffuse(bool there, rgb f, vec3 wo, vec3 wi);
vec3 lobe_sample_diffuse(vec3 wo, vec3 ng, bool reflect, double u1, double u2);

/* lobe_sample_delta: the direction of a delta lobe, and what goes there; fills *out in the shading frame.
 *   u  uniform in [0,1), chooses between reflection and transmission of LOBE_FRESNEL_SPECULAR
 * Returns false when nothing is sent on. */
bool lobe_sample_delta(const struct lobe *l, vec3 wo, double u, enum transport mode, struct bsdf_sample *out);

#endif
