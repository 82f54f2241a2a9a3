/* oracle.c: the balance heuristic as it is defined: w_s = p_s / sum_i p_i, with
 *     p_i = n_i prod (densities of light vertices) prod (densities of eye vertices),                       [V97 10.2]
 * each per unit area, multiplied out one strategy at a time. What mis.h computes in O(1) is this; nothing is shared
 * with it but the sample counts. */
#include "oracle.h"

#include "material/microfacet.h"
#include "tables/emission.h"

/* The whole path, light first. */
struct full_path {
    const struct scene *scene;
    const struct counts *counts;
    const struct vertex *x[64]; /* x[0] on the light, x[n-1] on the lens */
    bool delta[64];             /* the path passes here by a delta lobe */
    int n;
};

static bool at_infinity(const struct full_path *f, int i)
{
    const struct vertex *v = f->x[i];
    return v->kind == VERTEX_ESCAPED || vertex_at_infinity(f->scene, v);
}

/* Unit direction from vertex i to vertex j, neighbours. */
static vec3 direction(const struct full_path *f, int i, int j)
{
    if (at_infinity(f, j))
        return f->x[j]->kind == VERTEX_ESCAPED ? neg(f->x[j]->wo) : f->x[j]->wo;
    if (at_infinity(f, i))
        return neg(direction(f, j, i));
    return normalize(sub(f->x[j]->p, f->x[i]->p));
}

/* exp(-sigma d) of one channel; or, of channel ALL, the mean of it, of the light that is scattered times sigma. */
enum { ALL = 3 };
static double left_of(const struct medium *m, double d, bool scattered, int channel)
{
    const double sigma[3] = {m->sigma_t.r, m->sigma_t.g, m->sigma_t.b};
    double sum = 0;
    if (channel < ALL)
        return sigma[channel] > 0 ? exp(-sigma[channel] * d) : 1;
    for (int c = 0; c < 3; c++)
        sum += (scattered ? sigma[c] : 1) * (sigma[c] > 0 ? exp(-sigma[c] * d) : 1) / 3;
    return sum;
}

/* Density with which a walk that goes from vertex i towards its neighbour j gets there, and, if that is within a
 * medium, is scattered there, 1/m: of the pieces that interfaces cut. Or a channel's share that is left. */
static double flight(const struct full_path *f, int i, int j, int channel)
{
    const struct scene *s = f->scene;
    int a = at_infinity(f, i) ? j : i, b = i + j - a; /* it is as likely both ways, but for the ends */
    const struct vertex *v = f->x[a];
    vec3 w = direction(f, a, b);
    struct ray ray = {v->p, w, end_margin(v->p, v->prim_id), INFINITY, v->prim_id, f->x[b]->prim_id};
    int medium = v->medium;
    double q = 1;
    if (s->space == NULL)
        return 1;
    if (v->prim_id != 0 && v->prim_id != WITHIN_MEDIUM) {
        const struct shape_group *g = shape_group_of(&s->geo, shape_prim(v->prim_id));
        medium = g->medium[0] != g->medium[1] ? g->medium[dot(v->ng, w) > 0] : medium;
    }
    for (bool first = true, last = false; !last; first = false) {
        struct hit hit;
        struct surface at;
        if (!at_infinity(f, b))
            ray.tmax = length(sub(f->x[b]->p, ray.o));
        last = !kd_closest(&s->space->interfaces, &s->geo, &ray, &hit);
        bool scattered = f->x[j]->kind == VERTEX_MEDIUM && (a == j ? first : last);
        if (medium > 0)
            q *= left_of(&s->space->medium[medium - 1], last ? ray.tmax : hit.t, scattered, channel);
        if (last)
            break;
        shape_surface(&s->geo, &hit, &ray, &at);
        medium = shape_group_of(&s->geo, hit.prim)->medium[dot(w, at.ng) > 0];
        ray.o = at.p;
        ray.from = at.prim_id;
        ray.tmin = ray_margin(at.p);
    }
    return q;
}

