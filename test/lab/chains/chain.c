/* chain.c: see chain.h. */
#include "chains/chain.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"

enum {
    CHAIN_BLOCK = 4,              /* samples of each pixel of a tile, which a chain has as mutations */
    ALL_LENGTHS = 256, EACH = 64, /* states that a chain begins with: of all lengths, or of each */
    MOST_STATES = 1 << 27
};

/* --- states ------------------------------------------------------------------------------------------ */

double chain_propose(struct chain *c)
{
    const struct chain_rules *rules = c->all->rules;
    arena_reset(&c->work->arena);
    if (rules->propose != NULL)
        return rules->propose(c);
    c->next.length = c->now.length;
    rules->sample(c, rng_uniform(&c->rng) >= c->all->large_step);
    return c->next.I < c->now.I ? c->next.I / c->now.I : 1;
}

void chain_swap(struct chain *c)
{
    struct chain_state s = c->now;
    c->now = c->next;
    c->next = s;
}

void chain_candidate(struct chain *c, long i)
{
    long each = c->all->each;
    c->candidate = i % each;
    c->next.length = 2 + (int)(i / each);
    arena_reset(&c->work->arena);
    c->all->rules->sample(c, false);
    c->candidate = -1;
}

/* --- preparing --------------------------------------------------------------------------------------- */

void chain_prepare(const struct chain_rules *rules, const struct render_job *job, struct prepared *out)
{
    struct chains *all = out->own;
    const struct pixel_rect film = job->film_rect;
    const double *radius = job->scene->filter.radius;
    double pixels = (double)rect_width(film) * rect_height(film);
    all->rules = rules;
    all->x = film.x0 + 0.5 - radius[0];
    all->y = film.y0 + 0.5 - radius[1];
    all->width = rect_width(film) - 1 + 2 * radius[0];
    all->height = rect_height(film) - 1 + 2 * radius[1];
    all->scale = all->width * all->height / pixels;
    all->counts = counts_of(out->numbers, 1, 1, all->width * all->height, out->tables);
    all->counts.power = job->power_heuristic;
    all->lengths = rules->by_length ? job->max_depth + 1 : 1;
    all->each = all->starts > 0 ? all->starts : rules->by_length ? EACH : ALL_LENGTHS;
    if (all->each > MOST_STATES / all->lengths)
        all->each = MOST_STATES / all->lengths;
    out->size.block = CHAIN_BLOCK;
}

struct chain *chain_new(const struct prepared *m, const struct render_job *job, struct workspace *work)
{
    struct chain *c = mem_alloc(1, sizeof *c);
    c->all = m->own;
    c->job = job;
    c->work = work;
    c->light = mem_alloc((size_t)job->max_depth + 1, sizeof *c->light);
    c->before = mem_alloc((size_t)c->all->lengths * (size_t)c->all->each + 1, sizeof *c->before);
    if (c->all->rules->own_size > 0) {
        c->now.own = mem_alloc(1, c->all->rules->own_size);
        c->next.own = mem_alloc(1, c->all->rules->own_size);
    }
    return c;
}

static void free_state(const struct chain_rules *rules, struct chain_state *s)
{
    for (int i = 0; i < CHAIN_STREAMS; i++)
        free(s->number[i].number);
    if (rules->own_free != NULL)
        rules->own_free(s->own);
    free(s->own);
    tile_free(&s->heard);
}

void chain_free(struct chain *c)
{
    free_state(c->all->rules, &c->now);
    free_state(c->all->rules, &c->next);
    free(c->before);
    free(c->light);
    free(c);
}

/* --- one chain --------------------------------------------------------------------------------------- */

double chain_start(struct chain *c, double u)
{
    int n = c->all->lengths * c->all->each;
    c->before[0] = 0;
    for (int i = 0; i < n; i++) {
        if (pass_enough(c->job))
            return c->b = 0;
        chain_candidate(c, i);
        c->before[i + 1] = c->before[i] + c->next.I;
    }
    c->b = c->before[n] / c->all->each;
    if (c->b > 0) {
        chain_candidate(c, cumulative_find(c->before, n, u * c->before[n]));
        chain_swap(c);
    }
    return c->b;
}

/* What a pass begins with. */
static void start(struct chain *c, const struct tile_pass *pass)
{
    const struct pixel_rect r = pass->tile->pixels.rect; /* of no other tile */
    uint64_t width = (uint64_t)pass->job->scene->width, pixels = width * (uint64_t)pass->job->scene->height;
    uint64_t tile = (uint64_t)r.y0 * width + (uint64_t)r.x0;
    c->pass = (uint64_t)pass->first * pixels + tile;
    c->rng = rng_stream(pass->job->seed, RNG_CHAIN, 1 + tile, (uint64_t)pass->first);
    chain_start(c, rng_uniform(&c->rng));
}

/* A state's part of the picture. */
static void send(const struct chain *c, const struct tile_pass *pass, const struct chain_state *state, double share)
{
    struct tile *tile = pass->tile;
    double factor = share > 0 ? share * c->all->scale * c->b / state->I : 0;
    for (size_t i = 0; factor > 0 && i < state->heard.n_splats; i++) {
        const struct splat *s = &state->heard.splat[i];
        tile_add_splat(tile, s->px, s->py, rgb_scale(s->value, factor));
    }
    if (tile->full != NULL && tile->n_splats >= TILE_FULL)
        tile->full(tile->context, tile);
}

void chain_render(const struct prepared *m, const struct tile_pass *pass)
{
    struct chain *c = chain_new(m, pass->job, pass->work);
    long n = pixels_count(pass->tile->pixels) * (pass->end - pass->first);
    double held = 0; /* what the present state has counted since it was reached */
    start(c, pass);
    for (; c->b > 0 && n > 0 && !pass_enough(c->job); n--) {
        double a = chain_propose(c);
        held += 1 - a;
        if (rng_uniform(&c->rng) < a) {
            send(c, pass, &c->now, held);
            chain_swap(c);
            held = a;
        } else {
            send(c, pass, &c->next, a);
        }
    }
    send(c, pass, &c->now, held);
    chain_free(c);
}
