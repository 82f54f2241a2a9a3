/* lessons.c: see lessons.h. */
#include "learning/lessons.h"

#include <math.h>
#include <stdlib.h>

#include "base/parallel.h"

void lessons_add(struct lessons *list, struct lesson lesson)
{
    const double least = 1e-290, most = 1e100; /* sums, products of three and shares of sums stay finite */
    if (!(lesson.w > least && lesson.w < most && lesson.x >= 0 && lesson.x < most))
        return;
    list->item = mem_grow(list->item, &list->capacity, list->n + 1, sizeof *list->item);
    list->item[list->n++] = lesson;
}

/* A pass under way. */
struct run {
    struct learning *learning;
    const struct pass *pass;
    struct counts counts; /* of any values, since no weight is used */
    long first, end;
    struct lessons *list; /* [n_slots] */
};

static void trace_chunk(void *context, int64_t job, int slot, int thread)
{
    struct run *r = context;
    struct workspace *work = &r->learning->work[thread];
    long first = r->first + (long)job * CHUNK, end = first + CHUNK < r->end ? first + CHUNK : r->end;
    r->list[slot].n = 0;
    for (long i = first; i < end && job_cancelled(r->learning->job) == CANCEL_NOT; i++) {
        arena_reset(&work->arena);
        r->pass->trace(r->learning, &r->counts, work, i, &r->list[slot]);
    }
}

static bool take_chunk(void *context, int64_t job, int slot)
{
    struct run *r = context;
    struct learning *l = r->learning;
    (void)job;
    for (size_t i = 0; i < r->list[slot].n; i++)
        r->pass->take(l, &r->list[slot].item[i]);
    l->traced += CHUNK;
    job_progress(l->job, fmin(l->traced / l->budget, 1), 0);
    return job_cancelled(l->job) == CANCEL_NOT;
}

void lessons_learn(struct learning *l, const struct pass *pass, long first, long end)
{
    int n_threads = l->job->n_threads, n_slots = 4 * n_threads;
    end = l->job->scene->lights.n > 0 ? end : first; /* without lights there is nothing to learn */
    struct run r = {l, pass, {.direct = {1, 1}, .tables = &pass->known}, first, end, NULL};
    struct parallel_jobs jobs = {(end - first + CHUNK - 1) / CHUNK, n_threads, n_slots, &r, trace_chunk, take_chunk,
                                 NULL};
    r.list = mem_alloc((size_t)n_slots, sizeof *r.list);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots; i++)
        free(r.list[i].item);
    free(r.list);
}
