/* prepass.c: see prepass.h. The sub-paths are cut into chunks; each chunk lists what it found, and the lists are taken
 * in in order (parallel.h), so sums and region numbers are the same for any number of threads. */
#include "integrators/prepass.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"
#include "transport/connect.h"

enum {
    CHUNK = 256,            /* sub-paths per chunk */
    MAX_LIGHT = 32 * 1024,  /* light sub-paths for the means, no more than eye sub-paths */
    ROUNDS = 3,             /* of eye sub-paths: each finds light with what the ones before have learnt */
    LIGHTS_PER_VERTEX = 4,  /* light points tried from each eye vertex for the guide */
    POOL = 64,              /* light sub-paths of a chunk for the trials of pairs */
    TRIALS = 8,             /* trial connections from each eye vertex */
    MAX_EYE_REGIONS = 2048,
    MAX_PAIR_REGIONS = 4096 /* light regions that pairs are learnt for */
};

static const double GUIDE_DELTA = 0.2; /* share of s = 1 samples that choose lights by power */
static const double LEARN_DELTA = 0.5; /* the same while learning */

/* Which stream of RNG_PREPASS. */
enum { STREAM_EYE, STREAM_LIGHT, STREAM_POOL };

/* Something a vertex found. */
struct found {
    enum { VISIT, LIGHT_SEEN, TRIAL, LIGHT_VERTEX } kind;
    uint64_t eye, light; /* keys of its regions; TRIAL: of z's eye region and y's light region */
    int cell;            /* LIGHT_SEEN: the light cell; VISIT: whether it is the first hit */
    /* VISIT: luminance of beta; LIGHT_SEEN: contribution; TRIAL: worth; LIGHT_VERTEX: luminance of beta */
    double x;
    double w;            /* TRIAL: weight */
};

struct chunk {
    struct found *found; /* [n], owned */
    size_t n, capacity;
};

/* A light vertex that trials may choose. */
struct trial_vertex {
    const struct vertex *y;
    double L, useful; /* luminance(beta), n_E */
    double before;    /* sum of L useful of the candidates before it */
};

/* Memory of one thread for the light sub-paths of a chunk. */
struct light_stock {
    struct arena arena;
    struct vertex *vertex; /* POOL times max_depth + 1 of them; owned */
    struct trial_vertex *candidate;
    int n;
    double total;
};

/* Sums over the connectible vertices of light sub-paths; I = luminance(beta) E. */
struct light_sums {
    double vertices, E, I, square; /* square: of I */
};

struct prepass {
    const struct render_job *job;
    const struct prepass_wish *wish;
    struct importance *importance;
    struct learnt *learnt;     /* what the walks look things up in: changes between rounds only */
    struct regions eye, light; /* what was met until now */
    struct guide_lessons lights;
    struct pair_lessons pairs;
    struct mis_counts counts; /* weights are not used here; any will do */
    struct workspace *work;   /* [n_threads] */
    struct light_stock *stock; /* [n_threads] */
    struct chunk *chunk;      /* [n_slots] */
    long first_path, n_paths; /* sub-paths of this round: [first_path, n_paths) */
    int round;
    struct light_sums light_sums;
};

static bool trying_pairs(const struct prepass *p) { return p->wish->pairs && p->round > 0; }

static void list_found(struct chunk *c, struct found f)
{
    bool nothing = f.kind != TRIAL && !(f.x > 1e-290); /* sums of them, and their shares of sums, stay finite */
    if (nothing || !(f.x >= 0) || !fits_float(f.x))
        return;
    c->found = mem_grow(c->found, &c->capacity, c->n + 1, sizeof *c->found);
    c->found[c->n++] = f;
}

static struct walk walk_of(const struct prepass *p, struct arena *arena, struct sampler *sampler)
{
    struct walk w = {p->job->scene, &p->counts, arena, sampler, p->job->rr_threshold};
    return w;
}

/* --- trials between pairs of regions ----------------------------------------------------------------- */

/* Trace the light sub-paths of the chunk whose first eye sub-path is number `first`: a name no other chunk has, in
 * whatever round. */
