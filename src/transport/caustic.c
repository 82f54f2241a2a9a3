/* caustic.c: see caustic.h. */
#include "transport/caustic.h"

#include <stdlib.h>

/* --- what is specular -------------------------------------------------------------------------------- */

/* Some point of a primitive. */
static void some_point(const struct geometry *geo, int prim, vec3 middle, struct surface *out)
{
    struct hit hit = {0, 1.0 / 3, 1.0 / 3, prim};
    struct ray ray = {middle, vec(0, 0, 1), 0, INFINITY, 0, 0};
    shape_surface(geo, &hit, &ray, out);
}

static void widen(vec3 box[2], const float lo[3], const float hi[3])
{
    box[0] = vec(fmin(box[0].x, (double)lo[0]), fmin(box[0].y, (double)lo[1]), fmin(box[0].z, (double)lo[2]));
    box[1] = vec(fmax(box[1].x, (double)hi[0]), fmax(box[1].y, (double)hi[1]), fmax(box[1].z, (double)hi[2]));
}

/* The middles of the bounds of all groups, to be given to free(). */
static vec3 *middles(const struct geometry *geo)
{
    vec3 *box = mem_alloc((size_t)geo->n_groups, 2 * sizeof *box), *middle;
    for (int g = 0; g < geo->n_groups; g++) {
        box[2 * g] = vec(INFINITY, INFINITY, INFINITY);
        box[2 * g + 1] = neg(box[2 * g]);
    }
    for (int i = 0; i < geometry_primitives(geo); i++) {
        int prim = i < geo->n_triangles ? i : FIRST_QUADRIC + (i - geo->n_triangles);
        float lo[3], hi[3];
        shape_bounds(geo, prim, lo, hi);
        widen(&box[2 * (shape_group_of(geo, prim) - geo->group)], lo, hi);
    }
    middle = box;
    for (int g = 0; g < geo->n_groups; g++)
        middle[g] = lerp3(0.5, box[2 * g], box[2 * g + 1]);
    return middle;
}

/* A group counts as what its first primitive is at one point; where it is not, no chain is found. */
static void classify(const struct scene *scene, struct caustics *c, struct arena *arena, int g, vec3 middle)
{
    const struct shape_group *group = &scene->geo.group[g];
    struct surface at;
    struct bsdf bsdf;
    double reflects = 0; /* a guess, so that no time goes into what glass reflects */
    if (group->material < 0)
        return;
    some_point(&scene->geo, group->first_prim, middle, &at);
    c->curved[g] = length2(shape_normal_change(&scene->geo, &at, frame_from_normal(at.ng).s)) > 0;
    material_bsdf(scene->material, group->material, &scene->textures, &at, arena, &bsdf);
    for (int i = 0; i < bsdf.n_lobes; i++) {
        enum lobe_kind kind = bsdf.lobe[i].kind;
        bool dielectric = bsdf.lobe[i].fresnel == FRESNEL_DIELECTRIC || kind == LOBE_FRESNEL_SPECULAR;
        if (lobe_is_delta(kind) && kind != LOBE_SPECULAR_TRANSMISSION)
            reflects = fmax(reflects, dielectric ? 0.1 : 1);
        c->lets_through[g] |= lobe_is_delta(kind) && kind != LOBE_SPECULAR_REFLECTION;
    }
    c->any_through |= c->lets_through[g];
    if (reflects > 0) {
        struct mirror mirror = {g, reflects};
        c->mirror = mem_append(c->mirror, (size_t)c->n_mirrors, sizeof *c->mirror);
        c->mirror[c->n_mirrors++] = mirror;
    }
}

