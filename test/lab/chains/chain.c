/* chain.c: see chain.h. */
#include "chains/chain.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/cumulative.h"
#include "base/number.h"
#include "base/parallel.h"

enum {
    CHAIN_BLOCK = 4,                       /* samples of each pixel of a tile, which a chain has as mutations */
    LEAST_EACH = 1 << 14, MOST_EACH = 1 << 20, /* independent states of a length unless the user says, between these */
    FULL_LENGTHS = 8,                      /* so long as there are no more lengths than these, which share them then */
    MOST_STATES = 1 << 27,                 /* in any case */
    BATCHES = 16,                          /* of these, for the error of their mean */
    BOOTSTRAP_JOB = 256                    /* at a time */
};

static const double BOOTSTRAP_PER_PIXEL = 4;

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

/* --- independent states ------------------------------------------------------------------------------ */

struct bootstrap {
    struct chains *all;
    const struct render_job *job;
    struct workspace *work; /* [n_threads], with a chain each */
};

static void run_candidates(void *context, int64_t job, int slot, int thread)
{
    struct bootstrap *b = context;
    long n = (long)b->all->lengths * b->all->each, end = (long)(job + 1) * BOOTSTRAP_JOB;
    struct chain *c = b->work[thread].scratch;
    (void)slot;
    c->job = b->job;
    c->work = &b->work[thread];
    for (long i = (long)job * BOOTSTRAP_JOB; i < end && i < n; i++) {
        chain_candidate(c, i);
        b->all->before[i + 1] = c->next.I;
    }
}

/* They are never too few: whoever watches is told, but not asked. */
static bool candidates_done(void *context, int64_t job, int slot)
{
    const struct bootstrap *b = context;
    (void)slot;
    if (b->job->watch != NULL)
        b->job->watch(b->job->watch_context, (double)(job + 1) * BOOTSTRAP_JOB);
    return true;
}

static void run_bootstrap(const struct preparation *m, const struct render_job *job)
{
    struct chains *all = m->state;
    struct bootstrap b = {all, job, workspaces_new(job->n_threads, job->max_depth)};
    long n = (long)all->lengths * all->each;
    struct parallel_jobs jobs = {(n + BOOTSTRAP_JOB - 1) / BOOTSTRAP_JOB, job->n_threads,
                                 SLOTS_PER_THREAD * job->n_threads, &b, run_candidates, candidates_done, NULL};
    for (int i = 0; i < job->n_threads; i++)
        b.work[i].scratch = method_scratch(m);
    parallel_run(&jobs);
    for (int i = 0; i < job->n_threads; i++)
        method_scratch_free(m, b.work[i].scratch);
    workspaces_free(b.work, job->n_threads);
}

/* Variance of the mean of n numbers of low discrepancy, given their running sums [n + 1]: from the means of batches. */
static double variance_of_mean(const double *before, int n)
{
    double size = (double)n / BATCHES, mean = (before[n] - before[0]) / n, sum = 0;
    for (int i = 0; i < BATCHES; i++)
        sum += sqr((before[(int)((i + 1) * size)] - before[(int)(i * size)]) / size - mean);
    return sum / (BATCHES * (BATCHES - 1));
}

/* From the I of all states to their sums and b, which is the sum of the means of all lengths; its standard error. */
static double sum_up(struct chains *all)
{
    double variance = 0;
    for (int k = 0; k < all->lengths; k++) {
        double *before = &all->before[(long)k * all->each];
        for (int i = 1; i <= all->each; i++)
            before[i] += before[i - 1];
        variance += variance_of_mean(before, all->each);
    }
    all->b = all->before[(long)all->lengths * all->each] / all->each;
    return sqrt(variance);
}

static void choose_numbers(struct chains *all, const struct render_job *job)
{
    const struct pixel_rect film = job->film_rect;
    const double *radius = job->scene->filter.radius;
    double pixels = (double)rect_width(film) * rect_height(film);
    all->x = film.x0 + 0.5 - radius[0];
    all->y = film.y0 + 0.5 - radius[1];
    all->width = rect_width(film) - 1 + 2 * radius[0];
    all->height = rect_height(film) - 1 + 2 * radius[1];
    all->scale = all->width * all->height / pixels;
    all->frozen.counts.splat = all->width * all->height;
    all->lengths = all->rules->by_length ? job->max_depth + 1 : 1;
    double wanted = clamp(BOOTSTRAP_PER_PIXEL * pixels, LEAST_EACH, MOST_EACH);
    if (all->lengths > FULL_LENGTHS)
        wanted *= (double)FULL_LENGTHS / all->lengths;
    if (all->bootstrap > 0)
        wanted = all->bootstrap;
    all->each = int_within(wanted, BATCHES, MOST_STATES / all->lengths);
}

