/* path.c: see path.h. */
#include "transport/path.h"

#include "tables/emission.h"

/* The density per area is F_e of mis.h: the density per steradian times the cosine over distance^2 [PBRT3 5.5.3]. The
 * vertex's `mis` is equation (6) there. */
void walk_measure(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                  double d2)
{
    bool parallel = vertex_at_infinity(w->scene, prev); /* a light at infinity has parallel rays */
    double falloff = prev->kind == VERTEX_LENS ? camera_falloff(&w->scene->camera, d2) : parallel ? 1 : 1 / d2;
    v->g = parallel || prev->kind == VERTEX_LENS ? 1 : vertex_cosine(prev, from->ray.d) * falloff;
    v->pdf_fwd = from->pdf * vertex_cosine(v, from->ray.d) * falloff;
    v->mis = mis_step(from->delta ? 0 : prev->mis_c, from->pdf_rev, prev->mis, prev->pdf_fwd, v->g);
}

/* The same with the factors of media on the edge, and the throughput with theirs. */
static void measure(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                    const struct edge *edge, double d2)
{
    walk_measure(w, v, prev, from, d2);
    v->g *= edge->density[0];
    v->pdf_fwd *= edge->density[1];
    v->mis *= edge->density[0];
    v->beta = rgb_mul(from->beta, rgb_scale(edge->left, 1 / edge->density[1]));
    v->medium = edge->medium;
}

/* The ray met no surface. If there is a sky, or if it passed a see-through light, the eye sub-path ends there. Its
 * density is that of the direction. [PBRT3 16.3.5] */
static bool escape(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                   const struct edge *edge, const struct vertex *lamp)
{
    const struct light_set *lights = &w->scene->lights;
    if (lights->n_layers == 0 && lamp == NULL)
        return false;
    *v = (struct vertex){.kind = VERTEX_ESCAPED, .prev_delta = from->delta, .wo = neg(from->ray.d), .lamp = lamp,
                         .light = lights->n_layers > 0 ? lights->sky : -1};
    measure(w, v, prev, from, edge, 1); /* per steradian, as if at distance 1 */
    return true;
}

/* Make the vertex where the ray met a surface, except its scattering. False if the surface is edge-on. */
static bool meet(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                 const struct edge *edge, const struct surface *at)
{
    double d2 = length2(sub(at->p, from->ray.o));
    if (d2 == 0 || (dot(at->ng, from->ray.d) == 0 && at->prim_id != WITHIN_MEDIUM))
        return false;
    *v = (struct vertex){.kind = at->prim_id == WITHIN_MEDIUM ? VERTEX_MEDIUM : VERTEX_SURFACE, .light = at->light,
                         .p = at->p, .ng = at->ng, .prim_id = at->prim_id, .prev_delta = from->delta,
                         .wo = neg(from->ray.d)};
    measure(w, v, prev, from, edge, d2);
    return true;
}

/* The first see-through light on the ray before the surface or scattering point *end (NULL: none), as a vertex; NULL if
 * there is none. The edge ends there, so media count as far as that alone. */
static const struct vertex *meet_lamp(const struct walk *w, const struct vertex *prev, const struct departure *from,
                                      const struct surface *end)
{
    struct surface at;
    if (!scene_lamp(w->scene, &from->ray, prev->kind == VERTEX_LENS, end, &at))
        return NULL;
    struct edge edge;
    struct ray ray = from->ray;
    ray.tmax = length(sub(at.p, ray.o));
    ray.to = at.prim_id;
    scene_pass(w->scene, &ray, vertex_medium(w->scene, prev, ray.d), &edge);
    struct vertex *v = arena_alloc(w->arena, sizeof *v);
    return meet(w, v, prev, from, &edge, &at) ? v : NULL;
}

/* Make the whole vertex where the ray met a surface. False if the surface is edge-on. */
static bool arrive(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                   const struct edge *edge, const struct surface *at, enum transport mode)
{
    if (!meet(w, v, prev, from, edge, at))
        return false;
    bool first_hit = prev->kind == VERTEX_LENS || (prev->eye_hit == FIRST_HIT && from->delta);
    v->eye_hit = mode == RADIANCE && first_hit ? FIRST_HIT : LATER_HIT;
    material_bsdf(w->scene->material, at->material, &w->scene->textures, at, w->arena, &v->bsdf);
    v->place = region_at(&w->counts->tables->regions, v->p, vertex_side(v));
    v->mis_c = n_before(w->counts, prev, v, mode);
    return true;
}

/* Russian roulette: `left` is the fraction of its first throughput that the walk has kept. False if the walk ends.
 *                                                                                    [Arvo & Kirk 1990], see path.h */
static bool survives(const struct walk *w, double left, rgb *beta)
{
    if (left >= w->rr_threshold)
        return true;
    double q = sqrt(left / w->rr_threshold);
    *beta = rgb_scale(*beta, 1 / q);
    return sampler_number(w->sampler, DRAW_ROULETTE) < q;
}

