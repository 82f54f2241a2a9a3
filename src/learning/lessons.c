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

static void trace_chunk(void *context, int64_t job, int slot, int thread)
{
    struct learning *l = context;
    struct workspace *work = &l->work[thread];
    long first = l->first + (long)job * CHUNK, end = first + CHUNK < l->end ? first + CHUNK : l->end;
    l->list[slot].n = 0;
    for (long i = first; i < end && job_cancelled(l->job) == CANCEL_NOT; i++) {
        arena_reset(&work->arena);
        l->trace(l, work, i, &l->list[slot]);
    }
}

static bool take_chunk(void *context, int64_t job, int slot)
{
    struct learning *l = context;
    (void)job;
    for (size_t i = 0; i < l->list[slot].n; i++)
        l->take(l, &l->list[slot].item[i]);
    l->traced += CHUNK;
    job_progress(l->job, fmin(l->traced / l->budget, 1), 0);
    return job_cancelled(l->job) == CANCEL_NOT;
}

void lessons_learn(struct learning *l, void (*trace)(struct learning *, struct workspace *, long, struct lessons *),
                   const struct tables *known, long first, long end)
{
    int n_threads = l->job->n_threads, n_slots = 4 * n_threads;
    end = l->job->scene->lights.n > 0 ? end : first; /* without lights there is nothing to learn */
    struct parallel_jobs jobs = {(end - first + CHUNK - 1) / CHUNK, n_threads, n_slots, l, trace_chunk, take_chunk,
                                 NULL};
    l->trace = trace;
    l->counts = (struct counts){.s1 = {1, 1}, .tables = known};
    l->first = first;
    l->end = end;
    l->list = mem_alloc((size_t)n_slots, sizeof *l->list);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots; i++)
        free(l->list[i].item);
    free(l->list);
}
