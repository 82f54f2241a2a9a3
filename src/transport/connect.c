/* connect.c: see connect.h. */
#include "transport/connect.h"

#include "base/alias.h"
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

/* The weight (7) of mis.h, of the sums (5) at the start and the end of an edge, whose densities are their factors. */
static inline double weigh(const struct counts *counts, double n, const struct edge *e, double start, double end)
{
    return mis_weight(counts, n, end * mis_raise(counts, e->density[1]), start * mis_raise(counts, e->density[0]));
}

struct connection connect_hit(const struct scene *scene, const struct counts *counts, const struct vertex *prev,
                              const struct vertex *z, int t)
{
    const struct light_set *lights = &scene->lights;
    struct connection c = {.light = -1};
    z = z->lamp != NULL ? z->lamp : z;
    if (z->light < 0 || (t == 2 && z->kind == VERTEX_SURFACE && lights->light[z->light].hidden))
        return c;
    struct light_point at = vertex_light_point(z);
    c.light = z->light;
    rgb Le = z->kind == VERTEX_ESCAPED ? light_Le_sky(lights, at.w, t == 2) : light_Le(lights, &at, z->wo);
    c.value = rgb_mul(z->beta, Le); /* C* = alpha_t Le [V97 10.2] */
    c.weight = 1;
    if (rgb_is_black(c.value) || t == 2)
        return c;
    /* n of s = 1, which connects prev to z; z->mis_c is n of s >= 2 */
    double c_e = z->prev_delta ? 0 : n_direct(counts, prev->region, prev->eye_end, z->cell);
    /* density of the direction of the light sub-path's first ray; at infinity, of its origin */
    const vec3 start = z->kind == VERTEX_ESCAPED ? prev->p : z->p;
    double pdf_emit = emission_pdf(&counts->tables->emission, lights, &at, start, z->wo);
    double eye_side = mis_side(counts, z->pdf_origin, z->pdf_fwd, c_e, pdf_emit, z->mis); /* mis.h (5) */
    c.weight = mis_weight(counts, counts->hit[prev->eye_end], 0, eye_side); /* mis.h (7), A_light being 0 */
    return c;
}

bool connect_light_draw(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                        struct sampler *sampler, int i, int n, struct light_point *at, double *pdf)
{
    const struct light_set *lights = &scene->lights;
    const struct table *table = &counts->tables->direct;
    double u[3], pmf;
    double number = below_one((i + sampler_number(sampler, DRAW_LIGHT)) / n);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    at->light = at->cell = -1;
    if (!vertex_connectible(z) || lights->choice.n == 0)
        return false;
    int cell = table->rows > 0 ? table_draw(table, z->region, table_all(table), number, &pmf, &u[0])
                               : alias_sample(&lights->choice, number, &pmf, &u[0]);
    if (!light_sample_cell(lights, &scene->geo, cell, u, at))
        return false;
    *pdf = pmf * at->pdf_cell;
    return at->pdf > 0;
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
    double spread = parallel ? 1 : 1 / d2;
    /* area (at infinity: solid angle) at y_0 per steradian at z */
    double at_light = light->kind == LIGHT_AREA ? abs_dot(at->n, w) * spread : spread;
    /* C* = (Le / pdf) c alpha_t, c = G f: the cosine at z is in the factor [V97 10.2] */
    rgb value = rgb_mul(rgb_mul(z->beta, at_z.factor), rgb_scale(Le, at_light / pdf));
    *out = (struct lit){.z = z, .at = *at, .pdf = pdf, .value = value, .pdf_z = at_z.pdf, .pdf_rev_z = at_z.pdf_rev,
                        .at_light = at_light, .w = w, .distance = distance, .spread = spread};
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
    double hit = light_is_delta(&lights->light[at->light]) ? 0 : counts->hit[z->eye_end];
    /* mis.h (5); the light side has the strategy s = 0 alone */
    double light = mis_side(counts, l->pdf_z * l->at_light, at->pdf, hit, 0, 0);
    double pdf_emit = emission_pdf(&counts->tables->emission, lights, at, z->p, neg(l->w));
    double pdf_z = pdf_emit * vertex_cosine(z, l->w) * l->spread;
    double eye = mis_side(counts, pdf_z, z->pdf_fwd, z->mis_c, l->pdf_rev_z, z->mis);
    double count = n_direct(counts, z->region, z->eye_end, at->cell);
    struct connection c = {.value = rgb_mul(l->value, edge.left), .light = at->light};
    c.weight = weigh(counts, count, &edge, eye, light);
    return c;
}

