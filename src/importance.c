/* importance.c: see importance.h. The pre-pass is cut into chunks of sub-paths; each chunk lists what it found, and the
 * lists are added up in order (parallel.h), so the sums are the same for any number of threads. */
#include "importance.h"

#include <stdlib.h>

#include "parallel.h"

enum {
    CHUNK = 512,              /* sub-paths per chunk */
    EYE_PER_PIXEL = 4,        /* eye sub-paths, at most MAX_EYE of them */
    MAX_EYE = 256 * 1024,
    MAX_LIGHT = 32 * 1024     /* light sub-paths for `mean` */
};

/* --- the hash table ---------------------------------------------------------------------------------- */

static uint64_t cell_key(const struct importance *g, vec3 p)
{
    vec3 c = mul(sub(p, g->origin), g->per_metre);
    const double top = 2097151; /* 21 bits per axis; points beyond the bounds share the border cells */
    return ((uint64_t)clamp(c.x, 0, top) << 42 | (uint64_t)clamp(c.y, 0, top) << 21 | (uint64_t)clamp(c.z, 0, top)) + 1;
}

static struct importance_cell *find(const struct importance *g, uint64_t key)
{
    size_t mask = g->n_slots - 1, i = (size_t)hash_mix(key) & mask;
    while (g->slot[i].key != 0 && g->slot[i].key != key)
        i = (i + 1) & mask;
    return &g->slot[i];
}

static void grow(struct importance *g)
{
    struct importance old = *g;
    g->n_slots = old.n_slots == 0 ? 1024 : 2 * old.n_slots;
    g->slot = mem_alloc(g->n_slots, sizeof *g->slot);
    for (size_t i = 0; i < old.n_slots; i++)
        if (old.slot[i].key != 0)
            *find(g, old.slot[i].key) = old.slot[i];
    free(old.slot);
}

static void deposit(struct importance *g, uint64_t key, double value)
{
    if (2 * g->n_used >= g->n_slots)
        grow(g);
    struct importance_cell *cell = find(g, key);
    if (cell->key == 0) {
        cell->key = key;
        g->n_used++;
    }
    cell->E += value;
}

double importance_at(const struct importance *g, vec3 p)
{
    return g->n_slots == 0 ? 0 : find(g, cell_key(g, p))->E;
}

double importance_of_path(const struct importance *g, const struct vertex *light, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        if (vertex_connectible(&light[i]))
            sum += rgb_luminance(light[i].beta) * importance_at(g, light[i].p);
    return sum;
}

void importance_free(struct importance *g)
{
    free(g->slot);
    g->slot = NULL;
    g->n_slots = g->n_used = 0;
}

/* --- the pre-pass ------------------------------------------------------------------------------------ */

struct found {
    uint64_t key;
    double value;
};

struct chunk {
    struct found *found; /* [n], eye chunks; owned */
    size_t n, capacity;
    double sum; /* light chunks */
};

struct prepass {
    struct importance *grid;
    const struct render_job *job;
    struct mis_counts counts; /* weights are not used here: all zero but `direct`, to keep divisions sane */
    struct workspace *work;   /* [n_threads] */
    struct chunk *chunk;      /* [n_slots] */
    long n_paths;
    double light_sum;
};

/* Sub-path number i goes through a point of the film of the golden-ratio sequence R2, which fills it evenly. */
static void trace_eye_chunk(void *context, long job, int slot, int thread)
{
    struct prepass *p = context;
    struct chunk *c = &p->chunk[slot];
    struct workspace *work = &p->work[thread];
    struct pixel_rect film = p->job->film_rect;
    c->n = 0;
    for (long i = job * CHUNK; i < (job + 1) * CHUNK && i < p->n_paths; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, 0);
        struct walk w = {p->job->scene, &p->counts, &work->arena, &sampler};
        double u = 0.5 + 0.7548776662466927 * (double)i, v = 0.5 + 0.5698402909980532 * (double)i;
        double px = film.x0 + (u - floor(u)) * rect_width(film), py = film.y0 + (v - floor(v)) * rect_height(film);
        int n = path_eye(&w, px, py, work->eye, p->job->max_depth + 1);
        for (int k = 1; k < n; k++) {
            const struct vertex *z = &work->eye[k];
            if (z->kind != VERTEX_SURFACE || !vertex_connectible(z))
                continue;
            c->found = mem_grow(c->found, &c->capacity, c->n + 1, sizeof *c->found);
            c->found[c->n].key = cell_key(p->grid, z->p);
            c->found[c->n++].value = rgb_luminance(z->beta);
        }
    }
}

