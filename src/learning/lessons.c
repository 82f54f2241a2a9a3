/* lessons.c: see lessons.h. */
#include "learning/lessons.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"

void findings_add(struct findings *list, struct finding f)
{
    bool nothing = f.kind != TRIAL && !(f.x > 1e-290); /* sums of them, and their shares of sums, stay finite */
    if (nothing || !(f.x >= 0) || !fits_float(f.x))
        return;
    list->item = mem_grow(list->item, &list->capacity, list->n + 1, sizeof *list->item);
    list->item[list->n++] = f;
}

/* A pass while it runs. */
struct run {
    const struct pass *pass;
    struct findings *found; /* [n_slots] */
};

static void trace_chunk(void *context, int64_t job, int slot, int thread)
{
    struct run *r = context;
    const struct pass *p = r->pass;
    long first = p->first + (long)job * CHUNK, end = first + CHUNK < p->end ? first + CHUNK : p->end;
    r->found[slot].n = 0;
    if (p->begin != NULL)
        p->begin(p->context, p->lessons, thread, first);
    for (long i = first; i < end; i++) {
        arena_reset(&p->lessons->work[thread].arena);
        p->trace(p->context, p->lessons, thread, i, &r->found[slot]);
    }
}

static bool take_chunk(void *context, int64_t job, int slot)
{
    struct run *r = context;
    struct lessons *l = r->pass->lessons;
    (void)job;
    for (size_t i = 0; i < r->found[slot].n; i++)
        r->pass->take(r->pass->context, l, &r->found[slot].item[i]);
    l->traced += CHUNK;
    l->stopped = l->job->watch != NULL && !l->job->watch(l->job->watch_context, (double)l->traced);
    return !l->stopped;
}

void pass_run(const struct pass *p)
{
    struct run r = {.pass = p};
    int n_threads = p->lessons->job->n_threads, n_slots = 4 * n_threads;
    struct parallel_jobs jobs = {(p->end - p->first + CHUNK - 1) / CHUNK, n_threads, n_slots, &r, trace_chunk,
                                 take_chunk, NULL};
    if (p->lessons->stopped)
        return;
    r.found = mem_alloc((size_t)n_slots, sizeof *r.found);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots; i++)
        free(r.found[i].item);
    free(r.found);
}

static struct walk walk_of(const struct lessons *l, struct arena *arena, long i, enum stream stream,
                           struct sampler *sampler)
{
    struct walk w = {l->job->scene, &l->counts, arena, sampler, l->job->rr_threshold};
    *sampler = sampler_start(l->job->seed, RNG_LEARN, (uint64_t)i, (uint64_t)stream);
    return w;
}

int lessons_eye(const struct lessons *l, int thread, long i, enum stream stream, struct sampler *sampler)
{
    struct workspace *work = &l->work[thread];
    struct pixel_rect film = l->job->film_rect;
    struct walk w = walk_of(l, &work->arena, i, stream, sampler);
    double u, v;
    sampler_r2(i, &u, &v);
    return path_eye(&w, film.x0 + u * rect_width(film), film.y0 + v * rect_height(film), work->eye,
                    l->job->max_depth + 1);
}

int lessons_light(const struct lessons *l, struct arena *arena, long i, enum stream stream, struct vertex *path)
{
    struct sampler sampler;
    struct walk w = walk_of(l, arena, i, stream, &sampler);
    return path_light(&w, path, l->job->max_depth + 1);
}
