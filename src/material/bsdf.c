/* bsdf.c: sums over lobes, see bsdf.h. One lobe's formulas are in lobe.c. */
#include "material/bsdf.h"

#include "base/warp.h"

void bsdf_make(struct bsdf *b, struct lobe *lobe, int n)
{
    const double even = 0.125;
    b->lobe = lobe;
    b->n_lobes = b->n_smooth = 0;
    b->transmits = false;
    double total = 0;
    for (int i = 0; i < n; i++) {
        double guess = lobe[i].choice = lobe_albedo_guess(&lobe[i]);
        if (!(guess > 0))
            continue;
        total += guess;
        b->n_smooth += !lobe_is_delta(lobe[i].kind);
        b->transmits |= lobe[i].kind == LOBE_LAMBERT_TRANSMISSION || lobe[i].kind == LOBE_MICROFACET_TRANSMISSION ||
                        lobe[i].kind == LOBE_PHASE || (lobe[i].kind == LOBE_FORM && lobe[i].form->transmits);
        if (i > b->n_lobes)
            lobe[b->n_lobes] = lobe[i];
        b->n_lobes++;
    }
    for (int i = 0; i < b->n_lobes; i++)
        lobe[i].choice = b->n_lobes == 1 ? 1 : even / b->n_lobes + (1 - even) * lobe[i].choice / total;
    b->diffuse = b->n_lobes == 1 && lobe->kind == LOBE_LAMBERT_REFLECTION;
    if (b->diffuse)
        lobe->of.diffuse = rgb_scale(rgb_mul(lobe->R, lobe->scale), INV_PI);
}

struct bsdf_value bsdf_eval_lobes(const struct bsdf *b, vec3 wo, vec3 wi, bool reflect, enum transport mode)
{
    vec3 o = to_local(&b->shading, wo), i = to_local(&b->shading, wi);
    struct bsdf_value sum = NO_SCATTERING;
    for (const struct lobe *l = b->lobe; l < b->lobe + b->n_lobes; l++) {
        struct bsdf_value v = lobe_eval(l, o, i, reflect, mode);
        sum.f = rgb_add(sum.f, v.f);
        sum.pdf += l->choice * v.pdf;
        sum.pdf_rev += l->choice * v.pdf_rev;
    }
    return rgb_is_black(sum.f) ? NO_SCATTERING : sum;
}

/* Choose a lobe with *u and replace *u by what is left of it, uniform again. */
static const struct lobe *choose_lobe(const struct bsdf *b, double *u)
{
    const struct lobe *l = b->lobe, *last = b->lobe + b->n_lobes - 1;
    while (l < last && *u >= l->choice) {
        *u -= l->choice;
        l++;
    }
    if (b->n_lobes > 1)
        *u = below_one(*u / l->choice);
    return l;
}

/* A direction from a smooth lobe. False if the facet drawn sends nothing on. */
static bool sample_smooth(const struct bsdf *b, const struct lobe *l, vec3 o, const double u[3],
                          struct bsdf_sample *out)
{
    vec3 i;
    if (!lobe_sample(l, o, to_local(&b->shading, b->ng), u, &i))
        return false;
    out->wi = to_world(&b->shading, i);
    out->eta = 1;
    if (l->kind == LOBE_MICROFACET_TRANSMISSION)
        out->eta = o.z > 0 ? l->eta_b / l->eta_a : l->eta_a / l->eta_b;
    return true;
}

bool bsdf_sample(const struct bsdf *b, vec3 wo, const double u[3], enum transport mode, struct bsdf_sample *out)
{
    if (b->diffuse) { /* the same as below, in the world */
        vec3 wi = to_world(&b->shading, warp_cos_hemisphere(u[1], u[2]));
        out->wi = dot(wi, b->ng) * dot(wo, b->ng) > 0 ? wi : neg(wi);
        out->eta = 1;
    } else {
        vec3 o = to_local(&b->shading, wo);
        if (b->n_lobes == 0 || o.z == 0)
            return false;
        double rest[3] = {u[0], u[1], u[2]};
        const struct lobe *l = choose_lobe(b, &rest[0]);
        if (lobe_is_delta(l->kind)) {
            if (!lobe_sample_delta(l, o, rest[0], mode, out) || rgb_is_black(out->f))
                return false;
            out->wi = to_world(&b->shading, out->wi);
            out->pdf *= l->choice;
            out->pdf_rev *= l->choice;
            return true;
        }
        if (!sample_smooth(b, l, o, rest, out))
            return false;
    }
    struct bsdf_value v = bsdf_eval(b, wo, out->wi, mode);
    out->f = v.f;
    out->pdf = v.pdf;
    out->pdf_rev = v.pdf_rev;
    out->delta = false;
    return v.pdf > 0;
}
