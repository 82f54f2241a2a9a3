/* os.h: everything that this program asks of the operating system beyond what C99 has; nothing else includes a
 * system's headers. os.c and os_thread.c are written for POSIX, Windows and WASI; with -DASBDPT_SERIAL, or where there
 * are no threads, there is one, and locks do nothing.
 *
 * Paths: '/' separates directories everywhere, on Windows '\' too. Tests: test_threads.c, test_file.c, test/run/cli.sh;
 * `make portability` builds and runs it on other systems. */
#ifndef ASBDPT_OS_H
#define ASBDPT_OS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* ---- threads ---- */

/* os_cores: processors online, 1 to 1024. */
int os_cores(void);

/* os_run_threads: call work(context, i) for i in 0 .. n-1, each on a thread of its own, 0 on the calling one, and wait
 * for all. Where threads cannot be created those with the largest i are not called; 0 always is. n >= 1. */
void os_run_threads(int n, void (*work)(void *context, int thread), void *context);

/* A lock with a condition that threads can wait for. */
struct os_lock;
struct os_lock *os_lock_new(void);
void os_lock_free(struct os_lock *lock);
void os_lock_take(struct os_lock *lock);
void os_lock_leave(struct os_lock *lock);
void os_lock_wait(struct os_lock *lock);     /* leave it until somebody wakes us, and take it again */
void os_lock_wake_all(struct os_lock *lock); /* everybody who waits */

/* The one lock of the process, for what belongs to no render (interrupt.c); held for moments. */
void os_take_process(void);
void os_leave_process(void);

/* ---- time and memory ---- */

double os_wall_seconds(void); /* a steady clock; only differences mean something */
double os_cpu_seconds(void);  /* of all threads of this process; does not wrap. On WASI: wall time */
double os_peak_memory(void);  /* bytes this process has held at most, 0 where that is not told */
double os_memory(void);       /* bytes of the machine, 0 where that is not told */
uint64_t os_unique(void);     /* what no other process, and no other moment of this one, is likely to have */

/* ---- signals ---- */

/* os_catch_signals: call `handler` for those that ask the program to end, unless its parent has told it to
 * ignore them; ignore those that a failed write causes, so that the write is reported. Without signals: nothing. */
void os_catch_signals(void (*handler)(int number));
const char *os_signal_name(int number); /* "SIGINT" and so on */
bool os_signal_repeats(int number);     /* does it come again and again by itself? */

/* What a handler may do: remove a file, write to standard error. */
void os_remove_at_once(const char *path);
void os_say_at_once(const char *text);

/* ---- files ---- */

/* os_open_standard: to be called once, first of all: where standard input, output or error is closed, the next file
 * that is opened would come to be it, and messages would go into a picture. A stream that fails takes its place. */
void os_open_standard(void);

bool os_terminal(FILE *f); /* is it one? */
void os_binary(FILE *f);   /* have standard input or output carry bytes, not lines */

/* os_open_input: a file or a pipe for reading bytes. It does not wait for somebody to write to a pipe: where nobody
 * does, it is empty. Devices, which may never end, are refused with EPERM. NULL, and errno. */
FILE *os_open_input(const char *path);

enum os_kind { OS_NOTHING, OS_FILE, OS_DIRECTORY, OS_OTHER /* a device, a pipe */ };

/* os_kind_of: what a path leads to, links followed; for OS_NOTHING errno says why. os_kind_of_stream: what an open file
 * is; *size: bytes of an OS_FILE. */
enum os_kind os_kind_of(const char *path);
enum os_kind os_kind_of_stream(FILE *f, uint64_t *size);

bool os_same_file(const char *a, const char *b); /* do both paths lead to one that exists? */

/* os_create_new: a file that did not exist before, not even as a link, for writing bytes, with the rights of the file
 * `like` if that exists. NULL, and errno, where it does (EEXIST) or it cannot be. */
FILE *os_create_new(const char *path, const char *like);

/* All false, and errno, if that fails. os_make_directory: is it there afterwards? Those above it must exist. */
bool os_may_write(const char *path);                    /* an existing file */
bool os_store(FILE *f);                                 /* have everything that was written on the disk */
bool os_rename(const char *from, const char *to);       /* at once, in place of a file that may have the name `to` */
bool os_make_directory(const char *path);

bool os_separator(char c);                       /* of directories */
const char *os_last_separator(const char *path); /* or NULL */
bool os_absolute(const char *path);              /* does it start from no other directory? */

#endif
