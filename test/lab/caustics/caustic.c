/* caustic.c: see caustic.h. */
#include "caustics/caustic.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"
#include "caustics/lamp.h"
#include "caustics/visible.h"
#include "tables/emission.h"

/* What of a shape group chains may go by. */
struct caster {
    vec3 middle;       /* mean of its primitives' */
    int n;             /* of them */
    bool curved;       /* its normals change along it */
    bool lets_through; /* it has a refracting lobe */
};

enum { STARTS = ONE_MORE_MOST - 1 };

struct caustics {
    struct one_more more;
    int longest;           /* K */
    struct caster *caster; /* [groups of the geometry], owned */
    double *mirror; /* [groups + 1], owned: sums of the probabilities with which those before are looked at; the last
                     * may be less than 1 */
    bool any_through;
    bool left[2]; /* to s = 0 and t = 1: the paths whose z the lens sees, [0], or is led to by delta lobes, [1] */
};

/* --- what is specular -------------------------------------------------------------------------------- */

static void find_middles(const struct geometry *geo, struct caster *caster)
{
    for (int i = 0; i < geo->n_triangles + geo->n_quadrics; i++) {
        int prim = i < geo->n_triangles ? i : FIRST_QUADRIC + (i - geo->n_triangles);
        struct caster *c = &caster[shape_group_of(geo, prim) - geo->group];
        float lo[3], hi[3];
        shape_bounds(geo, prim, lo, hi);
        vec3 here = lerp3(0.5, vec((double)lo[0], (double)lo[1], (double)lo[2]),
                          vec((double)hi[0], (double)hi[1], (double)hi[2]));
        c->middle = lerp3(1.0 / ++c->n, c->middle, here);
    }
}

/* A group counts as what its first primitive is at one point; where it is not, no chain is found. Returns roughly how
 * much it reflects, so that no time goes into what glass reflects. */
static double classify(const struct scene *scene, struct arena *arena, const struct shape_group *group,
                       struct caster *c)
{
    const struct hit hit = {0, 1.0 / 3, 1.0 / 3, group->first_prim, 0};
    const struct ray ray = {c->middle, vec(0, 0, 1), 0, INFINITY, 0, 0};
    struct surface at;
    struct bsdf bsdf;
    double reflects = 0;
    if (group->material < 0 || group->shared || group->first_prim >= FIRST_CURVE) /* curves cast no chains */
        return 0;
    shape_surface(&scene->geo, &hit, &ray, &at);
    c->curved = length2(specular_normal_change(&scene->geo, &at, frame_from_normal(at.ng).s)) > 0;
    material_bsdf(scene->material, group->material, &scene->textures, &at, arena, &bsdf);
    for (int i = 0; i < bsdf.n_lobes; i++) {
        enum lobe_kind kind = bsdf.lobe[i].kind;
        bool dielectric = bsdf.lobe[i].fresnel == FRESNEL_DIELECTRIC || kind == LOBE_FRESNEL_SPECULAR;
        if (lobe_is_delta(kind) && kind != LOBE_SPECULAR_TRANSMISSION)
            reflects = fmax(reflects, dielectric ? 0.1 : 1);
        c->lets_through |= lobe_is_delta(kind) && kind != LOBE_SPECULAR_REFLECTION;
    }
    return reflects;
}

/* --- Psi --------------------------------------------------------------------------------------------- */

/* How many surfaces that let light through lie between z and y; 0 if there are none, too many, or others. The first is
 * of the group, and *p on it. */
static int pierced(const struct caustics *all, const struct quest *q, int *group, vec3 *p)
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
        if (k == all->longest || !all->caster[specular_group(q->scene, &at)].lets_through)
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

static struct quest quest_for(const struct sample *sample, const struct vertex *z, const struct light_point *y)
{
    const struct scene *scene = sample->pass->job->scene;
    bool parallel = light_at_infinity(&scene->lights.light[y->light]);
    return (struct quest){scene, &sample->pass->work->arena, z, y, parallel, -1, 1, 0};
}

static bool same_chain(vec3 from, const vec3 *x, int k, const struct specular_chain *c)
{
    for (int i = 0; i < k; i++) {
        vec3 p = x[i];
        if (!(length(sub(p, c->at[i])) < 1e-4 * length(sub(p, from))))
            return false;
        from = p;
    }
    return true;
}

