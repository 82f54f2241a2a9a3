/* bsdf.h: how a surface point scatters light, and how to sample that: a sum of lobes (lobe.h) in a shading frame.
 *
 * Delta lobes (mirror, smooth glass) have no density: bsdf_eval leaves them out and bsdf_sample marks them. The factor
 * for shading normals is applied in vertex.h, not here.
 *
 * Tests: test_bsdf.c.
 */
#ifndef ASBDPT_BSDF_H
#define ASBDPT_BSDF_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/vec.h"
#include "material/lobe.h"

struct bsdf {
    struct frame shading;    /* n is the shading normal */
    vec3 ng;                 /* geometric normal, unit */
    const struct lobe *lobe; /* [n_lobes], in the arena the bsdf was made in */
    int n_lobes;
    int n_smooth;            /* lobes that are not delta; 0: no connection can end here */
    bool transmits;          /* one of these lets light through */
    bool diffuse;            /* it is one LOBE_LAMBERT_REFLECTION, the commonest by far, and f is its `diffuse` */
};

/* bsdf_make: a BSDF of n >= 0 lobes, whose shading and ng are to be filled in. The array is kept, not copied; black
 * lobes are taken out of it, and `choice` is filled in: in proportion to lobe_albedo_guess, with an eighth spread
 * evenly so that no lobe starves. It does not depend on directions, so both directions of a walk choose alike. */
void bsdf_make(struct bsdf *b, struct lobe *lobe, int n);

/* bsdf_may_scatter: false where bsdf_eval is black for no other reason than that wo and wi lie on different sides of a
 * surface that lets nothing through. It is asked before anything that costs more. wi may have any length. */
static inline bool bsdf_may_scatter(const struct bsdf *b, vec3 wo, vec3 wi)
{
    return b->transmits || dot(wi, b->ng) * dot(wo, b->ng) > 0;
}

/* bsdf_eval: value and both densities for a pair of directions, summed over all smooth lobes. Where the value is
 * black both densities are 0: bsdf_sample never returns such a pair. Swapping wo and wi swaps pdf and pdf_rev, and
 * f(wo, wi, RADIANCE) = f(wi, wo, IMPORTANCE). Cannot fail. bsdf_eval_lobes is for bsdf_eval alone. */
struct bsdf_value bsdf_eval_lobes(const struct bsdf *b, vec3 wo, vec3 wi, bool reflect, enum transport mode);

static inline struct bsdf_value bsdf_eval(const struct bsdf *b, vec3 wo, vec3 wi, enum transport mode)
{
    bool reflect = dot(wi, b->ng) * dot(wo, b->ng) > 0;
    if (b->n_smooth == 0 || !(b->transmits || reflect))
        return NO_SCATTERING;
    if (b->diffuse)
        return (struct bsdf_value){b->lobe->of.diffuse, abs_dot(wi, b->shading.n) * INV_PI,
                                   abs_dot(wo, b->shading.n) * INV_PI};
    return bsdf_eval_lobes(b, wo, wi, reflect, mode);
}

/* bsdf_sample: draw wi given wo.
 *   u  three uniform numbers in [0,1): lobe choice and direction
 * Returns false when the sample is absorbed (black, below the surface, total internal reflection): the integral of
 * pdf over the sphere is the probability of *not* being absorbed. For a smooth lobe f, pdf and pdf_rev equal
 * bsdf_eval's for the same pair; for a delta lobe see struct bsdf_sample. */
bool bsdf_sample(const struct bsdf *b, vec3 wo, const double u[3], enum transport mode, struct bsdf_sample *out);

#endif