/* Density per area (at infinity: per steradian, within a medium: per volume) of vertex j, reached from its neighbour i
 * with density pdf_w. */
static double per_area(const struct full_path *f, int i, int j, double pdf_w)
{
    pdf_w *= flight(f, i, j, ALL);
    if (at_infinity(f, j))
        return pdf_w;
    vec3 w = direction(f, i, j);
    bool across = f->x[j]->kind == VERTEX_LENS || f->x[j]->kind == VERTEX_MEDIUM ||
                  (f->x[j]->kind == VERTEX_LIGHT && length2(f->x[j]->ng) == 0);
    double cosine = across ? 1 : abs_dot(f->x[j]->ng, w);
    return at_infinity(f, i) ? pdf_w * cosine : pdf_w * cosine / length2(sub(f->x[j]->p, f->x[i]->p));
}

/* Mirror and smooth glass: probability with which the lobe is chosen, and the Jacobian of the reverse delta. */
static double delta_density(const struct full_path *f, int from, int i, int to, bool reverse)
{
    const struct vertex *v = f->x[i];
    const struct lobe *l = &v->bsdf.lobe[0];
    vec3 wo = direction(f, i, from), wi = direction(f, i, to);
    double cos_o = dot(wo, v->bsdf.shading.n), cos_i = dot(wi, v->bsdf.shading.n);
    if (l->kind == LOBE_SPECULAR_REFLECTION)
        return 1;
    double F = fresnel_dielectric(cos_o, l->eta_a, l->eta_b);
    if (cos_o * cos_i > 0)
        return F;
    double eta_o = cos_o > 0 ? l->eta_a : l->eta_b, eta_i = cos_o > 0 ? l->eta_b : l->eta_a;
    /* The reverse walk's delta lives in d(wo); written as a coefficient of the forward one, in d(wi), it gains
     * d(wi)/d(wo) = eta_o^2 |cos_o| / (eta_i^2 |cos_i|). Forward is the direction of the light's travel. */
    return reverse ? (1 - F) * eta_o * eta_o * fabs(cos_o) / (eta_i * eta_i * fabs(cos_i)) : 1 - F;
}

/* The path's light point; at infinity what lies in its direction, looked up anew. */
static struct light_point light_point(const struct full_path *f)
{
    const struct light_set *lights = &f->scene->lights;
    struct light_point y0 = vertex_light_point(f->scene, f->x[0]);
    y0.w = at_infinity(f, 0) ? direction(f, 1, 0) : y0.w;
    if (lights->light[y0.light].kind == LIGHT_INFINITE)
        light_pdf_sky(lights, y0.w, &y0.cell);
    return y0;
}

/* What is learnt makes the density of the first ray so many times as large. */
static double learnt_emission(const struct full_path *f, const struct light_point *y0)
{
    const struct table *table = &f->counts->tables->emission;
    return table_ratio(table, 0, emission_column_of(&f->scene->lights, y0, f->x[1]->p, direction(f, 0, 1)));
}

/* Density of x_j when the light walk makes it. */
static double light_density(const struct full_path *f, int j)
{
    if (j == 0) {
        const struct vertex *v = f->x[0];
        const struct surface on = {.light = v->light, .ng = v->ng};
        int cell;
        return v->kind == VERTEX_LIGHT     ? v->pdf_fwd
               : v->kind == VERTEX_ESCAPED ? light_pdf_sky(&f->scene->lights, neg(v->wo), &cell)
                                           : light_pdf_surface(&f->scene->lights, &f->scene->geo, &on);
    }
    if (j == 1) {
        struct light_point y0 = light_point(f);
        double pdf = f->x[0]->kind == VERTEX_ESCAPED ? 1 / (PI * sqr(f->scene->lights.radius))
                                                     : light_pdf_emission(&f->scene->lights, &y0, direction(f, 0, 1));
        return per_area(f, 0, 1, pdf * learnt_emission(f, &y0));
    }
    const struct vertex *v = f->x[j - 1];
    double pdf = f->delta[j - 1]
                     ? delta_density(f, j - 2, j - 1, j, false)
                     : bsdf_eval(&v->bsdf, direction(f, j - 1, j - 2), direction(f, j - 1, j), IMPORTANCE).pdf;
    return per_area(f, j - 1, j, pdf);
}

