/* interrupt.c: see interrupt.h. The program's only variables that outlive a function and change are here. */
#define _XOPEN_SOURCE 700 /* SIGXFSZ */

#include "base/interrupt.h"

#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

enum { MAX_TEMPORARIES = 64 };

static volatile sig_atomic_t caught, deferred;
static const char *volatile temporary[MAX_TEMPORARIES]; /* not owned; NULL: free */

static void remove_temporaries(void)
{
    for (int i = 0; i < MAX_TEMPORARIES; i++)
        if (temporary[i] != NULL)
            unlink(temporary[i]);
}

/* Everything called here is safe in a handler [POSIX 2.4.3]. The status is that of a program killed by the signal. */
static void note(int number)
{
    if (deferred && caught == 0) {
        caught = number;
        return;
    }
    remove_temporaries();
    _exit(128 + number);
}

static void handle(int number, void (*handler)(int))
{
    struct sigaction old, action;
    if (sigaction(number, NULL, &old) != 0 || old.sa_handler == SIG_IGN)
        return;
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

void interrupt_init(void)
{
    handle(SIGXFSZ, SIG_IGN);
    handle(SIGPIPE, SIG_IGN);
    handle(SIGINT, note);
    handle(SIGTERM, note);
    handle(SIGHUP, note);
    atexit(remove_temporaries); /* out of memory */
}

void interrupt_defer(void) { deferred = 1; }

int interrupt_caught(void) { return (int)caught; }

const char *interrupt_name(int number)
{
    return number == SIGINT ? "SIGINT" : number == SIGTERM ? "SIGTERM" : number == SIGHUP ? "SIGHUP" : "a signal";
}

void temporary_add(const char *path)
{
    for (int i = 0; i < MAX_TEMPORARIES; i++)
        if (temporary[i] == NULL) {
            temporary[i] = path;
            return;
        }
}

void temporary_forget(const char *path)
{
    for (int i = 0; i < MAX_TEMPORARIES; i++)
        if (temporary[i] == path)
            temporary[i] = NULL;
}
