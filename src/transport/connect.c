/* connect.c: see connect.h. */
#include "transport/connect.h"

#include "base/alias.h"
#include "tables/emission.h"

struct connection connect_s0(const struct scene *scene, const struct counts *counts, const struct vertex *prev,
                              const struct vertex *z)
{
    const struct light_set *lights = &scene->lights;
    const bool seen = prev->kind == VERTEX_LENS;
    struct connection c = {.light = -1};
    z = z->lamp != NULL ? z->lamp : z;
    if (z->light < 0 || (seen && z->kind == VERTEX_SURFACE && lights->light[z->light].hidden))
        return c;
    struct light_point at = vertex_light_point(scene, z);
    c.light = z->light;
    rgb Le = z->kind == VERTEX_ESCAPED ? light_Le_sky(lights, at.w, seen) : light_Le(lights, &at, z->wo);
    c.value = rgb_mul(z->beta, Le); /* C* = alpha_t Le [V97 10.2] */
    c.weight = 1;
    if (rgb_is_black(c.value) || seen)
        return c;
    /* n of s = 1, which connects prev to z; z->mis_c is n of s >= 2 */
    double c_e = z->prev_delta ? 0 : n_s1(counts, prev->place, prev->eye_hit, at.cell);
    /* density of the direction of the light sub-path's first ray; at infinity, of its origin */
    const vec3 start = z->kind == VERTEX_ESCAPED ? prev->p : z->p;
    double pdf_emit = emission_pdf(&counts->tables->emission, lights, &at, start, z->wo);
    double eye_side = mis_side(at.pdf, z->pdf_fwd, c_e, pdf_emit, z->mis); /* mis.h (5) */
    c.weight = mis_weight(counts->s0[prev->eye_hit], 0, eye_side); /* mis.h (7), A_light being 0 */
    return c;
}

/* --- two vertices ------------------------------------------------------------------------------------ */

/* The unit direction from z to y.
 *   length  out: infinite if y is at infinity
 *   falloff  out, of rays: area across w at one end per steradian at the other, 1/length^2; parallel rays: 1 */
static inline vec3 line_between(const struct scene *scene, const struct vertex *y, const struct vertex *z,
                                double *length, double *falloff)
{
    *length = INFINITY;
    *falloff = 1;
    if (vertex_at_infinity(scene, y))
        return y->wo;
    vec3 d = sub(y->p, z->p);
    double d2 = length2(d);
    *length = sqrt(d2);
    *falloff = z->kind == VERTEX_LENS ? camera_falloff(&scene->camera, d2) : 1 / d2;
    return mul(d, 1 / *length);
}

/* What an end makes of light, or of importance, that goes on in direction wi: f times the cosine, and the densities,
 * 1/sr, of that direction and of the reverse move to the vertex before. Of a light or the lens beta has what it sends
 * there, except for the cosine at an area light. beta of a lens point that was drawn is J, the density of eye rays in
 * that direction. The density of a light is not given: see emitted_pdf, which costs more than the rest. */
static inline struct bsdf_value scatter_towards(const struct vertex *v, vec3 wi, enum transport mode)
{
    if (v->kind == VERTEX_LENS)
        return (struct bsdf_value){rgb_grey(1), v->beta.g, 0};
    if (v->kind == VERTEX_LIGHT)
        return (struct bsdf_value){rgb_grey(vertex_cosine(v, wi)), 0, 0};
    struct bsdf_value b = bsdf_eval(&v->bsdf, v->wo, wi, mode);
    if (!rgb_is_black(b.f))
        b.f = rgb_scale(b.f, scatter_cosine(v, wi, mode));
    return b;
}

/* With what density a light sub-path that begins in y goes in direction w, to p: 1/sr, at infinity 1/m^2. */
static double emitted_pdf(const struct scene *scene, const struct counts *counts, const struct vertex *y, vec3 p,
                          vec3 w)
{
    const struct light_point at = vertex_light_point(scene, y);
    return emission_pdf(&counts->tables->emission, &scene->lights, &at, p, w);
}

/* Can anything go on from v in direction w, as far as one sees at once? */
static inline bool may_leave(const struct vertex *v, vec3 w)
{
    return v->kind == VERTEX_LIGHT || v->kind == VERTEX_LENS ||
           (v->bsdf.n_smooth > 0 && bsdf_may_scatter(&v->bsdf, v->wo, w));
}

/* A_light of mis.h (5). A light walk counts y as a later hit. Next to the lens it is the first hit, so its c_e differs
 * from y->mis_c; and if s = 2, the count of s = 0 in y->mis differs, too.
 *   R  density of y in the eye walk */
static double light_side(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                         const struct vertex *z, double R, double pdf_rev)
{
    double c_e = y->mis_c, mis = y->mis;
    if (z->kind == VERTEX_LENS) { /* y is no LIGHT */
        const struct vertex *prev = y - 1;
        c_e = y->prev_delta ? 0 : n_if(counts, prev, y, FIRST_HIT);
        if (prev->kind == VERTEX_LIGHT && !light_is_delta(&scene->lights.light[prev->light]))
            mis = mis_step(counts->s0[FIRST_HIT], 0, 0, prev->pdf_fwd, y->g);
    }
    return mis_side(R, y->pdf_fwd, c_e, pdf_rev, mis);
}

