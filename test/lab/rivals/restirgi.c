/* restirgi.c: what second vertices are lit by is resampled, and shared with pixels nearby.
 *
 * Reservoirs for paths [Ouyang 2021] within one picture, without time, and unbiased. A path goes from the lens to the
 * pixel's first vertex z1, to z2, and on along a tail: a point on a light (s = 1), or a next vertex with all that the
 * walk finds from there on. With f_i(x) the luminance, weighed, of what z2 and tail x contribute to pixel i:
 *  1. Each pixel i makes one eye sub-path, whose tails it offers, each with density p; one is kept in proportion to
 *     f_i / p, with the weight
 *         W_i = (1/f_i(x)) sum f_i / p:    E[h(x) W_i] = integral of h where f_i V_i > 0.
 *  2. Pixel c keeps one of its own and those of up to N pixels of the tile with a like first vertex, the set S, in
 *     proportion to f_c(x_j) W_j. Of the one kept, x from pixel s,
 *         X = F_c(x) (m / f_c(x)) sum_j f_c(x_j) W_j,    m = f_s(x) V_s(x) / sum over k in S of f_k(x) V_k(x),
 *     V: do z1 and z2 see each other? S depends on first vertices alone, so X is exact.
 *
 * Densities are of z2's area: a walk's, 1/sr, times g = |cos| / distance^2. The ratio of two pixels' g is the Jacobian
 * of taking over a direction; where it is below a tenth or above ten nothing is taken over, which m must know, too. How
 * z2 scatters is found again for each pixel, and with it the weight of s = 0 against s = 1 there.
 *
 * What does not go by z1 and z2 so that both scatter smoothly is path tracing's, as are all paths of pixels that are
 * alone: without neighbours the method is `pt` to the bit.
 *
 * Tests: test_rivals.c.
 */
#include <string.h>

#include "caustics/surfaces.h"
#include "caustics/visible.h"
#include "rivals/together.h"

struct restirgi {
    int neighbours; /* N */
};

/* z2, and one way in which light comes to it. */
struct tail {
    enum { POINT, HIT, LATER } kind; /* a point drawn on a light, s = 0 at the next vertex, anything behind that */
    const struct vertex *z;          /* z2 */
    vec3 w;                          /* from there on, unit */
    rgb L;                           /* what comes from there, over its density from the next vertex on */
    double light; /* density, 1/sr, with which w is drawn on lights; LATER: the weight, which is known */
    int s, t;     /* of the whole path: its eye vertices go on behind z2 in memory */
    int ends_on;  /* number of a light */
    struct vertex y; /* s = 1 */
};

struct reservoir {
    struct tail x;
    double weight; /* W; 0: nothing has been kept */
    double g;      /* of its own pixel */
    bool shares;   /* is the pixel of those that share? */
};

/* What pixel p has of a tail, if z1 and z2 see each other. Returns f; *g as above. */
static double value_at(const struct pixel *p, const struct tail *x, struct connection *out, double *g)
{
    const struct vertex *z = &p->sample.eye[1];
    vec3 d = sub(x->z->p, z->p);
    double d2 = length2(d);
    struct connection c = {.light = x->ends_on, .weight = x->light};
    *out = c;
    *g = 0;
    if (!(d2 > 0) || !bsdf_may_scatter(&z->bsdf, z->wo, d) || !bsdf_may_scatter(&x->z->bsdf, neg(d), x->w))
        return 0;
    vec3 w = mul(d, 1 / sqrt(d2));
    struct bsdf_value at1 = bsdf_eval(&z->bsdf, z->wo, w, RADIANCE);
    struct bsdf_value at2 = bsdf_eval(&x->z->bsdf, neg(w), x->w, RADIANCE);
    double cosines = scatter_cosine(z, w, RADIANCE) * scatter_cosine(x->z, x->w, RADIANCE);
    *g = abs_dot(x->z->ng, w) / d2;
    c.value = rgb_scale(rgb_mul(rgb_mul(z->beta, at1.f), rgb_mul(at2.f, x->L)), cosines * *g);
    double both = x->light + at2.pdf;
    if (x->kind != LATER && both > 0)
        c.weight = (x->kind == POINT ? x->light : at2.pdf) / both;
    *out = c;
    return rgb_luminance(c.value) * c.weight;
}

/* --- step 1 ------------------------------------------------------------------------------------------ */

