/* keep.h: nothing rendered is lost: a render is watched, stopped, saved and resumed here.
 *
 * A render ends early if its noise is below the limit (render/halves.h) or its time is over, as soon as its block of
 * samples is complete. If its method is still learning, learning ends and one block is rendered. At a signal
 * (base/interrupt.h), or half a second after the time is over, the render ends with the tile passes that are complete.
 * Pixels may then have different numbers of samples. The film is saved at intervals (render/part.h); a resumed render
 * ends with the same bytes. The image so far is written after 1, 2, 4 ... seconds. Tests: test/run/keep.sh.
 */
#ifndef ASBDPT_KEEP_H
#define ASBDPT_KEEP_H

#include "base/progress.h"
#include "cli/outputs.h"
#include "library/state.h"

struct keep {
    /* Options. */
    double time;             /* seconds; 0: no limit */
    const char *checkpoint;  /* file or NULL */
    double interval;         /* seconds between checkpoints */
    const char *resume;      /* file or NULL */
    double preview;          /* most seconds between previews; 0: none */
    /* What becomes of them. */
    struct asbdpt *of;       /* the render; borrowed */
    struct progress bar;
    double begun, saved; /* when the render was, and the last checkpoint: seconds of os_wall_seconds */
    double preview_due;  /* seconds since `begun` */
    bool save_fails, preview_fails; /* the last one has not been written, which has been said */
    const struct outputs *pictures; /* for previews; borrowed */
};

/* keep_check: can the options be as they are, and the checkpoint's file be written? False with a message. */
bool keep_check(const struct keep *k, const struct render_job *job, struct error *err);

/* keep_begin: continue what --resume names, and begin to watch. False with a message; after success keep_end must
 * follow. keep_progress, keep_cancel: for asbdpt_render, whose context is `k`.
 *   pictures  their film and part set before the render
 * keep_end: remove the progress bar, say on stderr if and why the render has stopped early, save the last checkpoint if
 * `ok`. False with a message where it cannot be written; err may be NULL. */
bool keep_begin(struct keep *k, struct asbdpt *of, const struct outputs *pictures, struct error *err);
void keep_progress(void *context, double learnt, double done);
int keep_cancel(void *context);
bool keep_end(struct keep *k, bool ok, struct error *err);

#endif