static void fill_stock(const struct prepass *p, struct light_stock *s, long first)
{
    int longest = p->job->max_depth + 1;
    arena_reset(&s->arena);
    s->n = 0;
    s->total = 0;
    for (long k = 0; k < POOL; k++) {
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)(first * POOL + k), STREAM_POOL);
        struct walk w = walk_of(p, &s->arena, &sampler);
        struct vertex *path = &s->vertex[k * longest];
        int n = path_light(&w, path, longest);
        for (int i = 1; i < n; i++) {
            double L = rgb_luminance(path[i].beta), E = importance_in(p->importance, path[i].light_region);
            double useful =
                (1 - p->wish->delta) * (p->importance->mean > 0 ? E / p->importance->mean : 0) + p->wish->delta;
            if (!vertex_connectible(&path[i]) || !(L * useful > 1e-290) || !fits_float(L * useful))
                continue;
            struct trial_vertex c = {&path[i], L, useful, s->total};
            s->candidate[s->n++] = c;
            s->total += L * useful;
        }
    }
}

static const struct trial_vertex *choose(const struct light_stock *s, double u)
{
    int low = 0, high = s->n;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (s->candidate[middle].before <= u * s->total)
            low = middle;
        else
            high = middle;
    }
    return &s->candidate[low];
}

/* Connect z to TRIALS light vertices. Close vertices would shout everything else down: their worth is what it would be
 * a quarter of a region apart. */
static void try_pairs(const struct prepass *p, struct chunk *c, const struct light_stock *s, const struct vertex *z,
                      struct sampler *sampler)
{
    double near2 = sqr(0.25 / p->learnt->eye.per_metre), beta = rgb_luminance(z->beta);
    for (int i = 0; i < TRIALS && s->n > 0 && beta > 0; i++) {
        const struct trial_vertex *y = choose(s, (i + sampler_number(sampler, DRAW_LIGHT_END)) / TRIALS);
        struct connection found = connect_pair(p->job->scene, &p->counts, y->y, z);
        double d2 = length2(sub(y->y->p, z->p));
        struct found f = {.kind = TRIAL, .eye = regions_key(&p->learnt->eye, z->p, z->ng)};
        f.light = regions_key(&p->learnt->light, y->y->p, y->y->ng);
        f.x = rgb_luminance(found.value) / (beta * y->L) * (d2 > 0 ? d2 / (d2 + near2) : 0);
        f.w = beta / y->useful;
        list_found(c, f);
    }
}

/* --- eye sub-paths ----------------------------------------------------------------------------------- */

static void examine_eye_vertex(const struct prepass *p, struct chunk *c, const struct light_stock *s,
                               const struct vertex *z, struct sampler *sampler)
{
    if (!vertex_connectible(z))
        return;
    struct found visit = {.kind = VISIT, .eye = regions_key(&p->learnt->eye, z->p, z->ng)};
    visit.light = regions_key(&p->learnt->light, z->p, z->ng);
    visit.x = rgb_luminance(z->beta);
    visit.cell = z->first;
    list_found(c, visit);
    for (int i = 0; p->wish->guide && i < LIGHTS_PER_VERTEX; i++) {
        struct connection light = connect_direct(p->job->scene, &p->counts, z, sampler);
        struct found seen = {.kind = LIGHT_SEEN, .eye = visit.eye, .cell = light.cell, .x = rgb_luminance(light.value)};
        list_found(c, seen);
    }
    if (trying_pairs(p))
        try_pairs(p, c, s, z, sampler);
}

/* Sub-path number i goes through point i of an even sequence over the film. */
static void trace_eye_chunk(void *context, int64_t job, int slot, int thread)
{
    struct prepass *p = context;
    struct workspace *work = &p->work[thread];
    struct pixel_rect film = p->job->film_rect;
    long first = p->first_path + (long)job * CHUNK, end = first + CHUNK < p->n_paths ? first + CHUNK : p->n_paths;
    p->chunk[slot].n = 0;
    if (trying_pairs(p))
        fill_stock(p, &p->stock[thread], first);
    for (long i = first; i < end; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, STREAM_EYE);
        struct walk w = walk_of(p, &work->arena, &sampler);
        double u, v;
        sampler_r2(i, &u, &v);
        int n = path_eye(&w, film.x0 + u * rect_width(film), film.y0 + v * rect_height(film), work->eye,
                         p->job->max_depth + 1);
        for (int k = 1; k < n; k++)
            examine_eye_vertex(p, &p->chunk[slot], &p->stock[thread], &work->eye[k], &sampler);
    }
}