/* Psi: the chains through, at most STARTS of them; or that by way of a group. */
static int psi_through(const struct caustics *all, struct quest *q, struct specular_chain found[STARTS])
{
    int group, n = 0;
    vec3 p;
    q->group = -1;
    q->chosen = 1;
    q->k = all->any_through ? pierced(all, q, &group, &p) : 0;
    if (q->k == 0)
        return 0;
    vec3 middle = all->caster[group].middle, axis = normalize(sub(middle, q->z->p)), out = sub(p, middle);
    vec3 side = mul(normalize(sub(out, mul(axis, dot(out, axis)))), length(out) / 2);
    const vec3 start[STARTS] = {p, add(middle, side), sub(middle, side)};
    for (int i = 0; i < (all->caster[group].curved ? STARTS : 1); i++) {
        bool known = !specular_search(q, normalize(sub(start[i], q->z->p)), &found[n]);
        for (int j = 0; j < n && !known; j++)
            known = same_chain(q->z->p, found[n].at, q->k, &found[j]);
        n += !known;
    }
    return n;
}

static int psi_mirror(const struct caustics *all, struct quest *q, int group, struct specular_chain *found)
{
    q->group = group;
    q->chosen = all->mirror[group + 1] - all->mirror[group];
    q->k = 1;
    return q->chosen > 0 && specular_search(q, normalize(sub(all->caster[group].middle, q->z->p)), found);
}

/* --- the strategy, and the others that make its paths -------------------------------------------------- */

/* Densities of a path of Psi, each times the number of samples: by caustic connection, by s = 0 and by t = 1, all as if
 * y and, for the last, z were drawn and the rest followed; all times J, for at a focus J is 0. */
struct makers {
    double connect, hit, splat;
};

/* How the walk from the lens comes to z, in any strategy. */
struct arrival {
    vec3 wo;    /* unit, back to where it came from: not what a light sub-path's vertex calls so */
    double pdf; /* of z per area where t = 1 can make the path; else 0 */
};

/* J is the same both ways except for the squared ratio of the refractive indices at the ends. */
static struct makers makers_of(const struct counts *n, const struct quest *q, const struct specular_chain *c,
                               struct arrival at)
{
    const struct light_set *lights = &q->scene->lights;
    const struct light_point *y = q->y;
    const struct light *light = &lights->light[y->light];
    double J = specular_area(q, c), cos_y = light->kind == LIGHT_AREA ? abs_dot(y->n, c->d) : 1;
    double walked = at.pdf > 0 ? at.pdf : 1;
    struct makers m = {walked * y->pdf * q->chosen * J, 0, 0};
    if (!light_is_delta(light))
        m.hit = n->s0[LATER_HIT] * walked * c->choice * cos_y * bsdf_eval(&q->z->bsdf, at.wo, c->w, RADIANCE).pdf;
    if (at.pdf > 0)
        m.splat = n->lens * y->pdf * c->choice * abs_dot(q->z->ng, c->w) / sqr(c->eta) *
                  emission_pdf(&n->tables->emission, lights, y, c->p, neg(c->d));
    return m;
}

static double share(double own, struct makers m)
{
    double all = m.connect + m.hit + m.splat;
    return all > 0 ? own / all : 0;
}

static struct connection contribution(const struct counts *counts, const struct quest *q,
                                      const struct specular_chain *c, double pdf)
{
    const struct scene *scene = q->scene;
    const struct light_point *y = q->y;
    const struct vertex *z = q->z;
    struct connection out = {.light = y->light};
    bool area = scene->lights.light[y->light].kind == LIGHT_AREA;
    double cosines = scatter_cosine(z, c->w, RADIANCE) * (area ? abs_dot(y->n, c->d) : 1);
    rgb Le = light_Le(&scene->lights, y, neg(c->d)), f = bsdf_eval(&z->bsdf, z->wo, c->w, RADIANCE).f;
    rgb value = rgb_scale(rgb_mul(rgb_mul(z->beta, f), rgb_mul(c->kappa, Le)),
                          cosines / (specular_area(q, c) * y->pdf * q->chosen));
    if (rgb_is_black(value) || !rgb_is_finite(value))
        return out;
    if (q->parallel ? scene_lit_from(scene, c->p, c->prim_id, c->d)
                    : scene_lit(scene, c->p, c->prim_id, y->p, y->prim_id))
        out.value = value;
    struct makers m = makers_of(counts, q, c, (struct arrival){z->wo, pdf});
    out.weight = share(m.connect, m);
    return out;
}

static struct one_more_path made(const struct counts *counts, const struct quest *q, const struct specular_chain *c,
                                 double pdf)
{
    struct vertex *passed = arena_alloc(q->arena, (size_t)q->k * sizeof *passed);
    for (int i = 0; i < q->k; i++)
        passed[i] = (struct vertex){.kind = VERTEX_SURFACE, .light = -1, .p = c->at[i]};
    return (struct one_more_path){contribution(counts, q, c, pdf), *q->y, passed, q->k};
}

