/* progress.h: a progress bar with the time left, on stderr when that is a terminal. */
#ifndef ASBDPT_PROGRESS_H
#define ASBDPT_PROGRESS_H

#include <stdbool.h>

struct progress {
    bool shown;
    double start, last; /* seconds of os_wall_seconds */
};

/* progress_start: show nothing yet; stay silent if `quiet` or stderr is not a terminal. */
void progress_start(struct progress *p, bool quiet);

/* progress_update: redraw, at most ten times a second; `done` in [0,1]. Always returns true, so that it can serve as
 * render_options.progress. */
bool progress_update(void *progress, double done);

/* progress_end: remove the bar. */
void progress_end(struct progress *p);

#endif