/* A tail of the pixel's own, made with that density; *sum of f / p of those before. */
static void offer(struct pixel *p, struct reservoir *r, const struct tail *x, double density, double *sum)
{
    struct connection c;
    double g, f = value_at(p, x, &c, &g);
    if (!(f > 0))
        return;
    *sum += f / density;
    if (sampler_number(&p->sample.choice, DRAW_ORDER) * *sum < f / density) {
        r->x = *x;
        r->g = g;
        r->weight = 1 / f; /* times the sum, in the end */
    }
}

/* z2's own light point. */
static void offer_point(struct pixel *p, struct reservoir *r, const struct vertex *z, double *sum)
{
    const struct render_job *job = p->sample.pass->job;
    const struct scene *scene = job->scene;
    struct tail x = {.z = z, .s = 1, .t = 3};
    struct light_point at;
    struct lit l;
    if (job->max_depth < 2 || !lit_draw(&p->sample, z, &p->sample.sampler, 0, 1, &at, &l) || !reuse_sees(scene, &l))
        return;
    bool delta = light_is_delta(&scene->lights.light[l.at.light]);
    double density = l.pdf / l.at_light;
    x.kind = delta ? LATER : POINT;
    x.w = l.w;
    x.y = light_vertex(scene, p->sample.pass->counts, &at);
    x.L = light_Le(&scene->lights, &l.at, neg(l.w));
    x.light = delta ? 1 : density;
    x.ends_on = l.at.light;
    offer(p, r, &x, z->pdf_fwd * density, sum);
}

/* What the walk has found behind z2: shared, if z2 was not left by a delta lobe, else the pixel's own. */
static void offer_later(struct pixel *p, struct reservoir *r, const struct vertex *z, double *sum)
{
    struct sample *sample = &p->sample;
    const struct render_job *job = sample->pass->job;
    bool own = z[1].prev_delta;
    double roulette, later;
    struct tail x = {.z = z, .w = neg(z[1].wo)};
    rgb beta = own ? z[1].beta : rgb_grey(1);
    reuse_step(z, &z[1], &roulette);
    double pdf = bsdf_eval(&z->bsdf, z->wo, x.w, RADIANCE).pdf, density = z->pdf_fwd * pdf / roulette;
    for (x.t = 4; x.t <= p->n; x.t++) {
        struct vertex at = p->sample.eye[x.t - 1];
        at.beta = beta;
        for (x.s = 0; x.s <= (at.kind == VERTEX_SURFACE && x.t <= job->max_depth + 1); x.s++) {
            struct connection c =
                x.s == 0 ? reuse_hit(sample, &p->sample.eye[x.t - 2], &p->sample.eye[x.t - 1], beta)
                         : connect_s1(job->scene, sample->pass->counts, &at, &sample->sampler, 0, 1, &x.y);
            x.kind = x.s == 0 && x.t == 4 ? HIT : LATER;
            x.light = x.kind == HIT ? pdf * reuse_hit_density(sample, z, &z[1]) : c.weight;
            x.L = c.value;
            x.ends_on = c.light;
            if (own)
                sample_add(sample, (struct joined){.s = x.s, .t = x.t, .z = &p->sample.eye[x.t - 1], .c = &c,
                                                   .path = x.s == 1 ? &x.y : NULL, .pmf = 1, .scale = 1});
            else if (!rgb_is_black(c.value))
                offer(p, r, &x, density, sum);
        }
        if (x.t < p->n)
            beta = rgb_mul(beta, reuse_step(&p->sample.eye[x.t - 1], &p->sample.eye[x.t], &later));
    }
}

/* The pixel's own reservoir; what is not shared is added. */
static struct reservoir resample(struct pixel *p, bool shares)
{
    const struct vertex *z = &p->sample.eye[2];
    struct reservoir r = {.weight = 0, .shares = shares};
    double sum = 0;
    if (!shares || p->n < 3 || z->prev_delta || z->kind != VERTEX_SURFACE || !vertex_connectible(z)) {
        sample_alone(&p->sample, p->n);
        return r;
    }
    sample_alone(&p->sample, 2);
    sample_s0(&p->sample, 3);
    offer_point(p, &r, z, &sum);
    if (p->n > 3)
        offer_later(p, &r, z, &sum);
    r.weight *= sum;
    return r;
}