struct caustics *caustics_new(const struct scene *scene, int longest)
{
    struct caustics *c = mem_alloc(1, sizeof *c);
    struct arena arena = {NULL, NULL};
    c->middle = middles(&scene->geo);
    c->longest = longest;
    c->curved = mem_alloc((size_t)scene->geo.n_groups, sizeof *c->curved);
    c->lets_through = mem_alloc((size_t)scene->geo.n_groups, sizeof *c->lets_through);
    for (int g = 0; g < scene->geo.n_groups; g++)
        classify(scene, c, &arena, g, c->middle[g]);
    double sum = 0;
    for (int m = 0; m < c->n_mirrors; m++)
        sum += c->mirror[m].pmf;
    for (int m = 0; m < c->n_mirrors; m++)
        c->mirror[m].pmf /= fmax(1, sum);
    arena_free(&arena);
    if (c->n_mirrors > 0 || c->any_through)
        return c;
    caustics_free(c);
    return NULL;
}

void caustics_free(struct caustics *c)
{
    if (c != NULL) {
        free(c->middle);
        free(c->curved);
        free(c->lets_through);
        free(c->mirror);
    }
    free(c);
}

/* --- Psi --------------------------------------------------------------------------------------------- */

/* How many surfaces that let light through lie between z and y; 0 if there are none, too many, or others. The first is
 * of the group, and *p on it. */
static int pierced(const struct quest *q, int *group, vec3 *p)
{
    const struct vertex *z = q->z;
    vec3 to = q->parallel ? q->y->w : sub(q->y->p, z->p);
    double left = length(to);
    struct ray ray = {z->p, mul(to, 1 / left), ray_margin(z->p), INFINITY, z->prim_id, q->y->prim_id};
    for (int k = 0;; k++) {
        struct surface at;
        ray.tmax = q->parallel ? INFINITY : left - ray_margin(q->y->p);
        if (!(ray.tmin < ray.tmax) || !scene_intersect(q->scene, &ray, &at))
            return k;
        if (k == q->counts->caustics->longest || !q->counts->caustics->lets_through[specular_group(q->scene, &at)])
            return 0;
        if (k == 0) {
            *group = specular_group(q->scene, &at);
            *p = at.p;
        }
        left -= length(sub(at.p, ray.o));
        ray.o = at.p;
        ray.tmin = ray_margin(at.p);
        ray.from = at.prim_id;
    }
}

static struct quest quest_for(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                              const struct vertex *z, const struct light_point *y)
{
    bool parallel = y->light < 0 || light_at_infinity(&scene->lights.light[y->light]);
    struct quest q = {scene, counts, arena, z, y, parallel, -1, 1, 0};
    return q;
}

static bool same_chain(vec3 from, const vec3 *x, int k, const struct chain *c)
{
    for (int i = 0; i < k; i++) {
        vec3 p = x[i];
        if (!(length(sub(p, c->at[i])) < 1e-4 * length(sub(p, from))))
            return false;
        from = p;
    }
    return true;
}

/* Psi: the chains through, at most CAUSTIC_STARTS of them; or that by mirror number m. */
static int psi_through(struct quest *q, struct chain found[CAUSTIC_STARTS])
{
    int group, n = 0;
    vec3 p;
    q->group = -1;
    q->chosen = 1;
    q->k = q->counts->caustics->any_through ? pierced(q, &group, &p) : 0;
    if (q->k == 0)
        return 0;
    vec3 middle = q->counts->caustics->middle[group];
    vec3 axis = normalize(sub(middle, q->z->p)), out = sub(p, middle);
    vec3 side = mul(normalize(sub(out, mul(axis, dot(out, axis)))), length(out) / 2);
    const vec3 start[CAUSTIC_STARTS] = {p, add(middle, side), sub(middle, side)};
    for (int i = 0; i < (q->counts->caustics->curved[group] ? CAUSTIC_STARTS : 1); i++) {
        bool known = !specular_search(q, normalize(sub(start[i], q->z->p)), &found[n]);
        for (int j = 0; j < n && !known; j++)
            known = same_chain(q->z->p, found[n].at, q->k, &found[j]);
        n += !known;
    }
    return n;
}

static bool psi_mirror(struct quest *q, int m, struct chain *c)
{
    q->group = q->counts->caustics->mirror[m].group;
    q->chosen = q->counts->caustics->mirror[m].pmf;
    q->k = 1;
    return specular_search(q, normalize(sub(q->counts->caustics->middle[q->group], q->z->p)), c);
}

