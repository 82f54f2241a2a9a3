/* interrupt.h: what happens when somebody ends the program: signals, and the temporary files that must go.
 *
 * Until interrupt_defer the first SIGINT, SIGTERM, SIGHUP or SIGXCPU (a limit of CPU time) ends the program. After it
 * the first is kept for the work to look at, so that a render can stop and write what there is. Whatever follows within
 * a second is the same wish: a terminal, GNU timeout and batch systems signal a program and its group. A later one ends
 * the program at once, unless it is a further SIGXCPU, which nobody sends. When it ends by itself or by one of
 * these, temporary files are removed: file.h registers them here.
 *
 * A signal handler can reach nothing but static variables; those of interrupt.c are the only ones of the program that
 * change. Tests: test/run/checkpoint.sh. */
#ifndef ASBDPT_INTERRUPT_H
#define ASBDPT_INTERRUPT_H

/* interrupt_init: to be called once, first of all. Signals that the program was started to ignore (nohup)
 * stay ignored; SIGXFSZ and SIGPIPE are too, so that the write that caused one fails and is reported. */
void interrupt_init(void);

/* interrupt_defer: from now on the first signal is only noted, and this said on stderr at once; borrowed for ever.
 * interrupt_caught: the signal noted, or 0. Thread-safe. */
void interrupt_defer(const char *notice);
int interrupt_caught(void);

/* temporary_add: a file, which need not be there yet, to be removed if the program ends; `path` must stay valid until
 * temporary_forget(path). Thread-safe. */
void temporary_add(const char *path);
void temporary_forget(const char *path);

#endif
