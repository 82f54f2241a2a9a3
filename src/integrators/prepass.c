/* prepass.c: see prepass.h. The sub-paths are cut into chunks; each chunk lists what it found, and the lists are taken
 * in in order (parallel.h), so sums and cell numbers are the same for any number of threads. */
#include "integrators/prepass.h"

#include <stdlib.h>

#include "transport/connect.h"
#include "base/number.h"
#include "base/parallel.h"

enum {
    CHUNK = 512,           /* sub-paths per chunk */
    EYE_PER_PIXEL = 2,     /* eye sub-paths, but at least MIN_EYE and at most MAX_EYE */
    MIN_EYE = 8 * 1024,
    MAX_EYE = 128 * 1024,
    MAX_LIGHT = 32 * 1024, /* light sub-paths for importance.mean, no more than eye sub-paths */
    GUIDE_CELLS = 8,      /* regions of the guide along the scene's diameter */
    ROUNDS = 3,            /* of learning the guide: each finds light with what the ones before have learnt */
    LIGHTS_PER_VERTEX = 4  /* light points tried from each eye vertex for the guide */
};

static const double GUIDE_DELTA = 0.2; /* share of s = 1 samples that choose lights by power */
static const double LEARN_DELTA = 0.5; /* the same while learning */

/* Something an eye vertex found. */
struct found {
    uint64_t key;
    int cell; /* light cell for the guide; -1: a deposit of importance */
    double value;
};

/* Sums over the connectible vertices of light sub-paths; I = luminance(beta) E. */
struct light_sums {
    double vertices, E, I, square; /* square: of I */
};

struct chunk {
    struct found *found; /* [n], owned */
    size_t n, capacity;
    struct light_sums light;
};

struct prepass {
    const struct render_job *job;
    struct importance *importance;
    struct guide_lessons *lessons; /* NULL: no guide wanted */
    struct mis_counts counts; /* weights are not used here; any will do */
    struct workspace *work;   /* [n_threads] */
    struct chunk *chunk;      /* [n_slots] */
    int64_t first_path, n_paths; /* sub-paths of this round: [first_path, n_paths) */
    struct light_sums light;
};

static void note(struct chunk *c, uint64_t key, int cell, double value)
{
    if (!(value > 1e-290) || !fits_float(value)) /* sums of them, and their shares of sums, stay finite */
        return;
    struct found f = {key, cell, value};
    c->found = mem_grow(c->found, &c->capacity, c->n + 1, sizeof *c->found);
    c->found[c->n++] = f;
}

static void study_vertex(const struct prepass *p, struct chunk *c, const struct vertex *z, struct sampler *sampler)
{
    if (z->kind != VERTEX_SURFACE || !vertex_connectible(z))
        return;
    if (p->importance != NULL)
        note(c, importance_key(p->importance, z->p, z->ng), -1, rgb_luminance(z->beta));
    for (int i = 0; p->lessons != NULL && i < LIGHTS_PER_VERTEX; i++) {
        int cell;
        struct connection found = connect_direct(p->job->scene, &p->counts, z, sampler, &cell);
        note(c, guide_key(&p->lessons->grid, z->p, z->ng), cell, rgb_luminance(found.value));
    }
}

/* Sub-path number i goes through point i of the sequence R2 [Roberts 2018], which fills the film evenly. */
static void trace_eye_chunk(void *context, int64_t job, int slot, int thread)
{
    struct prepass *p = context;
    struct workspace *work = &p->work[thread];
    struct pixel_rect film = p->job->film_rect;
    p->chunk[slot].n = 0;
    for (int64_t i = p->first_path + job * CHUNK; i < p->first_path + (job + 1) * CHUNK && i < p->n_paths; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, 0);
        struct walk w = {p->job->scene, &p->counts, &work->arena, &sampler, p->job->rr_threshold};
        double u = 0.5 + 0.7548776662466927 * (double)i, v = 0.5 + 0.5698402909980532 * (double)i;
        double px = film.x0 + (u - floor(u)) * rect_width(film), py = film.y0 + (v - floor(v)) * rect_height(film);
        int n = path_eye(&w, px, py, work->eye, p->job->max_depth + 1);
        for (int k = 1; k < n; k++)
            study_vertex(p, &p->chunk[slot], &work->eye[k], &sampler);
    }
}

