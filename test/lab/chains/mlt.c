/* mlt.c: Metropolis light transport: a state is a path, and mutations keep a part of its vertices.           [V97 11]
 *
 * x_0 is on the light, x_k the lens. x_m is the first vertex from the lens that scatters by a lobe that is not delta, 0
 * if none does; the vertices between x_m and the lens are a chain of mirrors. Three mutations:
 *   new path   all vertices are deleted, and a sample of bdpt takes their place, by one of its N strategies for this
 *              length. With T the density of such samples, f / T = N w F, the weighted contribution
 *              (primary.h), whichever strategy made the path: R, the I of chain.h. a = min(1, R' c' / (R c)), c being
 *              the probability to choose this mutation.
 *   lens       x_m and the chain move with the raster point, x_0 .. x_(m-1) stay: a = min(1, L'/L), L being f per
 *              raster area. The strategy (m, k + 1 - m) has L, with its throughput, as unweighted contribution.
 *   caustic    for a chain that lies beyond x_m = x_(k-1): from x_l, the first non-delta one behind it, or the light,
 *              light leaves in another direction, and x_m is joined to the lens: a = min(1, L'/L) with f per
 *              solid angle at x_l, which is the contribution of strategy (k,1) times the density of that direction.
 * Chains are walked with the same numbers, which chose their delta lobes: a number is uniform among those that choose
 * the lobe, so it is a coordinate of the state like those of primary.h. Offsets are between r1 and r2 pixels,
 * r = r2 exp(-u ln(r2/r1)), as likely from there to here [V97 11.4.3].
 *
 * Left out: deletion of a part, and perturbations of several chains.
 *
 * Tests: test_chains.c.
 */
#include "chains/mlt.h"

#include <string.h>

#include "base/vec.h"
#include "base/maths.h"
#include "base/number.h"
#include "caustics/joint.h"
#include "caustics/lamp.h"
#include "caustics/surfaces.h"

/* --- a state's path ---------------------------------------------------------------------------------- */

static bool lensed(const struct chain *c) { return c->job->scene->camera.lens_radius > 0; }

/* A copy of a vertex that outlives the sample. */
static void keep(struct mlt_path *path, int i, const struct vertex *v, bool delta, const double u[3])
{
    struct path_stop *x = &path->x[i];
    size_t size = (size_t)v->bsdf.n_lobes * sizeof *v->bsdf.lobe;
    struct lobe *lobe = arena_alloc(&path->arena, size + 1);
    if (size > 0)
        memcpy(lobe, v->bsdf.lobe, size);
    x->v = *v;
    x->v.bsdf.lobe = lobe;
    x->delta = delta;
    for (int d = 0; d < 3; d++)
        x->u[d] = delta ? u[d] : 0;
}

static void begin_path(struct mlt_path *path, int k)
{
    arena_reset(&path->arena);
    path->x = arena_alloc(&path->arena, (size_t)k * sizeof *path->x);
    path->k = k;
    path->L[LENS_PERTURBATION] = path->L[CAUSTIC_PERTURBATION] = -1;
}

/* x_0 where an eye sub-path came to a light (s = 0), or drawn with these numbers (s = 1) */
static void light_end(const struct chain *c, const struct vertex *z, const double *u, struct vertex *out)
{
    const struct scene *scene = c->job->scene;
    struct light_point at = {.light = 0};
    if (z == NULL)
        lamp_point(&scene->lights, &scene->geo, u, &at);
    else
        at = vertex_light_point(scene, z->lamp != NULL ? z->lamp : z);
    *out = light_vertex(scene, &c->all->counts, &at);
}