static int connect(const struct one_more *self, struct sample *sample, const struct vertex *eye, int t,
                   struct one_more_path out[ONE_MORE_MOST])
{
    const struct caustics *all = (const void *)self;
    const struct scene *scene = sample->pass->job->scene;
    const struct vertex *z = &eye[t - 1];
    double pdf = t == 2 ? z->pdf_fwd : 0;
    struct light_point y;
    struct specular_chain c[ONE_MORE_MOST];
    if (z->eye_hit != FIRST_HIT || !vertex_connectible(z) || all->left[t > 2])
        return 0;
    if (!lamp_draw(scene, &sample->sampler, &y) || !(y.pdf > 0))
        return 0;
    struct quest q = quest_for(sample, z, &y);
    int n = 0, room = sample->pass->job->max_depth + 1 - t, through = psi_through(all, &q, c);
    for (int i = 0; i < through && q.k <= room; i++)
        out[n++] = made(sample->pass->counts, &q, &c[i], pdf);
    double which = sampler_number(&sample->sampler, DRAW_LIGHT_END);
    int groups = scene->geo.n_groups;
    if (room >= 1 && which < all->mirror[groups] &&
        psi_mirror(all, &q, cumulative_find(all->mirror, groups, which), c) > 0)
        out[n++] = made(sample->pass->counts, &q, c, pdf);
    return n;
}

/* A path that others have made: its k vertices from z on are x, x[step] ..., then y. False if Psi has no such chain. */
static bool in_psi(const struct caustics *all, const struct sample *sample, const struct vertex *z, int step, int k,
                   const struct light_point *y, struct arrival at, struct makers *out)
{
    struct quest q = quest_for(sample, z, y);
    struct specular_chain found[STARTS];
    vec3 p[SPECULAR_LONGEST];
    if (k < 1 || k > all->longest || all->left[!(at.pdf > 0)])
        return false;
    for (int i = 0; i < k; i++)
        p[i] = z[(i + 1) * step].p;
    const struct vertex *x = &z[step];
    vec3 next = k > 1 ? sub(p[1], p[0]) : q.parallel ? y->w : sub(y->p, p[0]);
    int group = (int)(shape_group_of(&q.scene->geo, shape_prim(x->prim_id)) - q.scene->geo.group);
    bool through = dot(x->ng, next) * dot(x->ng, sub(z->p, p[0])) < 0;
    int n = through ? psi_through(all, &q, found) : psi_mirror(all, &q, group, found);
    for (int i = 0; i < n && q.k == k; i++)
        if (same_chain(z->p, p, k, &found[i])) {
            *out = makers_of(sample->pass->counts, &q, &found[i], at);
            return true;
        }
    return false;
}

static void weigh_hit(const struct caustics *all, const struct sample *sample, const struct joined *j, double *weight)
{
    const struct vertex *end = j->z, *z = end - 1, *first = j->z + 2 - j->t;
    struct makers m;
    while (z[1].prev_delta)
        z--;
    int k = (int)(end - z) - 1;
    end = end->lamp != NULL ? end->lamp : end;
    struct light_point y = vertex_light_point(sample->pass->job->scene, end);
    y.w = neg(end->wo);
    struct arrival at = {z->wo, z == first ? z->pdf_fwd : 0};
    if (z->kind == VERTEX_SURFACE && z->eye_hit == FIRST_HIT && in_psi(all, sample, z, 1, k, &y, at, &m))
        *weight = share(m.hit, m);
}

static void weigh_lens(const struct caustics *all, const struct sample *sample, const struct joined *j, vec3 lens,
                       double *weight)
{
    const struct camera *camera = &sample->pass->job->scene->camera;
    const struct vertex *light = j->path, *z = &light[j->s - 1];
    struct light_point y = vertex_light_point(sample->pass->job->scene, &light[0]);
    struct makers m;
    double px, py;
    vec3 d = sub(z->p, lens), w = normalize(d);
    double pdf = camera_project(camera, lens, w, &px, &py) * camera_falloff(camera, length2(d));
    for (int i = 2; i < j->s; i++)
        if (!light[i].prev_delta)
            return;
    if (in_psi(all, sample, z, -1, j->s - 2, &y, (struct arrival){neg(w), pdf * abs_dot(z->ng, w)}, &m))
        *weight = share(m.splat, m);
}

static void weigh(const struct one_more *self, const struct sample *sample, const struct joined *j, vec3 lens,
                  struct connection *c)
{
    if (j->s == 0)
        weigh_hit((const void *)self, sample, j, &c->weight);
    else if (j->t == 1)
        weigh_lens((const void *)self, sample, j, lens, &c->weight);
}

/* --- what chains can go by --------------------------------------------------------------------------- */

void caustics_free(struct one_more *self)
{
    struct caustics *all = (void *)self;
    if (all == NULL)
        return;
    free(all->caster);
    free(all->mirror);
    free(all);
}

