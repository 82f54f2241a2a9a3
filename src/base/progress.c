/* progress.c: see progress.h. */
#define _POSIX_C_SOURCE 200809L

#include "base/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double clock_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_start(struct progress *p, bool quiet)
{
    p->shown = !quiet && isatty(STDERR_FILENO);
    p->start = clock_seconds();
    p->last = p->start;
}

/* `done` is a count over a count, 0 to 1. */
bool progress_update(void *progress, double done)
{
    enum { WIDTH = 40 };
    struct progress *p = progress;
    double now = clock_seconds();
    if (!p->shown || now - p->last < 0.1)
        return true;
    p->last = now;
    double elapsed = now - p->start, left = done > 0 ? elapsed / done - elapsed : 0;
    char bar[WIDTH + 1];
    for (int i = 0; i < WIDTH; i++)
        bar[i] = i < (int)(done * WIDTH) ? '=' : ' ';
    bar[WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %3d%%  %.1f s, %.1f s left   ", bar, (int)(done * 100), elapsed, left);
    fflush(stderr);
    return true;
}

void progress_end(struct progress *p)
{
    if (p->shown)
        fprintf(stderr, "\r%79s\r", "");
}