/* m, l and what can be done, from which vertices are left by delta lobes. */
static void sort_path(const struct chain *c, struct mlt_path *path)
{
    const struct vertex *end = &path->x[0].v;
    int k = path->k;
    for (path->m = k - 1; path->m > 0 && path->x[path->m].delta;)
        path->m--;
    for (path->l = k - 2; path->l > 0 && path->x[path->l].delta;)
        path->l--;
    bool known = end->pdf_fwd > 0;
    path->can[LENS_PERTURBATION] = known && (path->m < 2 || !path->x[path->m - 1].delta);
    path->can[CAUSTIC_PERTURBATION] = known && path->m == k - 1 && path->l >= 0 && path->l < k - 2 &&
                                      !(path->l == 0 && vertex_at_infinity(c->job->scene, end));
}

/* The path that a strategy has made, from the sub-paths and the numbers that they took. */
static void keep_strategy(struct chain *c, const struct strategy *from)
{
    struct mlt_path *path = c->next.own;
    const struct vertex *eye = c->work->eye, *light = c->light;
    const double *eye_u = c->next.number[EYE_NUMBERS].number + (lensed(c) ? 4 : 2);
    const double *light_u = c->next.number[LIGHT_NUMBERS].number + 5;
    int s = from->s, t = from->t, k = s + t - 1;
    struct vertex end;
    begin_path(path, k);
    if (s < 2)
        light_end(c, s == 0 ? &eye[t - 1] : NULL, c->next.number[POINT_NUMBERS].number, &end);
    keep(path, 0, s < 2 ? &end : &light[0], false, NULL);
    for (int i = 1; i < s; i++)
        keep(path, i, &light[i], i < s - 1 && light[i + 1].prev_delta, light_u + 3 * (i - 1));
    for (int j = 1; j < t && k - j > 0; j++)
        keep(path, k - j, &eye[j], j < t - 1 && eye[j + 1].prev_delta, eye_u + 3 * (j - 1));
    path->raster[0] = (from->px - c->all->x) / c->all->width;
    path->raster[1] = (from->py - c->all->y) / c->all->height;
    if (lensed(c))
        memcpy(path->lens, t > 1 ? eye_u - 2 : c->next.number[LENS_NUMBERS].number, sizeof path->lens);
    sort_path(c, path);
}

/* --- a path made again ------------------------------------------------------------------------------- */

struct mlt_move mlt_stay(const struct mlt_path *path, enum mlt_perturbation which)
{
    struct mlt_move stay = {{path->raster[0], path->raster[1]}, {0, 0, 0}};
    if (which == CAUSTIC_PERTURBATION)
        stay.wi = normalize(sub(path->x[path->l + 1].v.p, path->x[path->l].v.p));
    return stay;
}

/* Numbers that a sub-path is to take. */
static void put(struct primary *p, enum chain_stream stream, const double *u, size_t n)
{
    tape_append(&p->state->number[stream], u, n);
}

/* Were vertices first .. n-1 of a sub-path all reached by delta lobes? */
static bool all_delta(const struct vertex *path, int first, int n)
{
    while (first < n && path[first].prev_delta)
        first++;
    return first >= n;
}

/* By strategy (m, k + 1 - m). */
static bool remake_lens(struct primary *p, const struct mlt_path *path, const struct mlt_move *move,
                        struct strategy *to, struct connection *out)
{
    const struct scene *scene = p->chain->job->scene;
    const struct counts *counts = &p->chain->all->counts;
    struct vertex *light = p->chain->light, *z;
    struct walk w = primary_walk(p, LIGHT_NUMBERS);
    int s = to->s = path->m, t = to->t = path->k + 1 - s;
    put(p, EYE_NUMBERS, move->raster, 2);
    if (lensed(p->chain))
        put(p, EYE_NUMBERS, path->lens, 2);
    for (int i = path->k - 1; i > s; i--)
        put(p, EYE_NUMBERS, path->x[i].u, 3);
    if (primary_eye(p, t, &to->px, &to->py) < t || !all_delta(p->chain->work->eye, 2, t))
        return false;
    z = &p->chain->work->eye[t - 1];
    if (s == 0) {
        *out = connect_s0(scene, counts, z - 1, z);
        return true;
    }
    if (z->kind != VERTEX_SURFACE || follow_light(&w, path->x, s, light) < s)
        return false;
    struct light_point at = vertex_light_point(scene, &path->x[0].v);
    *out = s == 1 ? lamp_connect(scene, counts, z, &at, at.pdf) : connect_vertices(scene, counts, &light[s - 1], z);
    return true;
}

