/* parallel.h: run numbered jobs on several threads and take in their results in order.
 *
 * Jobs start in order on whichever thread is free and end in any order; results are committed strictly in the order
 * of their numbers, one at a time. What a commit does therefore cannot depend on the number of threads: this is
 * where the promise "same bytes for any -j" is kept. A result waits for its turn in one of a fixed number of slots,
 * so memory stays bounded; a thread that finds none free waits too. doc/cluster/README.md says how long, by simulation.
 * Tests: test_threads.c. */
#ifndef ASBDPT_PARALLEL_H
#define ASBDPT_PARALLEL_H

#include <stdbool.h>
#include <stdint.h>

/* Slots for jobs that may differ much in length: a job as long as fifteen others holds nobody up. */
enum { SLOTS_PER_THREAD = 16 };

struct job_queue;

struct parallel_jobs {
    int64_t n_jobs;
    int n_threads; /* >= 1; the calling thread is one of them */
    int n_slots;   /* results that may wait; >= n_threads */
    void *context; /* passed to both functions */
    /* Do job number `job` on thread number `thread` (0 .. n_threads-1), leaving the result in slot `slot`. */
    void (*work)(void *context, int64_t job, int slot, int thread);
    /* Take in the result of `job` from `slot`, while other threads work on. Calls never overlap: their time is what
     * many threads share, so keep it short. Returns false to stop: no later job is committed and none that has not
     * started yet is begun. */
    bool (*commit)(void *context, int64_t job, int slot);
    struct job_queue *queue; /* set by parallel_run */
};

/* parallel_run: run all jobs. Returns the number of jobs committed (n_jobs unless a commit said stop). If threads
 * cannot be created it goes on with those it has.
 * parallel_await: for a job under way whose result has grown too large to wait in its slot. Returns when all jobs
 * before it are committed: nobody commits before it does, so it may take in what it has. False if a commit has said
 * stop and nothing of this job is wanted. */
int64_t parallel_run(struct parallel_jobs *jobs);
bool parallel_await(const struct parallel_jobs *jobs, int64_t job);

#endif