static bool merge_eye_chunk(void *context, int64_t job, int slot)
{
    (void)job;
    struct prepass *p = context;
    for (size_t i = 0; i < p->chunk[slot].n; i++) {
        const struct found *f = &p->chunk[slot].found[i];
        if (f->cell < 0)
            importance_add(p->importance, f->key, f->value);
        else
            guide_lessons_add(p->lessons, f->key, f->cell, f->value);
    }
    return true;
}

static void study_light_vertex(const struct prepass *p, struct light_sums *s, const struct vertex *y)
{
    double E = importance_at(p->importance, y->p, y->ng), I = rgb_luminance(y->beta) * E;
    s->vertices++;
    s->E += E;
    s->I += I;
    s->square += I * I;
}

static void trace_light_chunk(void *context, int64_t job, int slot, int thread)
{
    struct prepass *p = context;
    struct workspace *work = &p->work[thread];
    struct light_sums zero = {0, 0, 0, 0};
    p->chunk[slot].light = zero;
    for (int64_t i = p->first_path + job * CHUNK; i < p->first_path + (job + 1) * CHUNK && i < p->n_paths; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, 1);
        struct walk w = {p->job->scene, &p->counts, &work->arena, &sampler, p->job->rr_threshold};
        int n = path_light(&w, work->light, p->job->max_depth + 1);
        for (int k = 1; k < n; k++)
            if (vertex_connectible(&work->light[k]))
                study_light_vertex(p, &p->chunk[slot].light, &work->light[k]);
    }
}

static bool merge_light_chunk(void *context, int64_t job, int slot)
{
    (void)job;
    struct prepass *p = context;
    const struct light_sums *s = &p->chunk[slot].light;
    p->light.vertices += s->vertices;
    p->light.E += s->E;
    p->light.I += s->I;
    p->light.square += s->square;
    return true;
}

/* Run `work` over the sub-paths 0 .. n_paths-1. */
static void run_chunks(struct prepass *p, void (*work)(void *, int64_t, int, int), bool (*merge)(void *, int64_t, int))
{
    int n_threads = p->job->n_threads, n_slots = 4 * n_threads;
    struct parallel_jobs jobs = {(p->n_paths - p->first_path + CHUNK - 1) / CHUNK, n_threads, n_slots, p, work, merge};
    p->chunk = mem_alloc((size_t)n_slots, sizeof *p->chunk);
    p->work = workspaces_new(n_threads, p->job->max_depth);
    parallel_run(&jobs);
    workspaces_free(p->work, n_threads);
    for (int i = 0; i < n_slots; i++)
        free(p->chunk[i].found);
    free(p->chunk);
}

/* Each round looks for light with what the rounds before have learnt; the guide is rebuilt between rounds only, while
 * no thread reads it. */
static void learn_in_rounds(struct prepass *p, long n_eye, struct guide *guide)
{
    for (int round = 0; round < ROUNDS; round++) {
        p->first_path = n_eye * round / ROUNDS;
        p->n_paths = n_eye * (round + 1) / ROUNDS;
        run_chunks(p, trace_eye_chunk, merge_eye_chunk);
        if (guide != NULL)
            guide_build(guide, p->lessons, round + 1 < ROUNDS ? LEARN_DELTA : GUIDE_DELTA);
        p->counts.guide = guide;
    }
}

void prepass_run(const struct render_job *job, struct importance *importance, struct guide *guide)
{
    struct prepass p = {.job = job, .importance = importance};
    struct guide_lessons lessons;
    guide_lessons_init(&lessons, &job->scene->lights, GUIDE_CELLS);
    p.lessons = guide != NULL ? &lessons : NULL;
    p.counts.direct = 1;
    long wanted = (long)rect_width(job->film_rect) * rect_height(job->film_rect) * EYE_PER_PIXEL;
    long n_eye = wanted < MIN_EYE ? MIN_EYE : wanted > MAX_EYE ? MAX_EYE : wanted;
    learn_in_rounds(&p, n_eye, guide);
    guide_lessons_free(&lessons);
    if (importance == NULL)
        return;
    p.first_path = 0;
    p.n_paths = n_eye < MAX_LIGHT ? n_eye : MAX_LIGHT;
    run_chunks(&p, trace_light_chunk, merge_light_chunk);
    importance->mean = p.light.E / (double)p.n_paths;
    importance->useful = p.light.square > 0 ? p.light.I * p.light.I / (p.light.square * p.light.vertices) : 1;
}