struct one_more *caustics_new(const struct scene *scene, int longest)
{
    const int n = scene->geo.n_groups;
    struct caustics *all = mem_alloc(1, sizeof *all);
    struct arena arena = {NULL, NULL};
    all->more.connect = connect;
    all->more.weigh = weigh;
    all->longest = longest;
    all->caster = mem_alloc((size_t)n, sizeof *all->caster);
    all->mirror = mem_alloc((size_t)n + 1, sizeof *all->mirror);
    find_middles(&scene->geo, all->caster);
    for (int g = 0; g < n; g++) {
        struct caster *c = &all->caster[g];
        all->mirror[g + 1] = all->mirror[g] + classify(scene, &arena, &scene->geo.group[g], c);
        all->any_through |= c->lets_through;
    }
    arena_free(&arena);
    double sum = all->mirror[n];
    bool any = all->any_through || sum > 0;
    for (int g = 0; sum > 1 && g <= n; g++)
        all->mirror[g] /= sum;
    if (any)
        return &all->more;
    caustics_free(&all->more);
    return NULL;
}

/* --- is it worth its cost? ------------------------------------------------------------------------------------ */

/* A sample of the picture: what it contributes, and what its square would be larger by without chains, by eye ends as
 * in `left`. */
struct trial {
    double brings, tail[2];
};

/* Without a chain of weight w that contributes X, the second moment is larger by X^2 / (1 - w); others find the rest
 * of what the chain found, t = 1 with them, which is not tried. */
static struct trial try_chains(const struct one_more *self, struct sample *sample, const struct vertex *eye, int n)
{
    const double MOST = 100; /* chance decides whether more is seen */
    struct one_more_path more[ONE_MORE_MOST];
    struct trial out = {rgb_luminance(sample->value), {0, 0}};
    for (int t = 2; t <= n; t++)
        for (int i = eye[t - 1].kind == VERTEX_SURFACE ? connect(self, sample, eye, t, more) : 0; i-- > 0;) {
            double C = rgb_luminance(more[i].c.value), w = more[i].c.weight;
            out.brings += C * (1 - w);
            out.tail[t > 2] += sqr(C * w) * fmin(1 / (1 - w), MOST);
        }
    return out;
}

/* The mean of tails, relative to brightness there and, by a quarter, of the picture. */
static double relative_tail(const struct trial *trial, int n, int which)
{
    double mean = 1e-30, sum = 0;
    for (int i = 0; i < n; i++)
        mean += trial[i].brings / n;
    for (int i = 0; i < n; i++)
        sum += trial[i].tail[which] / sqr(0.75 * trial[i].brings + 0.25 * mean) / n;
    return sum;
}

bool caustics_pay(struct one_more *self, const struct render_job *job, const struct prepared *method)
{
    const struct counts *counts = &method->counts;
    const double LEAST = 0.5; /* chains make a sample several times as expensive */
    struct caustics *all = (void *)self;
    struct render_job other = *job;
    struct pixel_rect film = job->film_rect;
    struct workspace *work = workspaces_new(1, job->max_depth);
    struct tile tile = {.sum = NULL};
    int n = int_within((double)rect_pixels(film) / 8, 256, 4096);
    struct trial *trial = mem_alloc((size_t)n, sizeof *trial);
    bool delta = false;
    other.seed = other.eye_seed = hash_combine(job->seed, 0xbb67ae8584caa73bu); /* unlike the render's */
    for (int i = 0; i < n; i++) {
        double u, v;
        sampler_r2(i, &u, &v);
        int x = film.x0 + (int)(u * rect_width(film)), y = film.y0 + (int)(v * rect_height(film));
        struct tile_pass pass = {.job = &other, .counts = counts, .first = i, .end = i + 1, .tile = &tile,
                                 .work = work, .ends_at = CANCEL_NOW};
        tile_start(&tile, (struct tile_pixels){{x, y, x + 1, y + 1}, 1, 1, 0, 0}, film, &job->scene->filter);
        arena_reset(&work->arena);
        struct sample sample = sample_begin(&pass, 0, i);
        int length = sample_eye_path(&sample, job->max_depth + 2);
        one_more_sum_eye(&sample, &all->more, length);
        trial[i] = try_chains(&all->more, &sample, work->eye, length);
    }
    tile_free(&tile);
    workspaces_free(work, 1);
    for (int i = 0; i < job->scene->lights.n; i++)
        delta |= light_is_delta(&job->scene->lights.light[i]);
    for (int i = 0; i < 2; i++)
        all->left[i] = !(relative_tail(trial, n, i) > LEAST) && !(delta && (i > 0 || counts->lens == 0));
    free(trial);
    return !all->left[0] || !all->left[1];
}
