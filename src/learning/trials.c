/* trials.c: the pass that tries connections between regions (pairs.h); see lessons.h.
 *
 * An eye vertex is connected to a few vertices of a stock of light sub-paths, drawn by how much the camera can use
 * where they are.
 */
#include <stdlib.h>

#include "base/cumulative.h"
#include "base/number.h"
#include "learning/lessons.h"
#include "transport/connect.h"

enum {
    STOCK = 64, /* light sub-paths of a chunk */
    TRIALS = 4  /* connections tried from each eye vertex */
};

/* A light vertex that trials may choose. */
struct choosable {
    const struct vertex *y;
    double L, useful; /* luminance(beta); (1 - delta) E / mean + delta, see importance.h */
};

/* Memory of one thread for the light sub-paths of a chunk. */
struct stock {
    struct arena arena;
    struct vertex *vertex;      /* STOCK times max_depth + 1 of them; owned */
    struct choosable *item;     /* [n], owned */
    double *before;             /* [n] sum of L useful of the items before it; owned */
    int n;
    double total;
};

struct trials {
    struct stock *stock; /* [n_threads], owned */
    struct pair_lessons lessons;
};

static void add_choosable(const struct lessons *l, struct stock *s, const struct vertex *y)
{
    const struct importance *importance = &l->learnt->importance;
    double L = rgb_luminance(y->beta), E = importance_in(importance, y->light_region), delta = l->wish->delta;
    double useful = (1 - delta) * (importance->mean > 0 ? E / importance->mean : 0) + delta;
    if (!vertex_connectible(y) || !(L * useful > 1e-290) || !fits_float(L * useful))
        return;
    struct choosable c = {y, L, useful};
    s->before[s->n] = s->total;
    s->item[s->n++] = c;
    s->total += L * useful;
}

/* The light sub-paths of the chunk whose first eye sub-path is number `chunk`: a name no other chunk has. */
static void fill_stock(void *context, struct lessons *l, int thread, long chunk)
{
    struct trials *t = context;
    struct stock *s = &t->stock[thread];
    int longest = l->job->max_depth + 1;
    arena_reset(&s->arena);
    s->n = 0;
    s->total = 0;
    for (long k = 0; k < STOCK; k++) {
        struct vertex *path = &s->vertex[k * longest];
        int n = lessons_light(l, &s->arena, chunk * STOCK + k, STREAM_POOL, path);
        for (int i = 1; i < n; i++)
            add_choosable(l, s, &path[i]);
    }
}

/* Connect z to a few light vertices. The worth of a pair falls as 1/d^2, so that near ones would hide all others: the
 * square of a quarter of a region's width is added to that d^2. */
static void try_vertex(const struct lessons *l, const struct stock *s, const struct vertex *z, struct sampler *sampler,
                       struct findings *out)
{
    double near2 = sqr(0.25 / l->learnt->eye.per_metre), beta = rgb_luminance(z->beta);
    for (int i = 0; i < TRIALS && s->n > 0 && beta > 0; i++) {
        double u = (i + sampler_number(sampler, DRAW_LIGHT_END)) / TRIALS;
        const struct choosable *c = &s->item[cumulative_find(s->before, s->n, u * s->total)];
        const struct vertex *y = c->y;
        struct connection found = connect_pair(l->job->scene, &l->counts, y, z);
        double d2 = length2(sub(y->p, z->p));
        struct finding f = {.kind = TRIAL, .p = z->p, .p_side = vertex_side(z), .y = y->p, .y_side = vertex_side(y)};
        f.w = beta / c->useful;
        f.x = rgb_luminance(found.value) / (beta * c->L) * (d2 > 0 ? d2 / (d2 + near2) : 0);
        findings_add(out, f);
    }
}

static void trace_trials(void *context, struct lessons *l, int thread, long i, struct findings *out)
{
    struct trials *t = context;
    struct sampler sampler;
    int n = lessons_eye(l, thread, i, STREAM_EYE, &sampler);
    for (int k = 1; k < n; k++)
        if (vertex_connectible(&l->work[thread].eye[k]))
            try_vertex(l, &t->stock[thread], &l->work[thread].eye[k], &sampler, out);
}

static void take_trial(void *context, struct lessons *l, const struct finding *f)
{
    struct trials *t = context;
    const struct regions *eye = &l->learnt->eye, *light = &l->learnt->light;
    pair_lessons_add(&t->lessons, eye, light, region_at(eye, f->p, f->p_side), region_at(light, f->y, f->y_side), f->x,
                     f->w);
}

void trials_run(struct lessons *l, long first, long n)
{
    struct learnt *learnt = l->learnt;
    struct trials t = {.stock = mem_alloc((size_t)l->job->n_threads, sizeof *t.stock)};
    size_t vertices = STOCK * ((size_t)l->job->max_depth + 1);
    struct pass pass = {l, first, first + n, &t, fill_stock, trace_trials, take_trial};
    for (struct stock *s = t.stock; s < t.stock + l->job->n_threads; s++) {
        s->vertex = mem_alloc(vertices, sizeof *s->vertex);
        s->item = mem_alloc(vertices, sizeof *s->item);
        s->before = mem_alloc(vertices, sizeof *s->before);
    }
    pair_lessons_init(&t.lessons, &learnt->eye, &learnt->light);
    pass_run(&pass);
    pairs_build(&learnt->pairs, &t.lessons, &learnt->eye, &learnt->light, learnt->importance.vertices,
                learnt->importance.n_vertices, l->wish->delta);
    learnt->paired = true;
    learnt_freeze(learnt);
    pair_lessons_free(&t.lessons);
    for (struct stock *s = t.stock; s < t.stock + l->job->n_threads; s++) {
        arena_free(&s->arena);
        free(s->vertex);
        free(s->item);
        free(s->before);
    }
    free(t.stock);
}
