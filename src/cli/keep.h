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
#include "cli/job_options.h"
#include "render/part.h"

struct keep {
    const struct keep_options *options;
    struct part part; /* what is being rendered */
    struct film *film;
    struct progress bar;
    double begun, saved; /* when the render was, and the last checkpoint: seconds of os_wall_seconds */
    double preview_due;  /* seconds since `begun` */
    bool save_fails, preview_fails; /* the last one has not been written, which has been said */
    const struct outputs *pictures; /* for previews; borrowed */
};

/* keep_check: can the options be as they are, and the checkpoint's file be written? False with a message. */
bool keep_check(const struct keep_options *o, struct error *err);

/* keep_begin: cut the render to the samples asked for, and continue what --resume names. False with a message; after
 * success keep_end must follow.
 *   job     in-out: its samples, and what is called after each tile pass, which is given `k`
 *   film    initialised, empty
 *   pictures  their film and part set before the render
 * keep_end: remove the progress bar, say on stderr if and why the render has stopped early, save the last checkpoint if
 * `ok`. False with a message where it cannot be written; err may be NULL. The caller releases k->part. */
bool keep_begin(struct keep *k, const struct keep_options *o, bool quiet, struct job *job, struct film *film,
                const struct outputs *pictures, struct error *err);
bool keep_end(struct keep *k, bool ok, struct error *err);

#endif
