/* progress.c: see progress.h. */

#include "base/progress.h"

#include <stdio.h>

#include "base/os.h"

void progress_start(struct progress *p, bool quiet)
{
    p->shown = !quiet && os_terminal(stderr);
    p->start = os_wall_seconds();
    p->last = p->start;
}

/* `done` is a count over a count, 0 to 1. */
bool progress_update(void *progress, double done)
{
    enum { WIDTH = 40 };
    struct progress *p = progress;
    double now = os_wall_seconds();
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