static bool merge_eye_chunk(void *context, long job, int slot)
{
    (void)job;
    struct prepass *p = context;
    for (size_t i = 0; i < p->chunk[slot].n; i++)
        deposit(p->grid, p->chunk[slot].found[i].key, p->chunk[slot].found[i].value);
    return true;
}

static void trace_light_chunk(void *context, long job, int slot, int thread)
{
    struct prepass *p = context;
    struct workspace *work = &p->work[thread];
    p->chunk[slot].sum = 0;
    for (long i = job * CHUNK; i < (job + 1) * CHUNK && i < p->n_paths; i++) {
        arena_reset(&work->arena);
        struct sampler sampler = sampler_start(p->job->seed, RNG_PREPASS, (uint64_t)i, 1);
        struct walk w = {p->job->scene, &p->counts, &work->arena, &sampler};
        int n = path_light(&w, work->light, p->job->max_depth + 1);
        for (int k = 1; k < n; k++)
            if (vertex_connectible(&work->light[k]))
                p->chunk[slot].sum += importance_at(p->grid, work->light[k].p);
    }
}

static bool merge_light_chunk(void *context, long job, int slot)
{
    (void)job;
    struct prepass *p = context;
    p->light_sum += p->chunk[slot].sum;
    return true;
}

void importance_build(struct importance *g, const struct render_job *job, int cells)
{
    const struct light_set *lights = &job->scene->lights; /* they know the scene's bounding sphere */
    g->slot = NULL;
    g->n_slots = g->n_used = 0;
    g->per_metre = cells / (2 * lights->radius);
    double r = lights->radius;
    g->origin = sub(lights->center, vec(r, r, r));

    struct prepass p = {.grid = g, .job = job, .counts = {.hit = 1, .direct = 1, .connect = 1, .splat = 1}};
    struct parallel_jobs jobs = {0, job->n_threads, 4 * job->n_threads, &p, trace_eye_chunk, merge_eye_chunk};
    p.work = mem_alloc((size_t)job->n_threads, sizeof *p.work);
    for (int i = 0; i < job->n_threads; i++) {
        p.work[i].eye = mem_alloc((size_t)job->max_depth + 2, sizeof *p.work[i].eye);
        p.work[i].light = mem_alloc((size_t)job->max_depth + 2, sizeof *p.work[i].light);
    }
    p.chunk = mem_alloc((size_t)jobs.n_slots, sizeof *p.chunk);

    long pixels = (long)rect_width(job->film_rect) * rect_height(job->film_rect);
    p.n_paths = pixels * EYE_PER_PIXEL < MAX_EYE ? pixels * EYE_PER_PIXEL : MAX_EYE;
    jobs.n_jobs = (p.n_paths + CHUNK - 1) / CHUNK;
    parallel_run(&jobs);

    p.n_paths = p.n_paths < MAX_LIGHT ? p.n_paths : MAX_LIGHT;
    jobs.n_jobs = (p.n_paths + CHUNK - 1) / CHUNK;
    jobs.work = trace_light_chunk;
    jobs.commit = merge_light_chunk;
    parallel_run(&jobs);
    g->mean = p.light_sum / (double)p.n_paths;

    for (int i = 0; i < jobs.n_slots; i++)
        free(p.chunk[i].found);
    free(p.chunk);
    for (int i = 0; i < job->n_threads; i++) {
        arena_free(&p.work[i].arena);
        free(p.work[i].eye);
        free(p.work[i].light);
    }
    free(p.work);
}
