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
