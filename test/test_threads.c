/* test_threads.c: small renders by every method on four threads give what one thread gives; made for the thread
 * sanitizer (make tsan). Jobs of uneven length do not hold up others, and are committed in order. */
#define _POSIX_C_SOURCE 200809L

#include <string.h>
#include <time.h>

#include "base/os.h"
#include "base/parallel.h"
#include "helpers.h"
#include "tests.h"

/* Two parts by four threads are one render by one thread, with whatever is learnt; another seed is another picture. */
static void test_method(struct test *t, const struct scene *scene, const char *integrator, const char *what)
{
    const int middle = strstr(what, "bins") != NULL ? LONGEST_BLOCK : 4, end = middle + 2; /* of bins a block */
    struct film film[3];
    for (int i = 0; i < 3; i++) {
        struct render_options o = {.integrator = integrator, .n_threads = i == 0 ? 1 : 4, .max_depth = 4,
                                   .seed = test_seed(t) + (i == 2), .end = i == 1 ? middle : end, .planned = end,
                                   .block = 2};
        struct error err;
        bool ok;
        film_init(&film[i], render_crop(scene), scene->width, scene->height);
        while ((ok = render_scene(scene, &o, &film[i], &err)) && o.end < end) {
            o.first = o.end;
            o.end = end;
        }
        CHECK(t, ok, "%s", err.text);
    }
    CHECK(t, films_equal(&film[0], &film[1]), "%s: four threads, in two parts, see other than one", what);
    CHECK(t, !films_equal(&film[0], &film[2]), "%s: the seed has no effect", what);
    for (int i = 0; i < 3; i++)
        film_free(&film[i]);
}

/* ---- uneven jobs ---- */

enum { JOBS = 60 };

struct uneven {
    struct os_lock *lock;
    int expected;         /* jobs that job 0 waits for */
    double patience;      /* seconds */
    int finished;         /* jobs that have ended, */
    int while_first;      /* until job 0 did, */
    int while_committing; /* until job 1 was committed, which waits for one more than were begun until then */
    int64_t next, stop;   /* the job to be committed, that whose commit says stop */
    int overlapping;      /* commits */
    bool committing, in_order;
};

/* Wait until so many jobs have ended, which they never may. Returns how many have. */
static int wait_for(struct uneven *u, int finished)
{
    double end = os_wall_seconds() + u->patience;
    for (;;) {
        os_lock_take(u->lock);
        int now = u->finished;
        os_lock_leave(u->lock);
        if (now >= finished || os_wall_seconds() > end)
            return now;
        nanosleep(&(struct timespec){0, 1000000}, NULL);
    }
}

static void work_unevenly(void *context, int64_t job, int slot, int thread)
{
    struct uneven *u = context;
    (void)slot, (void)thread;
    if (job == 0)
        u->while_first = wait_for(u, u->expected);
    os_lock_take(u->lock);
    u->finished++;
    os_lock_leave(u->lock);
}

static bool commit_unevenly(void *context, int64_t job, int slot)
{
    struct uneven *u = context;
    (void)slot;
    u->overlapping += u->committing;
    u->committing = true;
    u->in_order = u->in_order && job == u->next++;
    if (job == 1 && u->expected > 0)
        u->while_committing = wait_for(u, u->expected + 2);
    u->committing = false;
    return job != u->stop;
}

static struct uneven run_unevenly(int n_slots, int expected, double patience, int64_t stop, int64_t *committed)
{
    struct uneven u = {.expected = expected, .patience = patience, .stop = stop, .in_order = true};
    struct parallel_jobs jobs = {JOBS, 2, n_slots, &u, work_unevenly, commit_unevenly, NULL};
    u.lock = os_lock_new();
    *committed = parallel_run(&jobs);
    os_lock_free(u.lock);
    return u;
}

static void count_thread(void *context, int thread)
{
    struct uneven *u = context;
    (void)thread;
    os_lock_take(u->lock);
    u->finished++;
    os_lock_leave(u->lock);
}

/* Can there be two threads? In a serial build there cannot. */
static bool two_threads(void)
{
    struct uneven u = {.lock = os_lock_new()};
    os_run_threads(2, count_thread, &u);
    os_lock_free(u.lock);
    return u.finished == 2;
}

struct waiting {
    struct parallel_jobs *jobs;
    int64_t next, stop; /* job to be committed next; the last one */
    int early, late;    /* jobs that went on before their turn; that were told to stop */
};

static void work_and_await(void *context, int64_t job, int slot, int thread)
{
    struct waiting *w = context;
    (void)slot, (void)thread;
    if (job % 3 == 0)
        return;
    if (parallel_await(w->jobs, job))
        w->early += w->next != job; /* by nobody else now */
    else
        w->late++; /* after the last commit there is at most one */
}

/* Long enough for the next job to come to its question meanwhile. */
static bool commit_waiting(void *context, int64_t job, int slot)
{
    struct waiting *w = context;
    (void)slot;
    nanosleep(&(struct timespec){0, 1000000}, NULL);
    w->next = job + 1;
    return job != w->stop;
}

/* Jobs that wait for their turn have it after all others before them, and do not wait for ever. */
static void test_await(struct test *t)
{
    for (int64_t stop = -1; stop < 20; stop += 7) {
        struct waiting w = {.stop = stop};
        struct parallel_jobs jobs = {JOBS, 2, 8, &w, work_and_await, commit_waiting, NULL};
        w.jobs = &jobs;
        int64_t n = parallel_run(&jobs);
        CHECK(t, n == (stop < 0 ? JOBS : stop + 1) && w.early == 0 && w.late <= 1,
              "of %d jobs %d went on too early, %d too late", (int)n, w.early, w.late);
    }
}

static void test_uneven(struct test *t)
{
    enum { SLOTS = 2 * SLOTS_PER_THREAD };
    int64_t n;
    struct uneven u = run_unevenly(8, 0, 0, 9, &n);
    CHECK(t, n == 10 && u.in_order, "the commit of job 9 says stop, and %d jobs are committed", (int)n);
    if (!two_threads())
        return;
    u = run_unevenly(SLOTS, SLOTS - 1, 20, -1, &n);
    CHECK(t, n == JOBS && u.in_order && u.overlapping == 0, "%d jobs are committed, one at a time, in order", (int)n);
    CHECK(t, u.while_first == SLOTS - 1, "%d jobs end beside a long one", u.while_first);
    CHECK(t, u.while_committing == SLOTS + 1, "%d jobs have ended during the second commit", u.while_committing);
    u = run_unevenly(2, 2, 0.1, -1, &n);
    CHECK(t, n == JOBS && u.while_first == 1, "%d jobs end beside a long one with one slot left", u.while_first);
}

void test_threads(struct test *t)
{
    struct scene scene;
    test_await(t);
    test_uneven(t);
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", 24, 18, &scene)) /* four tiles */
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        test_method(t, &scene, set_method(&scene, method_name(*m)), method_name(*m));
    scene_free(&scene);
}