/* --- the strategy, and the others that make its paths -------------------------------------------------- */

/* Densities of a path of Psi, each times the number of samples: by caustic connection, by s = 0 and by t = 1, all as if
 * y and, for the last, z were drawn and the rest followed. */
struct makers {
    double connect, hit, splat;
};

/*   lens  density of z per area by the walk from the lens, where t = 1 can make the path; else 0
 * J is the same both ways but for the squared ratio of the refractive indices at the ends. */
static struct makers makers_of(const struct quest *q, const struct chain *c, double lens)
{
    const struct light_set *lights = &q->scene->lights;
    const struct light_point *y = q->y;
    const struct light *light = y->light >= 0 ? &lights->light[y->light] : NULL; /* NULL: infinite, as yet unknown */
    bool delta = light != NULL && light_is_delta(light), sky = light == NULL || light->kind == LIGHT_INFINITE;
    double J = specular_area(q, c), cos_y = light != NULL && light->kind == LIGHT_AREA ? abs_dot(y->n, c->d) : 1;
    double pdf_y = sky ? light_pdf_environment(lights, y->w) : y->pdf; /* as an escaping ray sees it */
    double walked = lens > 0 ? lens : 1;
    struct makers m = {walked * pdf_y * q->chosen, 0, 0};
    if (!delta)
        m.hit = q->counts->hit[LATER_HIT] * walked * c->choice * cos_y / J *
                bsdf_eval(&q->z->bsdf, q->z->wo, c->w, RADIANCE).pdf;
    if (lens > 0)
        m.splat = q->counts->splat * pdf_y * c->choice * abs_dot(q->z->ng, c->w) / (J * sqr(c->eta)) *
                  (sky ? 1 / (PI * sqr(lights->radius)) : light_pdf_emission(lights, y, neg(c->d)));
    return m;
}

static double share(const struct quest *q, double own, struct makers m)
{
    const struct mis_counts *n = q->counts;
    return mis_raise(n, own) / (mis_raise(n, m.connect) + mis_raise(n, m.hit) + mis_raise(n, m.splat));
}

static struct connection contribution(const struct quest *q, const struct chain *c, double lens)
{
    const struct scene *scene = q->scene;
    const struct vertex *z = q->z;
    struct connection out = {.light = q->y->light, .cell = q->y->cell, .end = q->parallel ? q->y->w : q->y->p,
                             .pdf = q->y->pdf, .passed = q->k};
    bool area = scene->lights.light[q->y->light].kind == LIGHT_AREA;
    double cosines = scatter_cosine(z, c->w, RADIANCE) * (area ? abs_dot(q->y->n, c->d) : 1);
    rgb Le = light_Le(&scene->lights, q->y, neg(c->d)), f = bsdf_eval(&z->bsdf, z->wo, c->w, RADIANCE).f;
    rgb value = rgb_scale(rgb_mul(rgb_mul(z->beta, f), rgb_mul(c->kappa, Le)),
                          cosines / (specular_area(q, c) * q->y->pdf * q->chosen));
    if (rgb_is_black(value) || !rgb_is_finite(value))
        return out;
    if (q->parallel ? scene_lit_from(scene, c->p, c->prim_id, c->d)
                    : scene_lit(scene, c->p, c->prim_id, q->y->p, q->y->prim_id))
        out.value = value;
    double last = q->parallel ? light_distance(&scene->lights, c->p, c->d) : length(sub(q->y->p, c->p));
    out.length = z->length + c->length + last;
    struct makers m = makers_of(q, c, lens);
    out.weight = share(q, m.connect, m);
    return out;
}

/* Which mirror to look at; their number: at none. */
static int draw_mirror(const struct caustics *c, double u)
{
    int m = 0;
    while (m < c->n_mirrors && u >= c->mirror[m].pmf)
        u -= c->mirror[m++].pmf;
    return m;
}

