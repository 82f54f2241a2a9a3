/* delta.c: see delta.h. */
#include "caustics/delta.h"

bool bsdf_delta(const struct bsdf *b, vec3 wo, bool transmit, enum transport mode, struct bsdf_sample *out)
{
    vec3 o = to_local(&b->shading, wo);
    bool found = false;
    for (const struct lobe *l = b->lobe; o.z != 0 && l < b->lobe + b->n_lobes; l++) {
        struct bsdf_sample s;
        if (!lobe_is_delta(l->kind) || !lobe_sample_delta(l, o, transmit ? below_one(1) : 0, mode, &s) ||
            (s.wi.z * o.z < 0) != transmit || rgb_is_black(s.f) || (found && length2(sub(s.wi, out->wi)) > 1e-24))
            continue;
        s.f = rgb_scale(s.f, fabs(s.wi.z));
        s.pdf *= l->choice;
        s.pdf_rev *= l->choice;
        if (found) {
            s.f = rgb_add(s.f, out->f);
            s.pdf += out->pdf;
            s.pdf_rev += out->pdf_rev;
        }
        *out = s;
        found = true;
    }
    if (found)
        out->wi = to_world(&b->shading, out->wi);
    return found;
}

/* All delta lobes with one direction have the same ratio of the two densities. */
static double delta_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode)
{
    vec3 w = neg(next->wo), o = to_local(&v->bsdf.shading, v->wo), i = to_local(&v->bsdf.shading, w);
    double falloff = next->kind == VERTEX_ESCAPED ? 1 : 1 / length2(sub(next->p, v->p));
    double pdf = next->pdf_fwd / (vertex_cosine(next, w) * falloff);
    for (const struct lobe *l = v->bsdf.lobe; l < v->bsdf.lobe + v->bsdf.n_lobes; l++) {
        struct bsdf_sample s;
        if (lobe_is_delta(l->kind) && lobe_sample_delta(l, o, i.z * o.z < 0 ? below_one(1) : 0, mode, &s) &&
            length2(sub(s.wi, i)) < 1e-16)
            return pdf * s.pdf_rev / s.pdf;
    }
    return 0;
}

double vertex_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode)
{
    if (v->kind != VERTEX_SURFACE && v->kind != VERTEX_MEDIUM)
        return 0;
    return next->prev_delta ? delta_pdf_rev(v, next, mode) : bsdf_eval(&v->bsdf, v->wo, neg(next->wo), mode).pdf_rev;
}