bool walk_leave(const struct walk *w, const struct vertex *v, enum transport mode, struct departure *out)
{
    double u[3];
    u[0] = sampler_number(w->sampler, DRAW_LOBE);
    sampler_pair(w->sampler, DRAW_SCATTERING, &u[1]);
    struct bsdf_sample s;
    if (v->bsdf.n_lobes == 0 || !bsdf_sample(&v->bsdf, v->wo, u, mode, &s))
        return false;
    /* alpha_{i+1} = alpha_i f |cos| / pdf: [V97 eq. 10.6], from the eye [V97 eq. 10.7] */
    out->beta = rgb_mul(v->beta, rgb_scale(s.f, scatter_cosine(v, s.wi, mode) / s.pdf));
    if (rgb_is_black(out->beta) || !rgb_is_finite(out->beta))
        return false;
    double tmin = end_margin(v->p, v->prim_id);
    out->ray = (struct ray){v->p, s.wi, tmin, INFINITY, v->prim_id, 0};
    out->pdf = s.pdf;
    out->pdf_rev = s.pdf_rev;
    out->delta = s.delta;
    return true;
}

int walk_on(const struct walk *w, struct departure from, struct vertex *path, int n, int max_vertices,
            enum transport mode)
{
    double first = rgb_max(rgb_abs(from.beta));
    while (n < max_vertices) {
        struct surface at;
        struct edge edge;
        const struct vertex *prev = &path[n - 1], *lamp = NULL;
        int medium = vertex_medium(w->scene, prev, from.ray.d);
        bool met = scene_fly(w->scene, &from.ray, medium, w->sampler, &at, &edge);
        if (mode == RADIANCE)
            lamp = meet_lamp(w, prev, &from, met ? &at : NULL);
        else if (n == 1 && met && scene_lamp_stops(w->scene, &from.ray, &at))
            break; /* emitted light does not pass another see-through light, nor one in the place of its own */
        if (!met) {
            if (mode == RADIANCE && escape(w, &path[n], prev, &from, &edge, lamp))
                n++;
            break;
        }
        if (!arrive(w, &path[n], prev, &from, &edge, &at, mode))
            break;
        path[n].lamp = lamp;
        n++;
        if (n == max_vertices || !walk_leave(w, &path[n - 1], mode, &from))
            break;
        if (n > 2 && !survives(w, rgb_max(rgb_abs(from.beta)) / first, &from.beta))
            break;
    }
    return n;
}

int path_eye(const struct walk *w, double px, double py, struct vertex *path, int max_vertices)
{
    const struct camera *camera = &w->scene->camera;
    double u[2] = {0, 0};
    if (camera->lens_radius > 0)
        sampler_pair(w->sampler, DRAW_LENS_POINT, u);
    struct departure from = {.ray = camera_ray(camera, px, py, u[0], u[1]), .beta = rgb_grey(1)};
    vertex_lens(camera, from.ray.o, rgb_grey(1), &path[0]);
    /* Eye rays have density 1 per raster area, so J per steradian (or per m^2). Importance over density is 1, so beta
     * stays 1; the filter is the caller's (camera.h). [PBRT3 16.1.1] */
    double x, y;
    from.pdf = camera_project(camera, from.ray.o, from.ray.d, &x, &y);
    return walk_on(w, from, path, 1, max_vertices, RADIANCE);
}

int path_eye_pixel(const struct walk *w, int x, int y, struct vertex *path, int max_vertices,
                   double *filter_weight)
{
    double u[2], dx, dy;
    sampler_pair(w->sampler, DRAW_FILM_POINT, u);
    *filter_weight = filter_sample(&w->scene->filter, u[0], u[1], &dx, &dy);
    return path_eye(w, x + 0.5 + dx, y + 0.5 + dy, path, max_vertices);
}

int path_light(const struct walk *w, struct vertex *path, int max_vertices, int *column)
{
    double u[3], direction[2];
    u[0] = sampler_number(w->sampler, DRAW_LIGHT);
    sampler_pair(w->sampler, DRAW_LIGHT_POINT, &u[1]);
    sampler_pair(w->sampler, DRAW_EMISSION, direction);
    struct light_point at;
    struct departure from = {.pdf = 0};
    int ray_column;
    rgb emitted = emission_sample(&w->counts->tables->emission, &w->scene->lights, &w->scene->geo, u, direction, &at,
                                  &from.ray, &from.pdf, &ray_column);
    if (column != NULL)
        *column = ray_column;
    if (!(from.pdf > 0) || rgb_is_black(emitted))
        return 0;
    vertex_light(w->scene, &at, light_Le(&w->scene->lights, &at, from.ray.d), w->counts->s0[LATER_HIT], &path[0]);
    from.beta = rgb_scale(emitted, 1 / (at.pdf * from.pdf)); /* alpha_2 of [V97 eq. 10.6] */
    from.ray.tmin = ray_margin(from.ray.o) * (at.prim_id != 0 ? -GRAZING : 1); /* surface.h */
    return walk_on(w, from, path, 1, max_vertices, IMPORTANCE);
}
