/* progress.c: see progress.h. */

#include "base/progress.h"

#include <math.h>
#include <stdio.h>

#include "base/number.h"
#include "base/os.h"

enum { BAR = 20, COLUMNS = 50 };

void progress_duration(double seconds, char *text, size_t size)
{
    const int MINUTE = 60, HOUR = 60 * MINUTE, DAY = 24 * HOUR;
    int s = int_within(seconds + 0.5, 0, 1000 * DAY);
    if (s < MINUTE)
        snprintf(text, size, "%d s", s);
    else if (s < HOUR)
        snprintf(text, size, "%d min %02d s", s / MINUTE, s % MINUTE);
    else if (s < DAY)
        snprintf(text, size, "%d h %02d min", s / HOUR, s % HOUR / MINUTE);
    else
        snprintf(text, size, "%d day%s %d h", s / DAY, s < 2 * DAY ? "" : "s", s % DAY / HOUR);
}

void progress_start(struct progress *p, bool quiet)
{
    p->shown = !quiet;
    p->bar = os_terminal(stderr);
    p->note[0] = '\0';
    p->start = os_wall_seconds();
    p->last = p->start;
    p->first_done = 0;
}

double progress_left(struct progress *p, double now, double done)
{
    if (p->first_done == 0 && done > 0) {
        p->first = now;
        p->first_done = done;
    }
    return p->first_done > 0 && now - p->first >= 2 ? (now - p->first) * (1 - done) / (done - p->first_done) : INFINITY;
}

void progress_update(struct progress *p, double done)
{
    double now = os_wall_seconds(), seconds = progress_left(p, now, done);
    if (!p->shown || now - p->last < (p->bar ? 0.1 : 60))
        return;
    p->last = now;
    char left[32];
    progress_duration(seconds, left, sizeof left);
    int bar = p->note[0] != '\0' ? BAR / 4 : BAR;
    int n = 0; /* columns */
    if (p->bar)
        n = fprintf(stderr, "\r[%-*.*s] ", bar, (int)(done * bar), "====================") - 1;
    bool known = seconds < INFINITY;
    n += fprintf(stderr, "%3d %%%s%s%s%s", (int)(done * 100), p->note, known ? ", " : "", known ? left : "",
                 known ? " left" : "");
    if (p->bar)
        fprintf(stderr, "%*s", n < COLUMNS ? COLUMNS - 1 - n : 0, ""); /* over what is left of a longer line */
    else
        fputs("\n", stderr);
    fflush(stderr);
}

void progress_end(struct progress *p)
{
    if (p->shown && p->bar)
        fprintf(stderr, "\r%*s\r", COLUMNS - 1, "");
}