struct connection connect_direct(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                                 struct sampler *sampler, int i, int n, struct light_point *y0)
{
    struct lit l;
    double pdf;
    struct connection c = {.light = -1};
    if (connect_light_draw(scene, counts, z, sampler, i, n, y0, &pdf) && connect_light(scene, z, y0, pdf, &l))
        c = connect_lit(scene, counts, &l);
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
    double light = mis_side(counts, j->pdf_z * j->area_y, y->pdf_fwd, y->mis_c, j->pdf_rev_y, y->mis);
    double eye = mis_side(counts, j->pdf_y * j->area_z, z->pdf_fwd, z->mis_c, j->pdf_rev_z, z->mis);
    c.value = rgb_mul(j->value, edge.left);
    double n = n_pair(counts, z->region, z->eye_end, y->region);
    c.weight = weigh(counts, n, &edge, eye, light);
    return c;
}

struct connection connect_pair(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                               const struct vertex *z)
{
    struct joint j;
    return connect_join(y, z, &j) ? connect_joint(scene, counts, &j) : (struct connection){.light = -1};
}

struct connection connect_lens(const struct scene *scene, const struct counts *counts, const struct vertex *light,
                               int s, struct sampler *sampler)
{
    const struct vertex *y = &light[s - 1];
    double u[2] = {0, 0};
    if (scene->camera.lens_radius > 0)
        sampler_pair(sampler, DRAW_LENS_POINT, u);
    if (!vertex_connectible(y))
        return (struct connection){.light = -1};
    vec3 lens = camera_sample_lens(&scene->camera, y->p, u[0], u[1]);
    vec3 d = sub(y->p, lens);
    double d2 = length2(d);
    if (!(d2 > 0) || !bsdf_may_scatter(&y->bsdf, y->wo, neg(d)))
        return (struct connection){.light = -1};
    double distance = sqrt(d2);
    vec3 w = mul(d, 1 / distance);
    struct connection c = {.light = -1};
    double J = camera_project(&scene->camera, lens, w, &c.px, &c.py);
    const double rx = scene->filter.radius[0], ry = scene->filter.radius[1];
    if (J == 0 || c.px < -rx || c.py < -ry || c.px > scene->width + rx || c.py > scene->height + ry)
        return (struct connection){.light = -1};
    struct scatter at_y = scatter_towards(y, neg(w), IMPORTANCE);
    /* C* = alpha_s f (We cos / lens density) [V97 10.2], and We cos / (lens density) = J, see camera.h. */
    double density = J * camera_spread(&scene->camera, d2);
    c.value = rgb_mul(y->beta, rgb_scale(at_y.factor, density));
    struct edge edge;
    if (rgb_is_black(c.value) || !see(scene, y, neg(w), distance, 0, false, &edge))
        return (struct connection){.light = -1};
    c.value = rgb_mul(c.value, edge.left);
    /* The light walk counted y as a later hit. Next to the lens it is the first hit, so c_e differs from y->mis_c. If
     * s = 2, the count of s = 0 in y->mis differs, too. */
    double c_e = c_light(counts, &light[s - 2], y, FIRST_HIT);
    double mis = y->mis;
    if (s == 2 && !light_is_delta(&scene->lights.light[light[0].light]))
        mis = mis_step(counts, counts->hit[FIRST_HIT], 0, 0, light[0].pdf_fwd, y->back);
    double light_side = mis_side(counts, density * vertex_cosine(y, w), y->pdf_fwd, c_e, at_y.pdf_rev, mis);
    c.weight = weigh(counts, counts->lens, &edge, light_side, 0);
    return c;
}
