/* pairs_pass.c: the pass that makes trial connections between regions (pairs.h); see training.h.
 *
 * An eye vertex is connected to a few vertices of a pool of light sub-paths. They are drawn in proportion to the
 * importance of their places (importance.h) and luminance(beta).
 */
#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"
#include "learning/training.h"
#include "transport/connect.h"

enum {
    POOL = 64, /* number of light sub-paths of a chunk */
    TRIALS = 4 /* number of trial connections of each eye vertex */
};

/* A light vertex that trials may draw. */
struct end {
    const struct vertex *y;
    double L, useful; /* luminance(beta); (1 - delta) E / mean + delta, see importance.h */
};

/* The light vertices of a chunk, from which its trials draw. */
struct trial_pool {
    struct arena arena; /* of all that follows */
    struct vertex *vertex;
    struct end *end;
    double *before; /* [n], sum of L times `useful` over the ends before it */
    int n;
    double total;
};

struct pairs_pass {
    struct trial_pool *pool; /* [n_threads], owned */
    struct regions eye, light;
    struct pair_sums sums;
    double delta;
};

static void add_end(const struct pass *p, struct trial_pool *pool, const struct vertex *y)
{
    const struct importance *importance = &p->counts.tables->importance;
    double L = rgb_luminance(y->beta), E = importance_in(importance, y->light_region);
    double delta = ((const struct pairs_pass *)p->context)->delta;
    double useful = (1 - delta) * (importance->mean > 0 ? E / importance->mean : 0) + delta;
    if (!vertex_connectible(y) || !(L * useful > 1e-290 && L * useful < 1e100))
        return;
    struct end end = {y, L, useful};
    pool->before[pool->n] = pool->total;
    pool->end[pool->n++] = end;
    pool->total += L * useful;
}

/* Trace the light sub-paths of a chunk. `chunk` is the number of its first eye sub-path, which no other chunk has. */
static void fill_pool(const struct pass *p, struct trial_pool *pool, long chunk)
{
    size_t most = POOL * ((size_t)p->training->job->max_depth + 1);
    int longest = p->training->job->max_depth + 1;
    double asked = 0;
    arena_reset(&pool->arena);
    pool->vertex = arena_alloc(&pool->arena, most * sizeof *pool->vertex);
    pool->end = arena_alloc(&pool->arena, most * sizeof *pool->end);
    pool->before = arena_alloc(&pool->arena, most * sizeof *pool->before);
    pool->n = 0;
    pool->total = 0;
    for (long k = 0; k < POOL && patience_lasts(&p->training->patience, &asked); k++) {
        struct vertex *path = &pool->vertex[k * longest];
        int n = pass_light(p, &pool->arena, chunk * POOL + k, STREAM_POOL, path);
        for (int i = 1; i < n; i++)
            add_end(p, pool, &path[i]);
    }
}

/* Connect z to a few light vertices. */
static void try_vertex(const struct pass *p, const struct trial_pool *pool, const struct vertex *z,
                       struct sampler *sampler, struct findings *out)
{
    const struct tables *tables = p->counts.tables;
    double beta = rgb_luminance(z->beta);
    for (int i = 0; i < TRIALS && pool->n > 0 && beta > 0; i++) {
        double u = (i + sampler_number(sampler, DRAW_LIGHT_END)) / TRIALS;
        const struct end *end = &pool->end[cumulative_find(pool->before, pool->n, u * pool->total)];
        const struct vertex *y = end->y;
        struct connection found = connect_pair(p->training->job->scene, &p->counts, y, z);
        struct finding f = {.kind = TRIAL, .w = beta / end->useful};
        f.eye = regions_key(&tables->eye, z->p, vertex_side(z));
        f.light = regions_key(&tables->light, y->p, vertex_side(y));
        f.x = rgb_luminance(found.value) / (beta * end->L);
        findings_add(out, f);
    }
}

static void trace(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct pairs_pass *t = p->context;
    const struct vertex *eye = p->training->work[thread].eye;
    struct sampler sampler;
    if ((i - p->first) % CHUNK == 0)
        fill_pool(p, &t->pool[thread], i);
    int n = pass_eye(p, thread, i, STREAM_EYE, &sampler);
    for (int k = 1; k < n; k++)
        if (vertex_connectible(&eye[k]))
            try_vertex(p, &t->pool[thread], &eye[k], &sampler, out);
}

static void take(void *context, const struct finding *f)
{
    struct pairs_pass *t = context;
    int e = regions_find(&t->eye, f->eye), y = regions_find(&t->light, f->light);
    pair_sums_add(&t->sums, &t->eye, &t->light, e, y, f->x, f->w);
}

struct tables train_pairs(struct training *t, struct tables known, long first, long n, double delta)
{
    struct pairs_pass p = {mem_alloc((size_t)t->job->n_threads, sizeof *p.pool), known.eye, known.light, {0}, delta};
    struct pass pass = {t, any_counts(&known), first, first + n, &p, trace, take};
    pair_sums_init(&p.sums, &known.eye, &known.light);
    pass_run(&pass);
    for (int i = 0; i < t->job->n_threads; i++)
        arena_free(&p.pool[i].arena);
    free(p.pool);
    known.pairs = pairs_build(&p.sums, &known.eye, &known.light, known.importance.vertices, delta);
    return known;
}
