/* os_thread.c: threads and locks, see os.h. */

#if defined __linux__ || defined __CYGWIN__
#define _POSIX_C_SOURCE 200809L
#endif
#define _NETBSD_SOURCE 1 /* for sysconf, as in os.c */

#include "base/os.h"

#ifdef _WIN32
#include <windows.h>
#elif !defined __wasi__
#include <unistd.h>
#endif
#include <stdlib.h>

#include "base/mem.h"

#if defined __wasi__ && !defined ASBDPT_SERIAL
#define ASBDPT_SERIAL
#endif

#ifdef ASBDPT_SERIAL

int os_cores(void) { return 1; }

void os_run_threads(int n, void (*work)(void *context, int thread), void *context)
{
    (void)n;
    work(context, 0);
}

struct os_lock *os_lock_new(void) { return NULL; }
void os_lock_free(struct os_lock *lock) { (void)lock; }
void os_lock_take(struct os_lock *lock) { (void)lock; }
void os_lock_leave(struct os_lock *lock) { (void)lock; }
void os_lock_wait(struct os_lock *lock) { (void)lock; }
void os_lock_wake_all(struct os_lock *lock) { (void)lock; }
void os_take_process(void) {}
void os_leave_process(void) {}

#else

#include <pthread.h>

int os_cores(void)
{
#ifdef _WIN32
    SYSTEM_INFO info;
    GetSystemInfo(&info);
    double n = (double)info.dwNumberOfProcessors;
#else
    double n = (double)sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return n < 1 ? 1 : n > 1024 ? 1024 : (int)n;
}

struct thread {
    pthread_t handle;
    void (*work)(void *context, int thread);
    void *context;
    int number;
};

static void *start(void *argument)
{
    const struct thread *t = argument;
    t->work(t->context, t->number);
    return NULL;
}

void os_run_threads(int n, void (*work)(void *context, int thread), void *context)
{
    struct thread *thread = mem_alloc((size_t)n, sizeof *thread);
    int started = 1;
    for (; started < n; started++) {
        struct thread *t = &thread[started];
        t->work = work;
        t->context = context;
        t->number = started;
        if (pthread_create(&t->handle, NULL, start, t) != 0)
            break;
    }
    work(context, 0);
    for (int i = 1; i < started; i++)
        pthread_join(thread[i].handle, NULL);
    free(thread);
}

struct os_lock {
    pthread_mutex_t mutex;
    pthread_cond_t condition;
};

struct os_lock *os_lock_new(void)
{
    struct os_lock *lock = mem_alloc(1, sizeof *lock);
    pthread_mutex_init(&lock->mutex, NULL);
    pthread_cond_init(&lock->condition, NULL);
    return lock;
}

void os_lock_free(struct os_lock *lock)
{
    pthread_cond_destroy(&lock->condition);
    pthread_mutex_destroy(&lock->mutex);
    free(lock);
}

static pthread_mutex_t process = PTHREAD_MUTEX_INITIALIZER;
void os_take_process(void) { pthread_mutex_lock(&process); }
void os_leave_process(void) { pthread_mutex_unlock(&process); }

void os_lock_take(struct os_lock *lock) { pthread_mutex_lock(&lock->mutex); }
void os_lock_leave(struct os_lock *lock) { pthread_mutex_unlock(&lock->mutex); }
void os_lock_wait(struct os_lock *lock) { pthread_cond_wait(&lock->condition, &lock->mutex); }
void os_lock_wake_all(struct os_lock *lock) { pthread_cond_broadcast(&lock->condition); }

#endif