/* By strategy (k,1). */
static bool remake_caustic(struct primary *p, const struct mlt_path *path, const struct mlt_move *move,
                           struct strategy *to, struct connection *out, double *pdf)
{
    struct vertex *light = p->chain->light;
    struct walk w = primary_walk(p, LIGHT_NUMBERS);
    int k = to->s = path->k, n = path->l + 1;
    to->t = 1;
    put(p, LENS_NUMBERS, path->lens, 2);
    if (follow_light(&w, path->x, n, light) < n || follow_on(&w, light, n, move->wi, k, pdf) < k ||
        !all_delta(light, n + 1, k))
        return false;
    *out = primary_lens(p, &light[k - 1], to);
    return true;
}

double mlt_remake(struct primary *p, const struct mlt_path *path, enum mlt_perturbation which,
                  const struct mlt_move *move, struct strategy *to)
{
    struct connection c;
    double pdf = 1;
    primary_begin(p, p->chain, false);
    for (int i = 1; i < path->k; i++)
        if (path->x[i].delta && (which == CAUSTIC_PERTURBATION || i < path->m))
            put(p, LIGHT_NUMBERS, path->x[i].u, 3);
    bool made = which == LENS_PERTURBATION ? remake_lens(p, path, move, to, &c)
                                           : remake_caustic(p, path, move, to, &c, &pdf);
    return made && primary_bring(p, &c, to) ? rgb_luminance(c.value) * pdf : 0;
}

/* --- mutations --------------------------------------------------------------------------------------- */

/* An offset's length in pixels is between these; at most a twentieth of the picture lies within. */
static const double LEAST_OFFSET = 0.1, MOST_SHARE = 0.05;

static double most_offset(const struct chains *all)
{
    return fmax(1, sqrt(MOST_SHARE * all->width * all->height / PI));
}

double mlt_pixels_per_angle(const struct chain *c, const struct mlt_path *path)
{
    const struct camera *camera = &c->job->scene->camera;
    const struct path_stop *x = path->x;
    vec3 lens = camera_sample_lens(camera, x[path->k - 1].v.p, path->lens[0], path->lens[1]);
    vec3 d = sub(x[path->k - 1].v.p, lens);
    double chain = 0, px, py, distance = camera->parallel ? 1 : length(d);
    for (int i = path->l; i < path->k - 1; i++)
        chain += length(sub(x[i + 1].v.p, x[i].v.p));
    return chain * sqrt(camera_project(camera, lens, normalize(d), &px, &py)) / distance;
}

/* A move; for a caustic, *angle is by how much. */
static struct mlt_move draw_move(struct chain *c, const struct mlt_path *path, enum mlt_perturbation which,
                                 double *angle)
{
    const struct chains *all = c->all;
    struct mlt_move move = mlt_stay(path, which);
    double most = most_offset(all), r = most * m_exp(-rng_uniform(&c->rng) * m_log(most / LEAST_OFFSET)), sine, cosine;
    m_sincos(2 * PI * rng_uniform(&c->rng), &sine, &cosine);
    if (which == LENS_PERTURBATION) {
        move.raster[0] += r * cosine / all->width;
        move.raster[1] += r * sine / all->height;
        return move;
    }
    *angle = r / mlt_pixels_per_angle(c, path);
    double across = m_sin(*angle);
    struct frame f = frame_from_normal(move.wi);
    move.wi = to_world(&f, vec(across * cosine, across * sine, m_cos(*angle)));
    return move;
}

static bool in_raster(const double u[2]) { return u[0] >= 0 && u[0] < 1 && u[1] >= 0 && u[1] < 1; }