static void merge_visit(struct prepass *p, const struct found *f)
{
    p->importance->eye_vertices += 1.0 / (double)p->wish->n_eye;
    p->importance->first_vertices += f->cell / (double)p->wish->n_eye;
    if (trying_pairs(p))
        return;
    regions_add(&p->eye, f->eye);
    if (p->wish->importance)
        importance_add(p->importance, regions_add(&p->light, f->light), f->x);
}

static bool merge_chunk(void *context, int64_t job, int slot)
{
    (void)job;
    struct prepass *p = context;
    for (size_t i = 0; i < p->chunk[slot].n; i++) {
        const struct found *f = &p->chunk[slot].found[i];
        switch (f->kind) {
        case VISIT: merge_visit(p, f); break;
        case LIGHT_SEEN: guide_lessons_add(&p->lights, &p->eye, regions_find(&p->eye, f->eye), f->cell, f->x); break;
        case TRIAL:
            pair_lessons_add(&p->pairs, &p->eye, &p->light, regions_find(&p->eye, f->eye),
                             regions_find(&p->light, f->light), f->x, f->w);
            break;
        case LIGHT_VERTEX: break;
        }
    }
    return true;
}

/* --- light sub-paths --------------------------------------------------------------------------------- */

static void trace_light_chunk(void *context, int64_t job, int slot, int thread)
{
    struct prepass *p = context;
    struct workspace *work = &p->work[thread];
    long first = p->first_path + (long)job * CHUNK, end = first + CHUNK < p->n_paths ? first + CHUNK : p->n_paths;
    p->chunk[slot].n = 0;
    for (long i = first; i < end; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, STREAM_LIGHT);
        struct walk w = walk_of(p, &work->arena, &sampler);
        int n = path_light(&w, work->light, p->job->max_depth + 1);
        for (int k = 1; k < n; k++) {
            const struct vertex *y = &work->light[k];
            struct found f = {.kind = LIGHT_VERTEX, .light = regions_key(&p->learnt->light, y->p, y->ng)};
            f.x = rgb_luminance(y->beta);
            if (vertex_connectible(y))
                list_found(&p->chunk[slot], f);
        }
    }
}

static bool merge_light_chunk(void *context, int64_t job, int slot)
{
    (void)job;
    struct prepass *p = context;
    for (size_t i = 0; i < p->chunk[slot].n; i++) {
        const struct found *f = &p->chunk[slot].found[i];
        int region = p->wish->pairs ? regions_add(&p->light, f->light) : regions_find(&p->light, f->light);
        double E = importance_in(p->importance, region), I = f->x * E;
        p->light_sums.vertices++;
        p->light_sums.E += E;
        p->light_sums.I += I;
        p->light_sums.square += I * I;
        if (p->wish->pairs)
            p->importance->vertices[region]++;
    }
    return true;
}

/* --- rounds ------------------------------------------------------------------------------------------ */

static void make_stock(struct prepass *p)
{
    size_t longest = (size_t)p->job->max_depth + 1;
    p->stock = mem_alloc((size_t)p->job->n_threads, sizeof *p->stock);
    for (int i = 0; p->wish->pairs && i < p->job->n_threads; i++) {
        p->stock[i].vertex = mem_alloc(POOL * longest, sizeof *p->stock[i].vertex);
        p->stock[i].candidate = mem_alloc(POOL * longest, sizeof *p->stock[i].candidate);
    }
}

static void free_stock(struct prepass *p)
{
    for (int i = 0; i < p->job->n_threads; i++) {
        arena_free(&p->stock[i].arena);
        free(p->stock[i].vertex);
        free(p->stock[i].candidate);
    }
    free(p->stock);
}

