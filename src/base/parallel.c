/* parallel.c: see parallel.h. */

#include "base/parallel.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"

struct job_queue {
    const struct parallel_jobs *jobs;
    struct os_lock *lock; /* woken when `committed` or `stopped` changes */
    int64_t next;         /* first job not started */
    int64_t committed;    /* jobs committed; next - committed <= n_slots are under way, done, or being committed */
    bool committing;      /* somebody commits, without the lock */
    bool stopped;
    bool *done; /* [n_slots]: the job in this slot is finished */
};

/* Commit every finished job whose turn it is, unless somebody else does; then they see to ours as well. The lock is
 * held, but not during the commits: others take jobs meanwhile. */
static void commit_ready(struct job_queue *q)
{
    const struct parallel_jobs *jobs = q->jobs;
    if (q->committing)
        return;
    q->committing = true;
    while (!q->stopped && q->committed < q->next && q->done[q->committed % jobs->n_slots]) {
        int64_t job = q->committed;
        int slot = (int)(job % jobs->n_slots);
        os_lock_leave(q->lock);
        bool go_on = jobs->commit(jobs->context, job, slot);
        os_lock_take(q->lock);
        q->done[slot] = false;
        q->stopped = !go_on;
        q->committed++;
        os_lock_wake_all(q->lock);
    }
    q->committing = false;
}

static void run_worker(void *queue, int thread)
{
    struct job_queue *q = queue;
    const struct parallel_jobs *jobs = q->jobs;
    os_lock_take(q->lock);
    while (!q->stopped && q->next < jobs->n_jobs) {
        if (q->next - q->committed >= jobs->n_slots) { /* every slot is taken: wait for a commit */
            os_lock_wait(q->lock);
            continue;
        }
        int64_t job = q->next++;
        int slot = (int)(job % jobs->n_slots);
        os_lock_leave(q->lock);
        jobs->work(jobs->context, job, slot, thread);
        os_lock_take(q->lock);
        q->done[slot] = true;
        commit_ready(q);
    }
    os_lock_leave(q->lock);
}

bool parallel_await(const struct parallel_jobs *jobs, int64_t job)
{
    struct job_queue *q = jobs->queue;
    os_lock_take(q->lock);
    while (!q->stopped && q->committed < job)
        os_lock_wait(q->lock);
    bool go_on = !q->stopped;
    os_lock_leave(q->lock);
    return go_on;
}

int64_t parallel_run(struct parallel_jobs *jobs)
{
    struct job_queue q = {.jobs = jobs};
    jobs->queue = &q;
    q.done = mem_alloc((size_t)jobs->n_slots, sizeof *q.done);
    q.lock = os_lock_new();
    os_run_threads(jobs->n_threads, run_worker, &q);
    os_lock_free(q.lock);
    free(q.done);
    return q.committed;
}
