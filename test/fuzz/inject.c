/* inject.c: functions that fail when they are told to. `make inject` compiles the program with -Dcalloc=inject_calloc
 * and so on, and test/run/inject.sh runs it again and again:
 *
 *     INJECT=count ./asbdpt-inject ...      prints how often each kind is called
 *     INJECT=close:3 ./asbdpt-inject ...    the third file that is closed cannot be
 *
 * Kinds: memory, write (from then on the disk is full), close, store, open, rename, thread. What is written stays in a
 * buffer at first, and all that is in it fails together: one write is counted for each buffer. */
#undef calloc
#undef realloc
#undef fwrite
#undef fprintf
#undef fputs
#undef fputc
#undef putc
#undef fclose
#undef fsync
#undef fdopen
#undef rename
#undef pthread_create

#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void *inject_calloc(size_t count, size_t size);
void *inject_realloc(void *p, size_t size);
size_t inject_fwrite(const void *data, size_t size, size_t n, FILE *f);
int inject_fprintf(FILE *f, const char *format, ...);
int inject_fputs(const char *text, FILE *f);
int inject_fputc(int c, FILE *f);
int inject_fclose(FILE *f);
int inject_fsync(int fd);
FILE *inject_fdopen(int fd, const char *mode);
int inject_rename(const char *from, const char *to);
int inject_pthread_create(pthread_t *t, const pthread_attr_t *a, void *(*start)(void *), void *argument);

enum kind { MEMORY, WRITE, CLOSE, STORE, OPEN, RENAME, THREAD, KINDS };
static const char *const NAMES[KINDS] = {"memory", "write", "close", "store", "open", "rename", "thread"};

static long called[KINDS], failing; /* the call that is to fail, from 1; 0: none */
static enum kind failing_kind = KINDS; /* KINDS: INJECT has not been read */
static FILE *written; /* to which the last write went, and to which part of it */
static long written_part;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static void print_counts(void)
{
    for (int k = 0; k < KINDS; k++)
        fprintf(stderr, "inject %s %ld\n", NAMES[k], called[k]);
}

static void read_wish(void)
{
    const char *wish = getenv("INJECT"), *colon = wish != NULL ? strchr(wish, ':') : NULL;
    failing_kind = MEMORY;
    for (int k = 0; colon != NULL && k < KINDS; k++)
        if (strncmp(wish, NAMES[k], (size_t)(colon - wish)) == 0) {
            failing_kind = (enum kind)k;
            failing = strtol(colon + 1, NULL, 10);
        }
    if (wish != NULL && strcmp(wish, "count") == 0)
        atexit(print_counts);
}

/* Is this call the one that is to fail? errno then says how. */
static int fails(enum kind kind, int reason)
{
    pthread_mutex_lock(&lock);
    if (failing_kind == KINDS)
        read_wish();
    int now = ++called[kind] == failing && kind == failing_kind;
    pthread_mutex_unlock(&lock);
    if (now)
        errno = reason;
    return now;
}

void *inject_calloc(size_t count, size_t size) { return fails(MEMORY, ENOMEM) ? NULL : calloc(count, size); }
void *inject_realloc(void *p, size_t size) { return fails(MEMORY, ENOMEM) ? NULL : realloc(p, size); }
int inject_fsync(int fd) { return fails(STORE, EIO) ? -1 : fsync(fd); }
int inject_rename(const char *from, const char *to) { return fails(RENAME, EACCES) ? -1 : rename(from, to); }

int inject_pthread_create(pthread_t *t, const pthread_attr_t *a, void *(*start)(void *), void *argument)
{
    return fails(THREAD, EAGAIN) ? EAGAIN : pthread_create(t, a, start, argument);
}

FILE *inject_fdopen(int fd, const char *mode) { return fails(OPEN, EMFILE) ? NULL : fdopen(fd, mode); }

int inject_fclose(FILE *f)
{
    int wrong = fails(CLOSE, EIO), status;
    pthread_mutex_lock(&lock);
    written = NULL; /* another file may come to be where this one was in memory */
    status = fclose(f);
    pthread_mutex_unlock(&lock);
    if (!wrong)
        return status;
    errno = EIO;
    return EOF;
}

/* Is this the first that goes into its file, or beyond the quarter of a buffer where the last write was? */
static int is_new_buffer(FILE *f)
{
    long part = ftell(f) / 1024;
    pthread_mutex_lock(&lock);
    int is_new = f != written || part != written_part;
    written = f;
    written_part = part;
    pthread_mutex_unlock(&lock);
    return is_new;
}

static void before_write(FILE *f)
{
    if (f == stderr || !is_new_buffer(f) || !fails(WRITE, 0))
        return;
    int full = open("/dev/full", O_WRONLY);
    if (full >= 0)
        dup2(full, fileno(f));
}

size_t inject_fwrite(const void *data, size_t size, size_t n, FILE *f)
{
    before_write(f);
    return fwrite(data, size, n, f);
}

int inject_fprintf(FILE *f, const char *format, ...)
{
    before_write(f);
    va_list args;
    va_start(args, format);
    int n = vfprintf(f, format, args);
    va_end(args);
    return n;
}

int inject_fputs(const char *text, FILE *f)
{
    before_write(f);
    return fputs(text, f);
}

int inject_fputc(int c, FILE *f)
{
    before_write(f);
    return fputc(c, f);
}