/* Run `work` over the sub-paths first_path .. n_paths-1. */
static void run_chunks(struct prepass *p, void (*work)(void *, int64_t, int, int), bool (*merge)(void *, int64_t, int))
{
    int n_threads = p->job->n_threads, n_slots = 4 * n_threads;
    struct parallel_jobs jobs = {(p->n_paths - p->first_path + CHUNK - 1) / CHUNK, n_threads, n_slots, p, work,
                                 merge, NULL};
    p->chunk = mem_alloc((size_t)n_slots, sizeof *p->chunk);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots; i++)
        free(p->chunk[i].found);
    free(p->chunk);
}

static void trace_light(struct prepass *p)
{
    struct importance *g = p->importance;
    p->first_path = 0;
    p->n_paths = p->wish->n_eye < MAX_LIGHT ? p->wish->n_eye : MAX_LIGHT;
    g->vertices = mem_alloc(MAX_PAIR_REGIONS, sizeof *g->vertices);
    run_chunks(p, trace_light_chunk, merge_light_chunk);
    g->light_vertices = p->light_sums.vertices / (double)p->n_paths;
    g->mean = p->light_sums.E / (double)p->n_paths;
    g->useful = p->light_sums.square > 0
                    ? p->light_sums.I * p->light_sums.I / (p->light_sums.square * p->light_sums.vertices)
                    : 1;
    for (int i = 0; p->wish->pairs && i < p->light.n; i++)
        g->vertices[i] /= (double)p->n_paths;
}

/* Each round looks for light with what the rounds before have learnt; what was learnt is put to use between rounds
 * only, while no thread reads it. Regions are found before pairs are tried: in the first round and by light sub-paths.
 */
static void learn_in_rounds(struct prepass *p)
{
    const struct prepass_wish *wish = p->wish;
    for (p->round = 0; p->round < ROUNDS; p->round++) {
        p->first_path = wish->n_eye * p->round / ROUNDS;
        p->n_paths = wish->n_eye * (p->round + 1) / ROUNDS;
        run_chunks(p, trace_eye_chunk, merge_chunk);
        regions_copy(&p->learnt->eye, &p->eye);
        regions_copy(&p->learnt->light, &p->light);
        if (wish->guide) {
            bool last = p->round + 1 == ROUNDS;
            guide_build(&p->learnt->guide, &p->lights, &p->eye, &p->job->scene->lights,
                        last ? GUIDE_DELTA : LEARN_DELTA);
            p->learnt->guided = true;
        }
        if (wish->pairs && p->round == 0) {
            trace_light(p);
            regions_copy(&p->learnt->light, &p->light);
            pair_lessons_init(&p->pairs, &p->eye, &p->light);
        }
    }
}

void prepass_run(const struct render_job *job, const struct prepass_wish *wish, struct importance *importance,
                 struct learnt *learnt)
{
    struct prepass p = {.job = job, .wish = wish, .importance = importance, .learnt = learnt};
    const struct light_set *lights = &job->scene->lights;
    regions_init(&p.eye, lights->center, lights->radius, wish->eye_cells, wish->levels, MAX_EYE_REGIONS);
    regions_init(&p.light, lights->center, lights->radius, wish->light_cells, wish->levels,
                 wish->pairs ? MAX_PAIR_REGIONS : 1 << 22);
    regions_copy(&learnt->eye, &p.eye);
    regions_copy(&learnt->light, &p.light);
    p.counts.direct[0] = p.counts.direct[1] = 1;
    p.counts.learnt = learnt;
    p.work = workspaces_new(job->n_threads, job->max_depth);
    make_stock(&p);
    if (wish->guide)
        guide_lessons_init(&p.lights, lights);
    if (wish->importance || wish->guide || wish->pairs)
        learn_in_rounds(&p);
    if (wish->pairs) {
        pairs_build(&learnt->pairs, &p.pairs, &p.eye, &p.light, importance->vertices, wish->delta);
        learnt->paired = true;
        pair_lessons_free(&p.pairs);
    } else if (wish->importance || wish->light_vertices) {
        trace_light(&p);
    }
    guide_lessons_free(&p.lights);
    regions_free(&p.eye);
    regions_free(&p.light);
    free_stock(&p);
    workspaces_free(p.work, job->n_threads);
}
