/* bump.c: see bump.h. */
#include "material/bump.h"

/* Texture coordinates by which the displacement is differenced: pbrt-v3's choice for rays without differentials. */
static const double STEP = 0.0005;

/* The displacement a step away from the point. */
static double displaced(const struct texture_set *textures, int id, const struct surface *at, double du, double dv)
{
    struct surface shifted = *at;
    shifted.p = add(at->p, add(mul(at->dpdu, du), mul(at->dpdv, dv)));
    shifted.u = at->u + du;
    shifted.v = at->v + dv;
    return texture_float(textures, id, &shifted);
}

/* Partial derivative of the displaced point p + d ns: dp + (dd) ns + d (dns). */
static vec3 partial(vec3 dp, vec3 dn, vec3 ns, double d, double d_shifted)
{
    return add(add(dp, mul(ns, (d_shifted - d) / STEP)), mul(dn, d));
}

struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at)
{
    double d = texture_float(textures, displacement, at);
    vec3 dpdu = partial(at->dpdu, at->dndu, at->ns, d, displaced(textures, displacement, at, STEP, 0));
    vec3 dpdv = partial(at->dpdv, at->dndv, at->ns, d, displaced(textures, displacement, at, 0, STEP));
    vec3 n = normalize(cross(dpdu, dpdv));
    if (!(fabs(length2(n) - 1) < 1e-6)) /* zero, NaN, or lost in under- or overflow */
        return frame_from_tangent(at->ns, at->dpdu);
    return frame_from_tangent(faceforward(n, at->ng), dpdu);
}