int caustic_connect(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                    const struct vertex *z, int t, struct sampler *sampler, int room,
                    struct connection out[CAUSTIC_MOST])
{
    double u[3], lens = t == 2 ? z->pdf_fwd : 0;
    struct light_point y;
    struct chain c[CAUSTIC_MOST];
    u[0] = sampler_number(sampler, DRAW_LIGHT);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    if (room < 1 || !light_sample_point(&scene->lights, &scene->geo, u, &y) || !(y.pdf > 0))
        return 0;
    struct quest q = quest_for(scene, counts, arena, z, &y);
    int n = 0, through = psi_through(&q, c);
    for (int i = 0; i < through && q.k <= room; i++)
        out[n++] = contribution(&q, &c[i], lens);
    int m = draw_mirror(counts->caustics, sampler_number(sampler, DRAW_LIGHT_END));
    if (m < counts->caustics->n_mirrors && psi_mirror(&q, m, c))
        out[n++] = contribution(&q, c, lens);
    return n;
}

/* Is the chain of a path in Psi? Its k vertices are x, x[step] ... from z on. */
static bool in_psi(struct quest *q, const struct vertex *x, int step, int k, struct chain *c)
{
    const struct caustics *caustics = q->counts->caustics;
    struct chain found[CAUSTIC_MOST];
    vec3 p[CAUSTIC_LONGEST];
    int n = 0, m = 0, group = (int)(shape_group_of(&q->scene->geo, (int)(x->prim_id - 1)) - q->scene->geo.group);
    for (int i = 0; i < k; i++)
        p[i] = x[i * step].p;
    vec3 next = k > 1 ? sub(p[1], p[0]) : q->parallel ? q->y->w : sub(q->y->p, p[0]);
    while (m < caustics->n_mirrors && caustics->mirror[m].group != group)
        m++;
    if (dot(x->ng, next) * dot(x->ng, sub(q->z->p, p[0])) < 0)
        n = psi_through(q, found);
    else if (m < caustics->n_mirrors)
        n = psi_mirror(q, m, found);
    for (int i = 0; i < n && q->k == k; i++)
        if (same_chain(q->z->p, p, k, &found[i])) {
            *c = found[i];
            return true;
        }
    return false;
}

bool caustic_weigh_hit(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                       const struct vertex *eye, int t, double *weight)
{
    const struct vertex *end = &eye[t - 1], *z = end - 1;
    while (z[1].prev_delta)
        z--;
    int k = (int)(end - z) - 1;
    end = end->lamp != NULL ? end->lamp : end;
    if (k == 0 || k > counts->caustics->longest || z->kind != VERTEX_SURFACE || z->eye_end != FIRST_HIT)
        return false;
    struct light_point y = vertex_light_point(end);
    y.w = neg(end->wo);
    y.pdf = end->pdf_origin;
    struct quest q = quest_for(scene, counts, arena, z, &y);
    struct chain c;
    if (!in_psi(&q, z + 1, 1, k, &c))
        return false;
    struct makers m = makers_of(&q, &c, z == &eye[1] ? z->pdf_fwd : 0);
    *weight = share(&q, m.hit, m);
    return true;
}

bool caustic_weigh_lens(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                        const struct vertex *light, int s, vec3 lens, double *weight)
{
    const struct vertex *z = &light[s - 1];
    int k = s - 2;
    for (int i = 2; i < s; i++)
        if (!light[i].prev_delta)
            k = 0;
    if (k < 1 || k > counts->caustics->longest)
        return false;
    struct light_point y = vertex_light_point(&light[0]);
    y.pdf = light[0].pdf_fwd;
    struct quest q = quest_for(scene, counts, arena, z, &y);
    struct chain c;
    if (!in_psi(&q, z - 1, -1, k, &c))
        return false;
    double px, py;
    vec3 d = sub(z->p, lens), w = normalize(d);
    double pdf = camera_project(&scene->camera, lens, w, &px, &py) * camera_spread(&scene->camera, length2(d));
    struct makers m = makers_of(&q, &c, pdf * abs_dot(z->ng, w));
    *weight = share(&q, m.splat, m);
    return true;
}
