/* progress.h: how far a long job is and how long it will still take, on stderr.
 *
 * On a terminal a bar that is redrawn, narrow enough for 50 columns; in a file one line a minute.
 * Tests: test_file.c. */
#ifndef ASBDPT_PROGRESS_H
#define ASBDPT_PROGRESS_H

#include <stdbool.h>
#include <stddef.h>

struct progress {
    bool shown, bar;    /* at all; on a terminal */
    char note[32];      /* what else is to be shown; may be empty */
    double start, last; /* seconds of os_wall_seconds */
    double first, first_done; /* when the first of the work was done, and how much; 0: none was */
};

/* progress_start: show nothing yet; nothing at all if `quiet`. progress_update: redraw, at most ten times a second;
 * `done` in [0,1]. progress_end: remove the bar. */
void progress_start(struct progress *p, bool quiet);
void progress_update(struct progress *p, double done);
void progress_end(struct progress *p);

/* progress_left: seconds that the rest will take at the rate since the first of the work was done; infinite in the
 * first two seconds, when it would be a guess. */
double progress_left(struct progress *p, double now, double done);

/* progress_duration: "12 s", "3 min 20 s", "2 h 05 min" or "3 days 4 h" into text [size]; seconds >= 0, others count
 * as 0. */
void progress_duration(double seconds, char *text, size_t size);

#endif
