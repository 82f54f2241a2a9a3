/* chain.c: see chain.h. */
#include "chains/chain.h"

#include <math.h>
#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"

enum {
    CHAINS = 1000,                /* of a picture, about */
    CHAIN_BLOCK = 1024,           /* most samples of each pixel that they have as mutations */
    MOST_STATES = 100000,         /* independent ones, unless a parameter says otherwise, */
    STATES_OF_ALL = 2, STATES_BY_LENGTH = 32, /* or so many for each pixel, if that is less */
    ASKED_EVERY = 256 /* states, before preparing asks whether it may go on */
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
    c->candidate = i / c->all->lengths;
    c->next.length = 2 + (int)(i % c->all->lengths);
    arena_reset(&c->work->arena);
    c->all->rules->sample(c, false);
    c->candidate = -1;
}

/* --- preparing --------------------------------------------------------------------------------------- */

/* The pool of independent states; of less if it takes too long. */
static void fill_pool(struct chains *all, const struct render_job *job, struct prepared *m)
{
    struct workspace *work = workspaces_new(1, job->max_depth);
    struct chain *c = chain_new(m, job, work);
    int n = 0;
    all->before = mem_alloc((size_t)all->n + 1, sizeof *all->before);
    int most = job->scene->lights.n > 0 ? all->n : 0;
    for (; n < most && (n % ASKED_EVERY > 0 || job_cancelled(job) == CANCEL_NOT); n++) {
        if (n % ASKED_EVERY == 0)
            job_progress(job, (double)n / most, 0);
        chain_candidate(c, n);
        all->before[n + 1] = all->before[n] + c->next.I;
    }
    all->n = n - n % all->lengths;
    all->b = all->n > 0 ? all->before[all->n] / all->n * all->lengths : 0;
    chain_free(c);
    workspaces_free(work, 1);
}

void chain_prepare(const struct chain_rules *rules, const struct render_job *job, struct prepared *out)
{
    struct chains *all = out->own;
    const struct pixel_rect film = job->film_rect;
    const double *radius = job->scene->filter.radius;
    double pixels = (double)rect_pixels(film);
    all->rules = rules;
    all->x = film.x0 + 0.5 - radius[0];
    all->y = film.y0 + 0.5 - radius[1];
    all->width = rect_width(film) - 1 + 2 * radius[0];
    all->height = rect_height(film) - 1 + 2 * radius[1];
    all->scale = all->width * all->height / pixels;
    all->counts = counts_of(out->numbers, 1, (double[]){1, 1}, 0, all->width * all->height, out->tables);
    all->lengths = rules->by_length ? job->max_depth + 1 : 1;
    int each = rules->by_length ? STATES_BY_LENGTH : STATES_OF_ALL;
    int n = all->starts > 0 ? all->starts : (int)fmin(each * pixels, MOST_STATES);
    all->n = (n + all->lengths - 1) / all->lengths * all->lengths;
    out->size = (struct pass_size){CHAIN_BLOCK, (int)fmax(1, floor(sqrt(pixels / CHAINS) + 0.5)), 1};
    fill_pool(all, job, out);
}

void chain_release(struct prepared *m) { free(((struct chains *)m->own)->before); }

struct chain *chain_new(const struct prepared *m, const struct render_job *job, struct workspace *work)
{
    struct chain *c = mem_alloc(1, sizeof *c);
    c->all = m->own;
    c->job = job;
    c->work = work;
    c->light = mem_alloc((size_t)job->max_depth + 1, sizeof *c->light);
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
    free(c->light);
    free(c);
}

/* --- one chain --------------------------------------------------------------------------------------- */

void chain_start(struct chain *c, double u)
{
    const struct chains *all = c->all;
    chain_candidate(c, cumulative_find(all->before, all->n, u * all->before[all->n]));
    chain_swap(c);
}

/* What a pass begins with. */
static void start(struct chain *c, const struct tile_pass *pass)
{
    const struct pixel_rect r = pass->tile->pixels.rect; /* of no other tile */
    uint64_t tile = (uint64_t)r.y0 * (uint64_t)pass->job->scene->width + (uint64_t)r.x0;
    c->rng = rng_stream(pass->job->seed, RNG_CHAIN, 1 + tile, (uint64_t)pass->first);
    chain_start(c, rng_uniform(&c->rng));
}

/* A state's part of the picture. */
static void send(const struct chain *c, const struct tile_pass *pass, const struct chain_state *state, double share)
{
    struct tile *tile = pass->tile;
    double factor = share > 0 ? share * c->all->scale * c->all->b / state->I : 0;
    for (size_t i = 0; factor > 0 && i < state->heard.n_splats; i++) {
        const struct splat *s = &state->heard.splat[i];
        tile_add_splat(tile, s->px, s->py, rgb_scale(s->value, factor));
    }
    if (tile->full != NULL && tile->n_splats >= TILE_FULL)
        tile->full(tile->context, tile);
}

void chain_render(const struct prepared *m, const struct tile_pass *pass)
{
    if (!(((const struct chains *)m->own)->b > 0))
        return;
    struct chain *c = chain_new(m, pass->job, pass->work);
    long n = pixels_count(pass->tile->pixels) * (pass->end - pass->first);
    double held = 0; /* what the present state has counted since it was reached */
    for (start(c, pass); n > 0 && !pass_cancelled(pass); n--) {
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
