/* interrupt.c: see interrupt.h. The program's only variables that outlive a function and change are here. */

#include "base/interrupt.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"

/* A list that only grows, at its head, by whole entries: it can be walked at any moment. */
struct temporary {
    const char *volatile path; /* not owned; NULL: the entry is free */
    struct temporary *next;
};

static volatile sig_atomic_t caught;
static volatile double caught_at = HUGE_VAL; /* os_wall_seconds */
static const char *volatile deferred; /* what is to be said; NULL: no signal is kept */
static struct temporary *volatile first; /* never given back */

static void remove_temporaries(void)
{
    for (struct temporary *t = first; t != NULL; t = t->next) {
        const char *path = t->path;
        if (path != NULL)
            os_remove_at_once(path);
    }
}

/* Everything called here is safe in a handler. The status is that of a program killed by the signal. */
static void note(int number)
{
    const char *notice = deferred;
    double now = os_wall_seconds();
    if (notice == NULL || (now - caught_at >= 1 && !os_signal_repeats(number))) {
        remove_temporaries();
        _Exit(128 + number);
    }
    if (caught == 0) {
        caught_at = now;
        os_say_at_once(notice);
        caught = number;
    }
}

void interrupt_init(void)
{
    os_catch_signals(note);
}

void interrupt_defer(const char *notice) { deferred = notice; }

int interrupt_caught(void) { return (int)caught; }

/* The entry with this path, or NULL. */
static struct temporary *find(const char *path)
{
    struct temporary *t = first;
    while (t != NULL && t->path != path)
        t = t->next;
    return t;
}

void temporary_add(const char *path)
{
    os_take_process();
    if (first == NULL)
        atexit(remove_temporaries); /* out of memory */
    struct temporary *t = find(NULL);
    if (t == NULL) {
        t = mem_alloc(1, sizeof *t);
        t->next = first;
        first = t;
    }
    t->path = path;
    os_leave_process();
}

void temporary_forget(const char *path)
{
    os_take_process();
    find(path)->path = NULL;
    os_leave_process();
}