/* Density of x_j when the eye walk makes it. */
static double eye_density(const struct full_path *f, int j)
{
    int last = f->n - 1;
    if (j == last)
        return 1;
    if (j == last - 1) {
        double px, py;
        double J = camera_project(&f->scene->camera, f->x[last]->p, direction(f, last, j), &px, &py);
        if (f->scene->camera.parallel) /* J is per area across the ray already */
            return flight(f, last, j, ALL) *
                   (at_infinity(f, j) ? J : J * vertex_cosine(f->x[j], direction(f, last, j)));
        return per_area(f, last, j, J);
    }
    const struct vertex *v = f->x[j + 1];
    double pdf = f->delta[j + 1]
                     ? delta_density(f, j, j + 1, j + 2, true) /* as the light walk passes it, reversed */
                     : bsdf_eval(&v->bsdf, direction(f, j + 1, j + 2), direction(f, j + 1, j), RADIANCE).pdf;
    return per_area(f, j + 1, j, pdf);
}

/* Which hit x_i is, i >= 1: the first that is not seen by way of delta lobes alone? */
static enum eye_hit hit_of(const struct full_path *f, int i)
{
    for (int j = i + 1; j < f->n - 1; j++)
        if (!f->delta[j])
            return LATER_HIT;
    return FIRST_HIT;
}

/* The normal of x_i on the side of x_next, the next vertex of the walk that comes from there; of a surface that lets
 * light through the one it has. */
static vec3 side(const struct full_path *f, int i, int next)
{
    vec3 n = f->x[i]->ng;
    return f->x[i]->bsdf.transmits || dot(n, direction(f, i, next)) > 0 ? n : neg(n);
}

/* The region of x_i for a walk that comes from x_next, looked up anew. */
static int region(const struct full_path *f, int i, int next)
{
    return region_at(&f->counts->tables->regions, f->x[i]->p, side(f, i, next));
}

/* The factor of the density of x_0 if s = 1 draws it. */
static double learnt_direct(const struct full_path *f)
{
    return table_ratio(&f->counts->tables->guide, region(f, 1, 2), light_point(f).cell);
}

/* n of the strategy with i light vertices, 0 if it cannot make this path. */
static double samples(const struct full_path *f, int i)
{
    const struct counts *m = f->counts;
    int t = f->n - i;
    if (i == 0) {
        bool delta_light = f->x[0]->kind == VERTEX_LIGHT && light_is_delta(&f->scene->lights.light[f->x[0]->light]);
        return delta_light ? 0 : m->s0[hit_of(f, 1)];
    }
    if (t < 1 || f->delta[i - 1] || f->delta[i])
        return 0;
    if (t == 1)
        return m->lens;
    if (i == 1)
        return m->s1[hit_of(f, i)] * learnt_direct(f);
    double ratio = table_ratio(&m->tables->pairs, region(f, i, i + 1), region(f, i - 1, i - 2));
    double x = m->pair[hit_of(f, i)] * ratio, bound = m->bound[hit_of(f, i)] * ratio;
    return x - x * bound / (1 + bound);
}

/* A vertex whose walk goes on (not the end of a connection) passed by delta if the next vertex says so. */
static bool join(struct full_path *f, const struct vertex *light, int s, const struct vertex *eye, int t)
{
    f->n = s + t;
    for (int i = 0; i < s; i++) {
        f->x[i] = &light[i];
        f->delta[i] = i + 1 < s && light[i + 1].prev_delta;
    }
    for (int i = 0; i < t; i++) {
        f->x[s + t - 1 - i] = &eye[i];
        f->delta[s + t - 1 - i] = i + 1 < t && eye[i + 1].prev_delta;
    }
    for (int i = 0; i < f->n; i++)
        if (f->delta[i] && (f->x[i]->bsdf.n_lobes != 1 || (f->x[i]->bsdf.lobe[0].kind != LOBE_SPECULAR_REFLECTION &&
                                                           f->x[i]->bsdf.lobe[0].kind != LOBE_FRESNEL_SPECULAR)))
            return false;
    return f->n <= 64;
}

