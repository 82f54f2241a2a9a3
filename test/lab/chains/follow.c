/* follow.c: see follow.h. */
#include "chains/follow.h"

/* Leave y_0, or a surface by a lobe that is not delta, in a given direction. */
static bool depart_towards(const struct walk *w, struct vertex *v, vec3 wi, struct departure *out)
{
    const struct light_set *lights = &w->scene->lights;
    struct departure from = {.ray = {v->p, wi, ray_margin(v->p), INFINITY, v->prim_id, 0}};
    if (v->kind == VERTEX_LIGHT) {
        struct light_point at = vertex_light_point(w->scene, v);
        bool area = lights->light[v->light].kind == LIGHT_AREA;
        v->beta = light_Le(lights, &at, wi);
        from.pdf = light_pdf_emission(lights, &at, wi);
        from.beta = rgb_scale(v->beta, (area ? abs_dot(v->ng, wi) : 1) / (v->pdf_fwd * from.pdf));
    } else {
        struct bsdf_value b = bsdf_eval(&v->bsdf, v->wo, wi, IMPORTANCE);
        from.pdf = b.pdf;
        from.pdf_rev = b.pdf_rev;
        from.beta = rgb_mul(v->beta, rgb_scale(b.f, scatter_cosine(v, wi, IMPORTANCE) / b.pdf));
    }
    *out = from;
    return from.pdf > 0 && !rgb_is_black(from.beta) && rgb_is_finite(from.beta);
}

int follow_light(const struct walk *w, const struct path_stop *stop, int n, struct vertex *path)
{
    struct departure from;
    path[0] = stop[0].v;
    for (int i = 1; i < n; i++) {
        struct vertex *prev = &path[i - 1], *v = &path[i];
        bool parallel = vertex_at_infinity(w->scene, prev);
        vec3 d = parallel ? neg(prev->wo) : sub(stop[i].v.p, prev->p);
        double d2 = length2(d);
        d = mul(d, 1 / sqrt(d2));
        if (!(stop[i - 1].delta ? walk_leave(w, prev, IMPORTANCE, &from) : depart_towards(w, prev, d, &from)))
            return i;
        from.ray.d = d;
        *v = stop[i].v;
        v->prev_delta = from.delta;
        v->wo = neg(d);
        v->beta = from.beta;
        walk_measure(w, v, prev, &from, d2);
        v->eye_hit = LATER_HIT;
        v->mis_c = n_before(w->counts, prev, v, IMPORTANCE);
    }
    return n;
}

int follow_on(const struct walk *w, struct vertex *path, int n, vec3 wi, int max_vertices, double *pdf)
{
    struct departure from;
    if (!depart_towards(w, &path[n - 1], wi, &from))
        return n;
    *pdf = from.pdf;
    return walk_on(w, from, path, n, max_vertices, IMPORTANCE);
}