struct connection connect_vertices(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                                   const struct vertex *z)
{
    struct connection c = {.light = y->kind == VERTEX_LIGHT ? y->light : -1};
    double length, falloff;
    const vec3 w = line_between(scene, y, z, &length, &falloff), back = neg(w);
    if (!(length > 0) || rgb_is_black(y->beta) || !may_leave(z, w) || !may_leave(y, back))
        return c;
    const struct bsdf_value at_z = scatter_towards(z, w, RADIANCE);
    if (rgb_is_black(at_z.f))
        return c;
    const struct bsdf_value at_y = scatter_towards(y, back, IMPORTANCE);
    /* C* = alpha_s c alpha_t, c = f G f: both cosines are in the factors [V97 10.2] */
    rgb value = rgb_mul(rgb_mul(y->beta, at_y.f), rgb_scale(rgb_mul(z->beta, at_z.f), falloff));
    struct ray ray = {z->p, w, 0, length, z->prim_id, y->prim_id};
    struct edge edge;
    if (rgb_is_black(value) ||
        !scene_edge(scene, &ray, vertex_medium(scene, z, w), y->kind == VERTEX_LIGHT, &edge))
        return c;
    double pdf_y = y->kind == VERTEX_LIGHT ? emitted_pdf(scene, counts, y, z->p, back) : at_y.pdf;
    double R_y = at_z.pdf * vertex_cosine(y, w) * falloff * edge.density[1];
    double R_z = pdf_y * vertex_cosine(z, w) * falloff * edge.density[0];
    double eye_side = mis_side(R_z, z->pdf_fwd, z->mis_c, at_z.pdf_rev, z->mis); /* mis.h (5) */
    c.value = rgb_mul(value, edge.left);
    c.weight = mis_weight(n_of(counts, y, z), light_side(scene, counts, y, z, R_y, at_y.pdf_rev), eye_side); /* (7) */
    return c;
}

/* --- ends that belong to no walk --------------------------------------------------------------------- */

bool light_draw(const struct scene *scene, const struct counts *counts, const struct vertex *z, struct sampler *sampler,
                int i, int n, struct light_point *at, double *pdf)
{
    const struct light_set *lights = &scene->lights;
    const struct table *table = &counts->tables->guide;
    double u[3], pmf; /* taken from the sampler for every vertex, so that those of the next one stay the same */
    u[0] = below_one((i + sampler_number(sampler, DRAW_LIGHT)) / n);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    if (!vertex_connectible(z) || lights->choice.n == 0)
        return false;
    int cell = table->rows > 0 ? table_draw(table, z->place, 0, table->columns, 1, u[0], &pmf, &u[0])
                               : alias_sample(&lights->choice, u[0], &pmf, &u[0]);
    bool emits = light_sample_cell(lights, &scene->geo, cell, u, at) && at->pdf > 0;
    *pdf = emits ? pmf * at->pdf_cell : 0;
    return true;
}

struct connection connect_s1(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                                 struct sampler *sampler, int i, int n, struct vertex *y)
{
    const struct light_set *lights = &scene->lights;
    struct light_point at;
    rgb sent = rgb_black();
    double pdf;
    y->light = -1;
    if (!light_draw(scene, counts, z, sampler, i, n, &at, &pdf))
        return (struct connection){.light = -1};
    if (pdf > 0) {
        vec3 w = light_at_infinity(&lights->light[at.light]) ? neg(at.w) : normalize(sub(z->p, at.p));
        sent = rgb_scale(light_Le(lights, &at, w), 1 / pdf);
    }
    vertex_light(scene, &at, sent, counts->s0[z->eye_hit], y);
    return connect_vertices(scene, counts, y, z);
}

bool lens_point(const struct scene *scene, const struct vertex *y, struct sampler *sampler, struct vertex *z,
                double raster[2])
{
    const struct camera *camera = &scene->camera;
    const double *radius = scene->filter.radius;
    double u[2] = {0, 0};
    if (camera->lens_radius > 0)
        sampler_pair(sampler, DRAW_LENS_POINT, u);
    vec3 p = camera_sample_lens(camera, y->p, u[0], u[1]), d = sub(y->p, p);
    if (!(length2(d) > 0) || !may_leave(y, neg(d)))
        return false;
    double J = camera_project(camera, p, normalize(d), &raster[0], &raster[1]);
    if (J == 0 || raster[0] < -radius[0] || raster[1] < -radius[1] || raster[0] > scene->width + radius[0] ||
        raster[1] > scene->height + radius[1])
        return false;
    vertex_lens(camera, p, rgb_grey(J), z);
    return true;
}

struct connection connect_lens(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                               struct sampler *sampler, double raster[2])
{
    struct vertex z;
    raster[0] = raster[1] = 0;
    return lens_point(scene, y, sampler, &z, raster) ? connect_vertices(scene, counts, y, &z)
                                                     : (struct connection){.light = -1};
}