/* Could the reverse move have this angle? */
static bool returns(const struct chain *c, const struct mlt_path *path, double angle)
{
    double r = angle * mlt_pixels_per_angle(c, path);
    return angle < PI && r >= LEAST_OFFSET && r <= most_offset(c->all);
}

/* The moved path. Of what an eye walk makes again only the numbers are needed. */
static void keep_moved(struct chain *c, const struct mlt_path *old, enum mlt_perturbation which,
                       const struct strategy *to)
{
    struct mlt_path *path = c->next.own;
    begin_path(path, old->k);
    for (int i = 0; i < old->k; i++) {
        bool moved = which == CAUSTIC_PERTURBATION && i > old->l;
        keep(path, i, moved ? &c->light[i] : &old->x[i].v, old->x[i].delta, old->x[i].u);
    }
    memcpy(path->lens, old->lens, sizeof path->lens);
    path->raster[0] = (to->px - c->all->x) / c->all->width;
    path->raster[1] = (to->py - c->all->y) / c->all->height;
    sort_path(c, path);
}

static double perturb(struct chain *c, enum mlt_perturbation which)
{
    struct mlt_path *old = c->now.own, *path = c->next.own;
    struct strategy to = {.n = c->now.length > 2 ? c->now.length : 1};
    struct primary p = {.chain = c};
    double angle = 0;
    if (old->L[which] < 0) {
        struct mlt_move stay = mlt_stay(old, which);
        old->L[which] = mlt_remake(&p, old, which, &stay, &to);
    }
    struct mlt_move move = draw_move(c, old, which, &angle);
    double L = in_raster(move.raster) ? mlt_remake(&p, old, which, &move, &to) : 0;
    if (!(L > 0)) {
        c->next.I = 0;
        return 0;
    }
    primary_end(&p);
    if (!(old->L[which] > 0) || !(c->next.I > 0))
        return 0;
    keep_moved(c, old, which, &to);
    path->L[which] = L;
    if (which == CAUSTIC_PERTURBATION && !returns(c, path, angle))
        return 0;
    return fmin(1, L / old->L[which]);
}

/* The probability to choose a new path. */
static double chance_of_new(const struct chain *c, const struct mlt_path *path)
{
    return path->can[LENS_PERTURBATION] || path->can[CAUSTIC_PERTURBATION] ? c->all->large_step : 1;
}

static void sample(struct chain *c, bool small)
{
    struct primary p;
    struct strategy strategy;
    primary_begin(&p, c, small);
    bool made = primary_strategy(&p, &strategy);
    primary_end(&p);
    if (made)
        keep_strategy(c, &strategy);
}

static double propose(struct chain *c)
{
    const struct mlt_path *old = c->now.own, *path = c->next.own;
    double chance = chance_of_new(c, old), u = rng_uniform(&c->rng);
    c->next.length = c->now.length;
    if (u >= chance) {
        bool caustic = old->can[CAUSTIC_PERTURBATION] &&
                       (!old->can[LENS_PERTURBATION] || u - chance >= (1 - chance) / 2);
        return perturb(c, caustic ? CAUSTIC_PERTURBATION : LENS_PERTURBATION);
    }
    sample(c, false);
    return c->next.I > 0 ? fmin(1, c->next.I * chance_of_new(c, path) / (c->now.I * chance)) : 0;
}

static void own_free(void *own) { arena_free(&((struct mlt_path *)own)->arena); }

static const struct chain_rules RULES = {.by_length = true, .own_size = sizeof(struct mlt_path), .own_free = own_free,
                                         .sample = sample, .propose = propose};

static void prepare(const struct render_job *job, struct prepared *out) { chain_prepare(&RULES, job, out); }

const struct method method_mlt = {
    .name = "mlt", .check = surfaces_alone,
    .help = "a Markov chain over paths: new ones, lens and caustic perturbations [Veach 1997]",
    .own = &CHAIN_PARAMETERS[1], .rr_threshold = 0, .prepare = prepare, CHAIN_ROW};
