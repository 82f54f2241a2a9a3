/* parallel.c: see parallel.h. */
#define _POSIX_C_SOURCE 200809L

#include "base/parallel.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/mem.h"

struct job_queue {
    const struct parallel_jobs *jobs;
    pthread_mutex_t lock;
    pthread_cond_t moved; /* `committed` or `stopped` changed */
    int64_t next;         /* first job not started */
    int64_t committed;    /* jobs committed; those below next - committed <= n_slots are under way or waiting */
    bool stopped;
    bool *done; /* [n_slots]: the job in this slot is finished */
};

struct worker {
    struct job_queue *queue;
    int thread;
};

/* Commit every finished job whose turn it is. The lock is held. */
static void commit_ready(struct job_queue *q)
{
    int n_slots = q->jobs->n_slots;
    while (!q->stopped && q->committed < q->next && q->done[q->committed % n_slots]) {
        int slot = (int)(q->committed % n_slots);
        q->done[slot] = false;
        if (!q->jobs->commit(q->jobs->context, q->committed, slot))
            q->stopped = true;
        q->committed++;
    }
    pthread_cond_broadcast(&q->moved);
}

static void *run_worker(void *argument)
{
    const struct worker *w = argument;
    struct job_queue *q = w->queue;
    const struct parallel_jobs *jobs = q->jobs;
    pthread_mutex_lock(&q->lock);
    while (!q->stopped && q->next < jobs->n_jobs) {
        if (q->next - q->committed >= jobs->n_slots) { /* every slot is taken: wait for a commit */
            pthread_cond_wait(&q->moved, &q->lock);
            continue;
        }
        int64_t job = q->next++;
        int slot = (int)(job % jobs->n_slots);
        pthread_mutex_unlock(&q->lock);
        jobs->work(jobs->context, job, slot, w->thread);
        pthread_mutex_lock(&q->lock);
        q->done[slot] = true;
        commit_ready(q);
    }
    pthread_mutex_unlock(&q->lock);
    return NULL;
}

int64_t parallel_run(const struct parallel_jobs *jobs)
{
    struct job_queue q = {.jobs = jobs};
    q.done = mem_alloc((size_t)jobs->n_slots, sizeof *q.done);
    pthread_mutex_init(&q.lock, NULL);
    pthread_cond_init(&q.moved, NULL);

    int extra = jobs->n_threads - 1;
    pthread_t *thread = mem_alloc((size_t)extra, sizeof *thread);
    struct worker *worker = mem_alloc((size_t)jobs->n_threads, sizeof *worker);
    int started = 0;
    for (; started < extra; started++) {
        worker[started + 1].queue = &q;
        worker[started + 1].thread = started + 1;
        if (pthread_create(&thread[started], NULL, run_worker, &worker[started + 1]) != 0)
            break;
    }
    worker[0].queue = &q;
    run_worker(&worker[0]);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);

    free(worker);
    free(thread);
    pthread_cond_destroy(&q.moved);
    pthread_mutex_destroy(&q.lock);
    free(q.done);
    return q.committed;
}

int parallel_cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}
