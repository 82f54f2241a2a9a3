/* joint.c: see joint.h. */
#include "caustics/joint.h"

#include "tables/emission.h"

/* Scattering at a surface vertex towards wi: factor of the throughput, and both densities (1/sr). */
struct scatter {
    rgb factor; /* f times scatter_cosine */
    double pdf, pdf_rev;
};

static inline struct scatter scatter_towards(const struct vertex *v, vec3 wi, enum transport mode)
{
    struct bsdf_value b = bsdf_eval(&v->bsdf, v->wo, wi, mode);
    struct scatter s = {{0, 0, 0}, b.pdf, b.pdf_rev};
    if (!rgb_is_black(b.f))
        s.factor = rgb_scale(b.f, scatter_cosine(v, wi, mode));
    return s;
}

/* The edge from vertex a over a distance in direction w to a point on primitive `to`, where light is emitted or
 * scattered; false if surfaces stop it. What media leave is a factor of the connection's value. */
static inline bool see(const struct scene *scene, const struct vertex *a, vec3 w, double distance, uint64_t to,
                       bool emitted, struct edge *out)
{
    struct ray ray = {a->p, w, 0, distance, a->prim_id, to};
    return scene_edge(scene, &ray, vertex_medium(scene, a, w), emitted, out);
}

bool connect_light(const struct scene *scene, const struct vertex *z, const struct light_point *at, double pdf,
                   struct lit *out)
{
    const struct light_set *lights = &scene->lights;
    const struct light *light = &lights->light[at->light];
    bool parallel = light_at_infinity(light);
    vec3 d = parallel ? at->w : sub(at->p, z->p);
    double d2 = length2(d);
    out->value = rgb_black();
    if (!(d2 > 0) || !bsdf_may_scatter(&z->bsdf, z->wo, d))
        return false;
    double distance = parallel ? INFINITY : sqrt(d2);
    vec3 w = mul(d, 1 / sqrt(d2));
    rgb Le = light_Le(lights, at, neg(w));
    if (rgb_is_black(Le))
        return false;
    struct scatter at_z = scatter_towards(z, w, RADIANCE);
    double falloff = parallel ? 1 : 1 / d2;
    /* area (at infinity: solid angle) at y_0 per steradian at z */
    double at_light = light->kind == LIGHT_AREA ? abs_dot(at->n, w) * falloff : falloff;
    /* C* = (Le / pdf) c alpha_t, c = G f: the cosine at z is in the factor [V97 10.2] */
    rgb value = rgb_mul(rgb_mul(z->beta, at_z.factor), rgb_scale(Le, at_light / pdf));
    *out = (struct lit){.z = z, .at = *at, .pdf = pdf, .value = value, .pdf_z = at_z.pdf, .pdf_rev_z = at_z.pdf_rev,
                        .at_light = at_light, .w = w, .distance = distance, .falloff = falloff};
    return !rgb_is_black(value);
}

struct connection connect_lit(const struct scene *scene, const struct counts *counts, const struct lit *l)
{
    const struct light_set *lights = &scene->lights;
    const struct vertex *z = l->z;
    const struct light_point *at = &l->at;
    struct edge edge;
    if (rgb_is_black(l->value) || !see(scene, z, l->w, l->distance, at->prim_id, true, &edge))
        return (struct connection){.light = -1};
    double hit = light_is_delta(&lights->light[at->light]) ? 0 : counts->s0[z->eye_hit];
    /* mis.h (5); the light side has the strategy s = 0 alone */
    double light = mis_side(l->pdf_z * l->at_light, at->pdf, hit, 0, 0);
    double pdf_emit = emission_pdf(&counts->tables->emission, lights, at, z->p, neg(l->w));
    double pdf_z = pdf_emit * vertex_cosine(z, l->w) * l->falloff;
    double eye = mis_side(pdf_z, z->pdf_fwd, z->mis_c, l->pdf_rev_z, z->mis);
    double count = n_s1(counts, z->place, z->eye_hit, at->cell);
    struct connection c = {.value = rgb_mul(l->value, edge.left), .light = at->light};
    c.weight = mis_weight(count, light * edge.density[1], eye * edge.density[0]); /* mis.h (7) */
    return c;
}

bool connect_join(const struct vertex *y, const struct vertex *z, struct joint *out)
{
    vec3 d = sub(y->p, z->p);
    double d2 = length2(d);
    out->value = rgb_black();
    if (!vertex_connectible(y) || !vertex_connectible(z) || !(d2 > 0))
        return false;
    if (!bsdf_may_scatter(&z->bsdf, z->wo, d) || !bsdf_may_scatter(&y->bsdf, y->wo, neg(d)))
        return false;
    double distance = sqrt(d2);
    vec3 w = mul(d, 1 / distance);
    struct scatter at_z = scatter_towards(z, w, RADIANCE);
    if (rgb_is_black(at_z.factor))
        return false;
    struct scatter at_y = scatter_towards(y, neg(w), IMPORTANCE);
    /* C* = alpha_s c alpha_t, c = f G f: both cosines are in the factors [V97 10.2] */
    rgb value = rgb_mul(rgb_mul(y->beta, at_y.factor), rgb_scale(rgb_mul(z->beta, at_z.factor), 1 / d2));
    *out = (struct joint){.y = y, .z = z, .value = value, .pdf_y = at_y.pdf, .pdf_z = at_z.pdf,
                          .pdf_rev_y = at_y.pdf_rev, .pdf_rev_z = at_z.pdf_rev, .length = distance, .w = w,
                          .area_y = vertex_cosine(y, w) / d2, .area_z = vertex_cosine(z, w) / d2};
    return !rgb_is_black(value);
}

struct connection connect_joint(const struct scene *scene, const struct counts *counts, const struct joint *j)
{
    const struct vertex *y = j->y, *z = j->z;
    struct connection c = {.light = -1};
    struct edge edge;
    if (rgb_is_black(j->value) || !see(scene, z, j->w, j->length, y->prim_id, false, &edge))
        return c;
    /* mis.h (5), of both sides */
    double light = mis_side(j->pdf_z * j->area_y, y->pdf_fwd, y->mis_c, j->pdf_rev_y, y->mis);
    double eye = mis_side(j->pdf_y * j->area_z, z->pdf_fwd, z->mis_c, j->pdf_rev_z, z->mis);
    c.value = rgb_mul(j->value, edge.left);
    double n = n_pair(counts, z->place, z->eye_hit, y->place);
    c.weight = mis_weight(n, light * edge.density[1], eye * edge.density[0]); /* mis.h (7) */
    return c;
}