void chain_prepare(const struct chain_rules *rules, const struct render_job *job, struct preparation *out)
{
    struct chains *all = out->state;
    all->rules = rules;
    choose_numbers(all, job);
    all->before = mem_alloc((size_t)all->lengths * (size_t)all->each + 1, sizeof *all->before);
    run_bootstrap(out, job);
    double error = sum_up(all), share = all->b > 0 ? error / all->b : 0;
    const struct film_number b = {"bootstrap", all->b}, e = {"bootstrap_error", error};
    out->number[0] = b;
    out->number[1] = e;
    out->size.block = CHAIN_BLOCK;
    snprintf(out->note, sizeof out->note, "mean luminance %.4g, known to %.2g %% by %ld independent states", all->b,
             100 * share, (long)all->lengths * all->each);
}

void chain_release(void *state) { free(((struct chains *)state)->before); }

void chain_scratch(void *scratch, const void *state)
{
    struct chain *c = scratch;
    c->all = state;
    if (c->all->rules->own_size > 0) {
        c->now.own = mem_alloc(1, c->all->rules->own_size);
        c->next.own = mem_alloc(1, c->all->rules->own_size);
    }
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

void chain_scratch_free(void *scratch)
{
    struct chain *c = scratch;
    free_state(c->all->rules, &c->now);
    free_state(c->all->rules, &c->next);
}

/* --- one chain --------------------------------------------------------------------------------------- */

double chain_position(const struct preparation *m, const struct tile_pass *pass)
{
    const struct pixel_rect film = pass->job->film_rect, r = pass->rect;
    double pixels = (double)rect_width(film) * rect_height(film);
    double before = (double)(r.y0 - film.y0) * rect_width(film) + (double)(r.x0 - film.x0) * rect_height(r);
    struct rng rng = rng_stream(pass->job->seed, RNG_CHAIN, 0, 0);
    double u = rng_uniform(&rng) + 0.6180339887498949 * (double)(pass->first / m->size.block);
    return (before + (u - floor(u)) * rect_width(r) * rect_height(r)) / pixels;
}

/* The chain's first state, made again as it was. */
static void start(struct chain *c, const struct preparation *m, const struct tile_pass *pass)
{
    const struct chains *all = c->all;
    int n = all->lengths * all->each;
    int i = cumulative_find(all->before, n, chain_position(m, pass) * all->before[n]);
    chain_candidate(c, i);
    assert(c->next.I > 0 && fabs(c->next.I - (all->before[i + 1] - all->before[i])) <= 1e-9 * all->before[n]);
    chain_swap(c);
    uint64_t tile = (uint64_t)pass->rect.y0 * (uint64_t)pass->job->scene->width + (uint64_t)pass->rect.x0;
    c->rng = rng_stream(pass->job->seed, RNG_CHAIN, 1 + tile, (uint64_t)pass->first);
}

/* A state's part of the picture. */
static void send(const struct chain *c, const struct tile_pass *pass, const struct chain_state *state, double share)
{
    struct tile *tile = pass->tile;
    double factor = share > 0 ? share * c->all->scale * c->all->b / state->I : 0;
    for (size_t i = 0; factor > 0 && i < state->heard.n_splats; i++) {
        const struct splat *s = &state->heard.splat[i];
        bool many = isnan(s->length);
        if (many || gate_holds(c->gate, s->length))
            tile_add_splat(tile, s->px, s->py, rgb_scale(many ? state->until : s->value, factor), s->length, 0);
        if (many && !rgb_is_black(state->before))
            tile_add_splat(tile, s->px, s->py, rgb_scale(state->before, -factor), s->length, 0);
    }
    if (tile->full != NULL && tile->n_splats >= TILE_FULL)
        tile->full(tile->context, tile);
}

void chain_render(const struct preparation *m, const struct tile_pass *pass)
{
    struct chain *c = pass->work->scratch;
    const struct chains *all = m->state;
    long n = rect_width(pass->rect) * rect_height(pass->rect) * (pass->end - pass->first);
    double held = 0; /* what the present state has counted since it was reached */
    if (!(all->b > 0))
        return;
    c->job = pass->job;
    c->work = pass->work;
    c->gate = pass->tile->gate;
    for (start(c, m, pass); n > 0; n--) {
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
}