/* --- step 2 ------------------------------------------------------------------------------------------ */

/* May one pixel take over what the other has found, their densities being g and h? */
static bool near_enough(double g, double h) { return g < 10 * h && h < 10 * g; }

/* Add what pixel c makes of a tail. Observers get all vertices of the path. */
static void add_made(struct pixel *c, const struct tail *x, const struct connection *made, double scale)
{
    const struct tile_pass *pass = c->sample.pass;
    size_t t = (size_t)x->t, size = sizeof *c->sample.eye;
    struct joined j = {.s = x->s, .t = x->t, .c = made, .path = x->s == 1 ? &x->y : NULL, .pmf = 1, .scale = scale};
    if (pass->observer != NULL) {
        struct vertex *path = arena_alloc(&pass->work->arena, t * size);
        memcpy(path, c->sample.eye, 2 * size);
        memcpy(path + 2, x->z, (t - 2) * size);
        j.z = &path[t - 1];
    }
    sample_add(&c->sample, j);
}

/* near: S, [n] numbers of pixels, the first this one. */
static void reuse(struct pixel *pixel, const struct reservoir *all, const int *near, int n)
{
    struct pixel *c = &pixel[near[0]];
    struct connection kept = {.weight = 0}, made;
    double sum = 0, own = 0, others = 0, offered = 0, g = 0, h;
    int from = 0;
    for (int j = 0; j < n; j++) {
        const struct reservoir *r = &all[near[j]];
        double f = r->weight > 0 ? value_at(c, &r->x, &made, &h) : 0;
        if (!(f > 0) || !near_enough(h, r->g))
            continue;
        sum += f * r->weight;
        if (sampler_number(&c->sample.choice, DRAW_ORDER) * sum < f * r->weight) {
            kept = made;
            own = f;
            g = h;
            from = j;
        }
    }
    const struct tail *x = &all[near[from]].x;
    for (int k = 0; own > 0 && k < n; k++) {
        const struct vertex *z = &pixel[near[k]].sample.eye[1];
        double f = all[near[k]].shares ? value_at(&pixel[near[k]], x, &made, &h) : 0;
        bool seen = f > 0 && near_enough(h, g) &&
                    (k == from || scene_visible(c->sample.pass->job->scene, z->p, z->prim_id, x->z->p, x->z->prim_id));
        if (k == 0 && !seen)
            return;
        others += seen ? f : 0;
        offered = k == from ? f : offered;
    }
    if (own > 0)
        add_made(c, x, &kept, offered / others * sum / own);
}

static void connect_all(const struct prepared *p, const struct tile_pass *pass, const struct cache *cache,
                        struct pixel *pixel, int n)
{
    const struct restirgi *own = p->own;
    struct arena *arena = &pass->work->arena;
    struct reservoir *all = arena_alloc(arena, (size_t)n * sizeof *all);
    int *near = arena_alloc(arena, (size_t)n * (size_t)(own->neighbours + 1) * sizeof *near);
    int *found = arena_alloc(arena, (size_t)n * sizeof *found);
    (void)cache;
    for (int i = 0; i < n; i++) {
        if (pass_cancelled(pass))
            return;
        found[i] = reuse_neighbours(pixel, n, i, own->neighbours, &near[i * (own->neighbours + 1)]);
        all[i] = resample(&pixel[i], found[i] > 1);
    }
    for (int i = 0; i < n && !pass_cancelled(pass); i++)
        if (all[i].shares)
            reuse(pixel, all, &near[i * (own->neighbours + 1)], found[i]);
}

static void render(const struct prepared *p, const struct tile_pass *pass) { together_render(p, pass, connect_all); }

static const struct field OWN[] = {
    {"neighbours", FIELD_INTEGER, offsetof(struct restirgi, neighbours), 5, 0, MOST_NEIGHBOURS,
     "pixels whose second vertices it shares", NULL},
    {.name = NULL}};

static const struct field PARAMETERS[] = {PARAMETER_GUIDE(false), {.name = NULL}};

const struct method method_restirgi = {
    .name = "restirgi", .check = surfaces_alone, .parameters = PARAMETERS,
    .help = "reservoirs [Ouyang 2021]: second vertices resampled, and shared with pixels nearby",
    .own = OWN, .own_size = sizeof(struct restirgi), .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = reuse_prepare, .render = render};
