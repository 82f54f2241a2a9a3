/* checkpoint.c: see checkpoint.h. */
#include "cli/checkpoint.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/interrupt.h"
#include "base/number.h"
#include "base/os.h"
#include "render/noise_estimate.h"

/* Is the checkpoint to be resumed the one to be written? */
static bool resumes_its_own(const struct checkpoint *o)
{
    return o->file != NULL && o->resume != NULL && strcmp(o->file, o->resume) == 0;
}

bool checkpoint_check(const struct checkpoint *o, const struct render_job *job, struct error *err)
{
    if (job->samples[1] > 0 && job_asks_noise(job))
        return error_usage(err, "--noise is that of the whole image; --samples takes a part of it");
    if (o->file == NULL)
        return true;
    enum os_kind kind = os_kind_of(o->file);
    if (strcmp(o->file, "-") == 0 || (kind != OS_NOTHING && kind != OS_FILE))
        return error_usage(err, "--checkpoint %s: it needs a file", o->file);
    if (kind == OS_FILE && !resumes_its_own(o))
        return error_set(err, "%s: the file exists already; continue it by --resume %s, or remove it",
                         o->file, o->file);
    return outputs_possible(o->file, err);
}

/* If a checkpoint that is to be resumed and written does not exist yet, the render begins. */
static bool resume(const struct checkpoint *k, struct error *err)
{
    return k->resume == NULL || (resumes_its_own(k) && !file_exists(k->resume)) || state_load(k->of, k->resume, err);
}

/* The share of the work that is done if the noise ends it: the square of the noise falls as 1 / samples. */
static double share_by_noise(const struct checkpoint *k)
{
    double share = HUGE_VAL;
    for (int i = 0; i < N_NOISE_SCALES; i++)
        if (k->of->job.noise[i] > 0)
            share = fmin(share, sqr(k->of->job.noise[i] / k->of->film.noise[i].value));
    return share;
}

static void show(struct checkpoint *k, double done)
{
    bool relative = k->of->job.noise[NOISE_RELATIVE] > 0;
    double noise = k->of->film.noise[relative ? NOISE_RELATIVE : NOISE_8_BIT].value;
    if (k->of->film.half != NULL && noise < INFINITY) {
        snprintf(k->bar.note, sizeof k->bar.note, relative ? ", noise %.3g" : ", noise %.3g of 255", noise);
        done = fmax(done, fmin(share_by_noise(k), 1));
    }
    progress_update(&k->bar, done);
}

/* What cannot be written is tried again, and is a new warning only after it could be written. */
static void warn_once(bool *fails, bool ok, const struct error *err)
{
    if (!ok && !*fails)
        say_line("asbdpt: warning: %s; rendering goes on", err->text);
    *fails = !ok;
}

static void save(struct checkpoint *k)
{
    struct error err;
    bool ok = state_save(k->of, k->file, &err);
    warn_once(&k->save_fails, ok, &err);
    k->saved = os_wall_seconds();
}

/* What is shown then is new in half of its samples, until previews come at intervals. */
static void preview(struct checkpoint *k)
{
    struct error err;
    bool ok = outputs_preview(k->pictures, &err);
    warn_once(&k->preview_fails, ok, &err);
    double seconds = os_wall_seconds() - k->begun;
    k->preview_due = seconds + fmin(seconds, k->preview);
}

/* In place of a bar, or without the first character. */
static const char STOPPING[] = "\rasbdpt: stopping, and writing the image so far; "
                               "again after a second to quit without it\n";

/* Is the time over, and so many seconds more? */
static bool late(const struct checkpoint *k, double more)
{
    return k->time > 0 && os_wall_seconds() - k->begun >= k->time + more;
}

/* A block under way has half a second to end. Asked before every sample: the clock is read once. */
int checkpoint_cancel(void *context)
{
    const struct checkpoint *k = context;
    double over = k->time > 0 ? os_wall_seconds() - k->begun - k->time : -1;
    return interrupt_caught() != 0 || over >= 0.5 ? ASBDPT_STOP : over >= 0 ? ASBDPT_END_BLOCK : ASBDPT_CONTINUE;
}

void checkpoint_progress(void *context, double learnt, double done)
{
    struct checkpoint *k = context;
    (void)learnt;
    if (checkpoint_cancel(k) == ASBDPT_STOP) /* the bar is gone */
        return;
    show(k, done);
    if (k->file != NULL && os_wall_seconds() - k->saved >= k->interval)
        save(k);
    if (k->preview > 0 && film_samples(&k->of->film) > 0 && os_wall_seconds() - k->begun >= k->preview_due)
        preview(k);
}

bool checkpoint_begin(struct checkpoint *k, struct asbdpt *of, const struct outputs *pictures, struct error *err)
{
    k->of = of;
    k->pictures = pictures;
    k->preview_due = fmin(1, k->preview);
    if (!resume(k, err))
        return false;
    progress_start(&k->bar, of->job.quiet);
    k->begun = k->saved = k->bar.start;
    interrupt_defer(STOPPING + !k->bar.bar);
    return true;
}

static void say_noise(const struct checkpoint *k)
{
    const struct film *f = &k->of->film;
    const struct noise_estimate *relative = &f->noise[NOISE_RELATIVE], *levels = &f->noise[NOISE_8_BIT];
    long every = noise_every(f);
    if (relative->value < INFINITY)
        say_line("asbdpt: noise %.3g +- %.1g of the brightness around, %.3g +- %.1g of 255 levels, at %ld samples per "
                 "pixel: %s the limit", relative->value, relative->error, levels->value, levels->error,
                 f->iterations - f->iterations % every, share_by_noise(k) > 1 ? "below" : "above");
    else
        say_line("asbdpt: the noise is unknown: it is estimated every %ld samples per pixel", every);
}

bool checkpoint_end(struct checkpoint *k, bool ok, struct error *err)
{
    const struct film *f = &k->of->film;
    int signal = interrupt_caught();
    long wanted = k->of->part.end - k->of->part.first;
    char more[64] = "";
    progress_end(&k->bar);
    if (f->passes > 0)
        snprintf(more, sizeof more, ", %.3g %% of the pixels at %ld",
                 100 * (double)f->block.n_in / (double)rect_pixels(f->rect), f->iterations + f->block.iterations);
    if (ok && signal != 0)
        say_line("asbdpt: stopped by %s, at %ld of %ld samples per pixel%s", os_signal_name(signal), f->iterations,
                 wanted, more);
    else if (ok && late(k, 0) && f->iterations < wanted)
        say_line("asbdpt: stopped after %.1f s%s, at %ld of %ld samples per pixel%s", os_wall_seconds() - k->begun,
                 late(k, 1) ? ", when the samples that had begun were complete" : "", f->iterations, wanted, more);
    if (ok && k->bar.shown && f->half != NULL)
        say_noise(k);
    return ok && (k->file == NULL || state_save(k->of, k->file, err));
}
