/* primary.c: see primary.h. */
#include "chains/primary.h"

#include "caustics/joint.h"

#include <stddef.h>

#include "base/maths.h"
#include "base/number.h"

const struct field CHAIN_SHARED[] = {PARAMETER_GUIDE(false), {.name = NULL}};

const struct field CHAIN_PARAMETERS[] = {
    {"sigma", FIELD_NUMBER, offsetof(struct chains, sigma), 0.01, 1e-6, 1,
     "standard deviation of a number's small step", NULL},
    {"starts", FIELD_INTEGER, offsetof(struct chains, starts), 0, 0, 1 << 24,
     "independent states, of which chains start; 0: 100,000, or a number for each pixel if that is less", NULL},
    {"largestepprobability", FIELD_NUMBER, offsetof(struct chains, large_step), 0.3, 1e-3, 1,
     "of a mutation that draws all numbers again", NULL},
    {.name = NULL}};

/* Two numbers, normal with the given standard deviation.                                       [Box & Muller 1958] */
static void normal_pair(struct rng *r, double sigma, double out[2])
{
    double radius = sigma * sqrt(-2 * m_log(1 - rng_uniform(r))), sine, cosine;
    m_sincos(2 * PI * rng_uniform(r), &sine, &cosine);
    out[0] = radius * cosine;
    out[1] = radius * sine;
}

static void move(const struct tape *from, struct tape *to, double sigma, struct rng *r)
{
    double step[2] = {0, 0};
    to->number = mem_grow(to->number, &to->capacity, from->n, sizeof *to->number);
    for (size_t i = 0; i < from->n; i++) {
        if (i % 2 == 0)
            normal_pair(r, sigma, step);
        double u = from->number[i] + step[i % 2];
        to->number[i] = below_one(u - floor(u));
    }
    to->n = from->n;
}

/* Numbers of one kind for `next`: plain random ones, but those of independent states, which are many, are of
 * low discrepancy from one to the next. */
static struct sampler numbers(const struct chain *c, enum chain_stream stream, uint64_t key)
{
    uint64_t kind = (uint64_t)c->next.length * CHAIN_STREAMS + stream;
    return c->candidate >= 0 ? sampler_start(c->job->seed, RNG_START, kind, (uint64_t)c->candidate)
                             : sampler_start(key, RNG_CHAIN, stream, 0);
}

void primary_begin(struct primary *p, struct chain *c, bool small)
{
    uint64_t key = 0;
    for (int i = 0; i < 2 && c->candidate < 0; i++)
        key = key << 32 | rng_u32(&c->rng);
    p->chain = c;
    p->state = &c->next;
    p->state->heard.n_splats = 0;
    for (int i = 0; i < CHAIN_STREAMS; i++) {
        struct tape *tape = &p->state->number[i];
        tape->n = tape->at = 0;
        if (small)
            move(&c->now.number[i], tape, c->all->sigma, &c->rng);
        p->sampler[i] = tape_play(tape, numbers(c, (enum chain_stream)i, key));
    }
}

void primary_end(struct primary *p)
{
    const struct chains *all = p->chain->all;
    struct tile *heard = &p->state->heard;
    size_t kept = 0;
    for (int i = 0; i < CHAIN_STREAMS; i++)
        p->state->number[i].n = p->state->number[i].at;
    p->state->I = 0;
    for (size_t i = 0; i < heard->n_splats; i++) {
        struct splat s = heard->splat[i];
        double x = s.px - all->x, y = s.py - all->y, L = rgb_luminance(s.value);
        if (!(L > 0) || x < 0 || y < 0 || x > all->width || y > all->height)
            continue;
        heard->splat[kept++] = s;
        p->state->I += L;
    }
    heard->n_splats = kept;
}

struct walk primary_walk(struct primary *p, enum chain_stream stream)
{
    struct chain *c = p->chain;
    struct walk w = {c->job->scene, &c->all->counts, &c->work->arena, &p->sampler[stream],
                     c->all->rules->roulette ? c->job->rr_threshold : 0};
    return w;
}

int primary_eye(struct primary *p, int n, double *px, double *py)
{
    const struct chains *all = p->chain->all;
    struct walk w = primary_walk(p, EYE_NUMBERS);
    double u[2];
    sampler_pair(w.sampler, DRAW_FILM_POINT, u);
    *px = all->x + u[0] * all->width;
    *py = all->y + u[1] * all->height;
    return path_eye(&w, *px, *py, p->chain->work->eye, n);
}

int primary_light(struct primary *p, int n)
{
    struct walk w = primary_walk(p, LIGHT_NUMBERS);
    return path_light(&w, p->chain->light, n, NULL);
}

struct connection primary_lens(struct primary *p, const struct vertex *y, struct strategy *of)
{
    double raster[2];
    struct connection c =
        connect_lens(p->chain->job->scene, &p->chain->all->counts, y, &p->sampler[LENS_NUMBERS], raster);
    of->px = raster[0];
    of->py = raster[1];
    return c;
}

/* Join sub-paths of s and t vertices. */
static struct connection join(struct primary *p, struct strategy *of)
{
    int s = of->s, t = of->t;
    const struct scene *scene = p->chain->job->scene;
    const struct counts *counts = &p->chain->all->counts;
    const struct vertex *y = &p->chain->light[s - 1], *z = &p->chain->work->eye[t - 1];
    static const struct connection NOTHING = {.light = -1};
    struct vertex y0;
    if (s == 0)
        return connect_s0(scene, counts, z - 1, z);
    if (s == 1)
        return z->kind == VERTEX_ESCAPED
                   ? NOTHING
                   : connect_s1(scene, counts, z, &p->sampler[POINT_NUMBERS], 0, 1, &y0);
    if (t == 1)
        return primary_lens(p, y, of);
    return connect_vertices(scene, counts, y, z);
}

/* What arrives from the light (t = 1) does so at every raster point that is the same ray. */
bool primary_bring(struct primary *p, const struct connection *c, struct strategy *out)
{
    const struct scene *scene = p->chain->job->scene;
    const double *radius = scene->filter.radius;
    double each = out->t > 1 ? 1 : 1 / p->chain->all->counts.lens;
    if (rgb_is_black(c->value))
        return false;
    out->value = rgb_scale(c->value, c->weight * out->n * each);
    for (int i = 0; i < (out->t > 1 ? 1 : camera_images(&scene->camera, radius)); i++) {
        double px = out->px, py = out->py;
        if (out->t == 1)
            camera_image(&scene->camera, radius, i, &px, &py);
        tile_add_splat(&p->state->heard, px, py, out->value);
    }
    return true;
}

bool primary_strategy(struct primary *p, struct strategy *out)
{
    int length = p->state->length;
    out->n = length > 2 ? length : 1; /* a light that is seen directly: s = 0 alone */
    out->s = (int)(sampler_number(&p->sampler[STRATEGY_NUMBERS], DRAW_HOW_MANY) * out->n);
    out->t = length - out->s;
    if (primary_eye(p, out->t, &out->px, &out->py) < out->t || (out->s > 1 && primary_light(p, out->s) < out->s))
        return false;
    struct connection c = join(p, out);
    return primary_bring(p, &c, out);
}