bool oracle_weights(const struct scene *scene, const struct counts *counts, const struct vertex *light, int s,
                    const struct vertex *eye, int t, double *weight)
{
    struct full_path f = {.scene = scene, .counts = counts};
    if (!join(&f, light, s, eye, t))
        return false;
    long double sum = 0, p[65];
    for (int i = 0; i < f.n; i++) { /* i light vertices, f.n - i >= 1 eye vertices */
        p[i] = samples(&f, i);
        for (int j = 0; j < f.n && p[i] > 0; j++)
            p[i] *= j < i ? light_density(&f, j) : eye_density(&f, j);
        sum += p[i];
    }
    for (int i = 0; i < f.n; i++)
        weight[i] = sum > 0 ? (double)(p[i] / sum) : 0;
    return sum > 0;
}

/* What is left of light on the edge from i to j, over the density of the flight. */
static rgb left_over(const struct full_path *f, int i, int j)
{
    rgb left = rgb_make(flight(f, i, j, 0), flight(f, i, j, 1), flight(f, i, j, 2));
    return rgb_scale(left, 1 / flight(f, i, j, ALL));
}

/* f of the path, as the eye sees it: each surface scatters radiance that comes from the light's side. The lens counts
 * as the walk from it does, by its density. */
static rgb contribution(const struct full_path *f)
{
    const struct light_set *lights = &f->scene->lights;
    struct light_point y0 = light_point(f);
    rgb all = f->x[0]->kind == VERTEX_ESCAPED ? light_Le_sky(lights, direction(f, 1, 0), false)
                                              : light_Le(lights, &y0, direction(f, 0, 1));
    for (int i = 1; i < f->n - 1; i++) {
        vec3 w = direction(f, i, i - 1);
        rgb scattered = bsdf_eval(&f->x[i]->bsdf, direction(f, i, i + 1), w, RADIANCE).f;
        bool medium = f->x[i]->kind == VERTEX_MEDIUM;
        double cosine = medium ? 1 : abs_dot(f->x[i]->bsdf.shading.n, w);
        all = rgb_mul(all, rgb_scale(scattered, cosine * per_area(f, i, i - 1, 1)));
        all = rgb_mul(all, left_over(f, i, i - 1));
        all = medium ? rgb_mul(all, f->scene->space->medium[f->x[i]->medium - 1].sigma_s) : all;
    }
    return rgb_scale(rgb_mul(all, left_over(f, f->n - 1, f->n - 2)), eye_density(f, f->n - 2));
}

bool oracle_value(const struct scene *scene, const struct counts *counts, const struct vertex *light, int s,
                  const struct vertex *eye, int t, rgb *value)
{
    struct full_path f = {.scene = scene, .counts = counts};
    if (!join(&f, light, s, eye, t))
        return false;
    double p = s == 1 ? learnt_direct(&f) : 1;
    for (int i = 0; i < f.n; i++) {
        if (f.delta[i])
            return false;
        p *= i < s ? light_density(&f, i) : eye_density(&f, i);
    }
    *value = rgb_scale(contribution(&f), 1 / p);
    return p > 0;
}

double oracle_length(const struct scene *scene, const struct vertex *light, int s, const struct vertex *eye, int t)
{
    struct full_path f = {.scene = scene};
    double sum = 0;
    join(&f, light, s, eye, t);
    for (int i = 1; i < f.n; i++) {
        vec3 w = direction(&f, i, i - 1), from = f.x[i - 1]->p;
        if (at_infinity(&f, i - 1))
            from = add(scene->lights.center, mul(w, scene->lights.radius));
        sum += at_infinity(&f, i - 1) ? fmax(dot(sub(from, f.x[i]->p), w), 0) : length(sub(from, f.x[i]->p));
    }
    return sum;
}
