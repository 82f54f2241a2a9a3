/* interrupt.c: see interrupt.h. The program's only variables that outlive a function and change are here. */

#include "base/interrupt.h"

#include <signal.h>
#include <stdlib.h>

#include "base/os.h"

enum { MAX_TEMPORARIES = 64 };

static volatile sig_atomic_t caught, deferred;
static const char *volatile temporary[MAX_TEMPORARIES]; /* not owned; NULL: free */

static void remove_temporaries(void)
{
    for (int i = 0; i < MAX_TEMPORARIES; i++)
        if (temporary[i] != NULL)
            os_remove_at_once(temporary[i]);
}

/* Everything called here is safe in a handler. The status is that of a program killed by the signal. */
static void note(int number)
{
    if (deferred && caught == 0) {
        caught = number;
        return;
    }
    remove_temporaries();
    os_exit_at_once(128 + number);
}

void interrupt_init(void)
{
    os_catch_signals(note);
    atexit(remove_temporaries); /* out of memory */
}

void interrupt_defer(void) { deferred = 1; }

int interrupt_caught(void) { return (int)caught; }

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
