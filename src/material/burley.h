/* burley.h: the lobes of the Disney BSDF that other materials do not have [Burley 2012] [Burley 2015], as pbrt-v3's.
 * Directions are those of lobe.h.
 *
 * Tests: test_lobe.c, test_bsdf.c.
 */
#ifndef ASBDPT_BURLEY_H
#define ASBDPT_BURLEY_H

#include "material/lobe.h"

/* disney_diffuse: f of LOBE_DISNEY_DIFFUSE, 1/sr. wo.z, wi.z != 0. */
rgb disney_diffuse(const struct lobe *l, vec3 wo, vec3 wi);

/* disney_fresnel: the share that facets of FRESNEL_DISNEY reflect, between a dielectric's and a metal's; cos_h as of
 * fresnel_dielectric. */
rgb disney_fresnel(const struct lobe *l, double cos_h);

/* disney_coat, disney_coat_sample: lobe_eval and lobe_sample of LOBE_CLEARCOAT, without its scale. */
struct bsdf_value disney_coat(const struct lobe *l, vec3 wo, vec3 wi, bool reflect);
bool disney_coat_sample(const struct lobe *l, vec3 wo, double u1, double u2, vec3 *wi);

#endif
