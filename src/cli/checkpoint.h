/* checkpoint.h: nothing rendered is lost: a render is watched, stopped, saved and resumed here.
 *
 * A render ends early if its noise is below the limit (render/noise_estimate.h) or its time is over, as soon as its
 * block of samples is complete. If its method is still learning, learning ends and one block is rendered. At a signal
 * (base/interrupt.h), or half a second after the time is over, the render ends with the tile passes that are complete.
 * Pixels may then have different numbers of samples. The film is saved at intervals (render/part.h); a resumed render
 * ends with the same bytes. The image so far is written after 1, 2, 4 ... seconds. Tests: test/run/checkpoint.sh.
 */
#ifndef ASBDPT_CHECKPOINT_H
#define ASBDPT_CHECKPOINT_H

#include "base/progress.h"
#include "cli/outputs.h"
#include "library/state.h"

struct checkpoint {
    /* Options. */
    double time;             /* seconds; 0: no limit */
    const char *file;        /* of the checkpoint, or NULL */
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

/* checkpoint_check: can the options be as they are, and the checkpoint's file be written? False with a message. */
bool checkpoint_check(const struct checkpoint *k, const struct render_job *job, struct error *err);

/* checkpoint_begin: continue what --resume names, and begin to watch. False with a message; after success
 * checkpoint_end must follow. checkpoint_progress, checkpoint_cancel: for asbdpt_render, whose context is `k`.
 *   pictures  their film and part set before the render
 * checkpoint_end: remove the progress bar, say on stderr if and why the render has stopped early, save the last
 * checkpoint if `ok`. False with a message where it cannot be written; err may be NULL. */
bool checkpoint_begin(struct checkpoint *k, struct asbdpt *of, const struct outputs *pictures, struct error *err);
void checkpoint_progress(void *context, double learnt, double done);
int checkpoint_cancel(void *context);
bool checkpoint_end(struct checkpoint *k, bool ok, struct error *err);

#endif
