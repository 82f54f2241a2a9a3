/* training.c: see training.h. */
#include "learning/training.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"

void findings_add(struct findings *list, struct finding f)
{
    bool nothing = f.kind != TRIAL && !(f.x > 1e-290); /* sums, products of three and shares of sums stay finite */
    if (nothing || !(f.x >= 0 && f.x < 1e100))
        return;
    list->item = mem_grow(list->item, &list->capacity, list->n + 1, sizeof *list->item);
    list->item[list->n++] = f;
}

/* A running pass. */
struct run {
    const struct pass *pass;
    struct findings *found; /* [n_slots] */
};

static void trace_chunk(void *context, int64_t job, int slot, int thread)
{
    struct run *r = context;
    const struct pass *p = r->pass;
    double asked = 0;
    long first = p->first + (long)job * CHUNK, end = first + CHUNK < p->end ? first + CHUNK : p->end;
    r->found[slot].n = 0;
    for (long i = first; i < end && patience_lasts(&p->training->patience, &asked); i++) {
        arena_reset(&p->training->work[thread].arena);
        p->trace(p, thread, i, &r->found[slot]);
    }
}

static bool take_chunk(void *context, int64_t job, int slot)
{
    struct run *r = context;
    (void)job;
    for (size_t i = 0; i < r->found[slot].n; i++)
        r->pass->take(r->pass->context, &r->found[slot].item[i]);
    return patience_count(&r->pass->training->patience, CHUNK);
}

void pass_run(const struct pass *p)
{
    struct run r = {.pass = p};
    int n_threads = p->training->job->n_threads, n_slots = 4 * n_threads;
    struct parallel_jobs jobs = {(p->end - p->first + CHUNK - 1) / CHUNK, n_threads, n_slots, &r, trace_chunk,
                                 take_chunk, NULL};
    r.found = mem_alloc((size_t)n_slots, sizeof *r.found);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots; i++)
        free(r.found[i].item);
    free(r.found);
}

int pass_eye(const struct pass *p, int thread, long i, enum stream stream, struct sampler *sampler)
{
    const struct render_job *job = p->training->job;
    struct workspace *work = &p->training->work[thread];
    const struct walk w = {job->scene, &p->counts, &work->arena, sampler, job->rr_threshold};
    double u, v;
    *sampler = sampler_start(job->seed, RNG_LEARN, (uint64_t)i, (uint64_t)stream);
    sampler_r2(i, &u, &v);
    return path_eye(&w, job->film_rect.x0 + u * rect_width(job->film_rect),
                    job->film_rect.y0 + v * rect_height(job->film_rect), work->eye, job->max_depth + 1);
}

int pass_light(const struct pass *p, struct arena *arena, long i, enum stream stream, struct vertex *path)
{
    const struct render_job *job = p->training->job;
    struct sampler sampler = sampler_start(job->seed, RNG_LEARN, (uint64_t)i, (uint64_t)stream);
    const struct walk w = {job->scene, &p->counts, arena, &sampler, job->rr_threshold};
    return path_light(&w, path, job->max_depth + 1);
}
