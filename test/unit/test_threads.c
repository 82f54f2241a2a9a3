/* test_threads.c: small renders by every method on four threads give what one thread gives; made for the thread
 * sanitizer (make tsan). Jobs of uneven length do not hold up others, and are committed in order. */
#define _POSIX_C_SOURCE 200809L

#include <string.h>
#include <time.h>

#include "base/os.h"
#include "base/parallel.h"
#include "helpers.h"
#include "suites.h"

static void sleep_a_millisecond(void) { nanosleep(&(struct timespec){0, 1000000}, NULL); }

/* Whoever does a piece of work sleeps, the first times and now and then, so that other threads do the next. */
static void share(void *context, double learnt, double done)
{
    int *times = context;
    (void)learnt, (void)done;
    if (++*times <= 16 || *times % 16 == 0)
        sleep_a_millisecond();
}

/* Two parts by four threads are one render by one thread, with whatever is learnt; another seed is another picture. Of
 * bins a part is a block; of chains a block is too long for two. */
static void test_method(struct test *t, const struct scene *scene, const char *integrator, const char *what)
{
    const int middle = strstr(what, "bins") != NULL ? LONGEST_BLOCK : 4;
    const int end = middle + (strstr(what, "mlt") != NULL ? 0 : 2);
    struct film film[3];
    for (int i = 0; i < 3; i++) {
        int times = 0;
        struct render_job o = {.integrator = method_of(scene, integrator), .n_threads = i == 0 ? 1 : 4,
                                   .max_depth = 4,
                                   .seed = test_seed(t) + (i == 2), .end = i == 1 ? middle : end, .planned = end,
                                   .block = 2, .progress = i == 1 ? share : NULL, .context = &times};
        struct error err;
        bool ok;
        film_init(&film[i], render_crop(scene), scene->width, scene->height);
        while ((ok = render_by(scene, &o, &film[i], &err)) && o.end < end) {
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

/* Wait until `*counter`, which others raise under the lock, is at least `expected`; after 20 seconds it never will be.
 * Then the others have three milliseconds for what they must not do, or more on a busy machine. Returns the counter. */
static int wait_for(struct os_lock *lock, const int *counter, int expected)
{
    double end = os_wall_seconds() + 20;
    int now = 0;
    for (int times = 0; times < 3; times += now >= expected || os_wall_seconds() > end) {
        sleep_a_millisecond();
        os_lock_take(lock);
        now = *counter;
        os_lock_leave(lock);
    }
    return now;
}

struct uneven {
    struct os_lock *lock;
    int expected;         /* jobs that job 0 waits for */
    int finished;         /* jobs that have ended, */
    int while_first;      /* until job 0 did, */
    int while_committing; /* until job 1 was committed, which waits for one more than were begun until then */
    int64_t next;         /* the job to be committed */
    int overlapping;      /* commits */
    bool committing, in_order;
};

static void work_unevenly(void *context, int64_t job, int slot, int thread)
{
    struct uneven *u = context;
    (void)slot, (void)thread;
    if (job == 0)
        u->while_first = wait_for(u->lock, &u->finished, u->expected);
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
    if (job == 1)
        u->while_committing = wait_for(u->lock, &u->finished, u->expected + 2);
    u->committing = false;
    return true;
}

/* While one job takes long the others fill all slots, and no more; so do they during a commit that takes long. */
static void test_slots(struct test *t, int n_slots)
{
    struct uneven u = {.lock = os_lock_new(), .expected = n_slots - 1, .in_order = true};
    struct parallel_jobs jobs = {JOBS, 2, n_slots, &u, work_unevenly, commit_unevenly, NULL};
    int n = (int)parallel_run(&jobs);
    os_lock_free(u.lock);
    CHECK(t, n == JOBS && u.in_order && u.overlapping == 0, "%d jobs are committed, one at a time, in order", n);
    CHECK(t, u.while_first == n_slots - 1, "%d jobs end beside a long one with %d slots", u.while_first, n_slots);
    CHECK(t, u.while_committing == n_slots + 1, "%d jobs have ended during the second commit with %d slots",
          u.while_committing, n_slots);
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
    struct os_lock *lock;
    struct parallel_jobs *jobs;
    bool together;      /* are there two threads? */
    int asked;          /* jobs up to this have come to their question */
    int64_t next, stop; /* job to be committed next; the last one */
    int early, late;    /* jobs that went on before their turn; that were told to stop */
};

static bool waits(int64_t job) { return job % 3 != 0; }

static void work_and_await(void *context, int64_t job, int slot, int thread)
{
    struct waiting *w = context;
    (void)slot, (void)thread;
    if (!waits(job))
        return;
    os_lock_take(w->lock);
    w->asked = (int)job;
    os_lock_leave(w->lock);
    if (parallel_await(w->jobs, job))
        w->early += w->next != job; /* by nobody else now */
    else
        w->late++; /* after the last commit there is at most one */
}

/* The next job, if it waits for its turn, has come to its question before this one is committed. */
static bool commit_waiting(void *context, int64_t job, int slot)
{
    struct waiting *w = context;
    (void)slot;
    if (w->together && job + 1 < JOBS && waits(job + 1))
        wait_for(w->lock, &w->asked, (int)job + 1);
    w->next = job + 1;
    return job != w->stop;
}

/* Jobs that wait for their turn have it after all others before them, and do not wait for ever. */
static void test_await(struct test *t, bool together)
{
    for (int64_t stop = -1; stop < 20; stop += 7) {
        struct waiting w = {.lock = os_lock_new(), .together = together, .stop = stop};
        struct parallel_jobs jobs = {JOBS, 2, 8, &w, work_and_await, commit_waiting, NULL};
        w.jobs = &jobs;
        int64_t n = parallel_run(&jobs);
        os_lock_free(w.lock);
        CHECK(t, n == (stop < 0 ? JOBS : stop + 1) && w.early == 0 && w.late <= 1,
              "of %d jobs %d went on too early, %d too late", (int)n, w.early, w.late);
    }
}

void test_threads(struct test *t)
{
    struct scene scene;
    bool together = two_threads();
    test_await(t, together);
    if (together) {
        test_slots(t, 2 * SLOTS_PER_THREAD);
        test_slots(t, 2);
    }
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", 24, 18, &scene)) /* four tiles */
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        test_method(t, &scene, set_method(&scene, method_name(*m)), method_name(*m));
    scene_free(&scene);
}
