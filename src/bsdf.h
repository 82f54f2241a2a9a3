/* bsdf.h: how a surface point scatters light, and how to sample that.
 *
 * A BSDF is a sum of lobes in a shading frame. wo and wi are unit vectors pointing away from the surface; wo is
 * the direction the walk came from, wi the one it goes to. As in pbrt-v3, the *geometric* normal decides
 * whether a pair is reflection or transmission, the *shading* normal enters the lobes' formulas.
 *
 * Transport mode: refraction compresses radiance by (eta_i/eta_t)^2 but not importance [V97 5.2], so lobes
 * that transmit need to know which of the two is carried. RADIANCE: walking from the eye; IMPORTANCE: walking
 * from a light. The factor for shading normals is applied in path.c, not here.
 *
 * Delta lobes (mirror, smooth glass) have no density: bsdf_eval leaves them out and bsdf_sample marks them.
 *
 * Used by: material (makes them), path and connect. Tests: test_bsdf.c.
 */
#ifndef ASBDPT_BSDF_H
#define ASBDPT_BSDF_H

#include <stdbool.h>

#include "frame.h"
#include "rgb.h"
#include "vec.h"

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
    LOBE_FRESNEL_BLEND /* pbrt's substrate [Ashikhmin & Shirley 2000] */
};

enum fresnel_kind { FRESNEL_NONE, FRESNEL_DIELECTRIC, FRESNEL_CONDUCTOR };

/* One lobe; which fields matter depends on kind. */
struct lobe {
    enum lobe_kind kind;
    enum fresnel_kind fresnel;
    rgb R;                   /* reflectance of a reflecting lobe; diffuse part of FRESNEL_BLEND */
    rgb T;                   /* transmittance of a transmitting lobe; specular part of FRESNEL_BLEND */
    rgb eta, k;              /* conductor: complex index relative to the outside */
    double eta_a, eta_b;     /* dielectric: index above (side of the normal) and below */
    double alpha_x, alpha_y; /* Trowbridge-Reitz roughness along s and t */
    double A, B;             /* Oren-Nayar coefficients */
};

struct bsdf {
    struct frame shading;    /* n is the shading normal */
    vec3 ng;                 /* geometric normal, unit */
    const struct lobe *lobe; /* [n_lobes], in the arena the bsdf was made in */
    int n_lobes;
    int n_smooth;            /* lobes that are not delta; 0: no connection can end here */
};

/* What bsdf_eval knows about a pair of directions. */
struct bsdf_value {
    rgb f;          /* 1/sr, without any cosine; delta lobes left out */
    double pdf;     /* density of bsdf_sample(wo) returning wi, 1/sr; delta lobes left out */
    double pdf_rev; /* density of bsdf_sample(wi) returning wo, 1/sr */
};

/* What bsdf_sample drew. */
struct bsdf_sample {
    vec3 wi;
    rgb f;          /* value for wi, 1/sr; of a delta lobe: the coefficient of the delta over |cos(wi, ns)| */
    double pdf;     /* 1/sr; of a delta lobe: the probability of choosing it */
    double pdf_rev; /* the same for the reversed pair; delta transmission: times d(wo)/d(wi), see bsdf.c */
    bool delta;
    double eta;     /* (index on wi's side)/(index on wo's side) for transmission, else 1 */
};

/* bsdf_eval: value and both densities for a pair of directions, summed over all smooth lobes. Cannot fail. */
struct bsdf_value bsdf_eval(const struct bsdf *b, vec3 wo, vec3 wi, enum transport mode);

/* bsdf_sample: draw wi given wo.
 *   u  three uniform numbers in [0,1): lobe choice and direction
 * Returns false when the sample is absorbed (black, below the surface, total internal reflection). For a smooth
 * lobe f, pdf and pdf_rev equal bsdf_eval's for the same pair. */
bool bsdf_sample(const struct bsdf *b, vec3 wo, const double u[3], enum transport mode, struct bsdf_sample *out);

/* fresnel_dielectric: unpolarised reflectance for a ray meeting the boundary at cos_i (signed: positive on the
 * eta_a side); 1 under total internal reflection. */
double fresnel_dielectric(double cos_i, double eta_a, double eta_b);

/* fresnel_conductor: unpolarised reflectance of a metal of complex index eta + i k. */
rgb fresnel_conductor(double cos_i, rgb eta, rgb k);

#endif
