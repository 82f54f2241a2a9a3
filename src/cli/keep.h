/* keep.h: nothing rendered is lost: what watches over a render while it runs, stops it, saves and resumes it.
 *
 * A render ends early when its noise is below what was asked for (render/halves.h), or when its time is over, once its
 * block of samples is complete; if its method still learns, it ends that with what it has learnt and makes one block.
 * At a signal (base/interrupt.h), and if the block takes half a second more than the time, it ends with the tile passes
 * that are complete: pixels may have different numbers of samples then.
 * Its film is saved from time to time (render/part.h), and goes on from there to the same bytes. Tests: test/keep.sh.
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
};

/* keep_check: can the options be as they are, and the checkpoint's file be written? False with a message. */
bool keep_check(const struct keep_options *o, struct error *err);

/* keep_begin: cut the render to the samples asked for, and continue what --resume names. False with a message; after
 * success keep_end must follow.
 *   render  in-out: its samples, and what is called after each tile pass, which is given `k`
 *   film    initialised, empty
 * keep_end: remove the progress bar, say on stderr if and why the render has stopped early, save the last checkpoint if
 * `ok`. False with a message where it cannot be written; err may be NULL. The caller releases k->part.
 * keep_after: the render's progress from now on is that of what is made when it is done, --aov; it, too, ends at a
 * signal and in time. progress_end(&k->bar) must follow. */
bool keep_begin(struct keep *k, const struct keep_options *o, bool quiet, const struct scene *scene,
                struct render_options *render, struct film *film, struct error *err);
bool keep_end(struct keep *k, bool ok, struct error *err);
void keep_after(struct keep *k, struct render_options *render);

#endif
