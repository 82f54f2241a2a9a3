/* parallel.c: see parallel.h. */
#define _POSIX_C_SOURCE 200809L

#include "base/parallel.h"

#include <pthread.h>
#include <unistd.h>

#include "base/mem.h"

#include <stdlib.h>

struct pool {
    const struct parallel_jobs *jobs;
    pthread_mutex_t lock;
    pthread_cond_t moved; /* `committed` or `stopped` changed */
    long next;            /* first job not started */
    long committed;       /* jobs committed; those below next - committed <= n_slots are under way or waiting */
    bool stopped;
    bool *done; /* [n_slots]: the job in this slot is finished */
};

struct worker {
    struct pool *pool;
    int thread;
};

/* Commit every finished job whose turn it is. The lock is held. */
static void commit_ready(struct pool *p)
{
    int n_slots = p->jobs->n_slots;
    while (!p->stopped && p->committed < p->next && p->done[p->committed % n_slots]) {
        int slot = (int)(p->committed % n_slots);
        p->done[slot] = false;
        if (!p->jobs->commit(p->jobs->context, p->committed, slot))
            p->stopped = true;
        p->committed++;
    }
    pthread_cond_broadcast(&p->moved);
}

static void *run_worker(void *argument)
{
    const struct worker *w = argument;
    struct pool *p = w->pool;
    const struct parallel_jobs *jobs = p->jobs;
    pthread_mutex_lock(&p->lock);
    while (!p->stopped && p->next < jobs->n_jobs) {
        if (p->next - p->committed >= jobs->n_slots) { /* every slot is taken: wait for a commit */
            pthread_cond_wait(&p->moved, &p->lock);
            continue;
        }
        long job = p->next++;
        int slot = (int)(job % jobs->n_slots);
        pthread_mutex_unlock(&p->lock);
        jobs->work(jobs->context, job, slot, w->thread);
        pthread_mutex_lock(&p->lock);
        p->done[slot] = true;
        commit_ready(p);
    }
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

long parallel_run(const struct parallel_jobs *jobs)
{
    struct pool p = {.jobs = jobs};
    p.done = mem_alloc((size_t)jobs->n_slots, sizeof *p.done);
    pthread_mutex_init(&p.lock, NULL);
    pthread_cond_init(&p.moved, NULL);

    int extra = jobs->n_threads - 1;
    pthread_t *thread = mem_alloc((size_t)extra, sizeof *thread);
    struct worker *worker = mem_alloc((size_t)jobs->n_threads, sizeof *worker);
    int started = 0;
    for (; started < extra; started++) {
        worker[started + 1].pool = &p;
        worker[started + 1].thread = started + 1;
        if (pthread_create(&thread[started], NULL, run_worker, &worker[started + 1]) != 0)
            break;
    }
    worker[0].pool = &p;
    run_worker(&worker[0]);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);

    free(worker);
    free(thread);
    pthread_cond_destroy(&p.moved);
    pthread_mutex_destroy(&p.lock);
    free(p.done);
    return p.committed;
}

int parallel_cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}
