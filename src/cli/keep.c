/* keep.c: see keep.h. */
#include "cli/keep.h"

#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/interrupt.h"
#include "base/os.h"
#include "cli/names.h"

/* Is the checkpoint to be resumed the one to be written? */
static bool resumes_its_own(const struct keep_options *o)
{
    return o->checkpoint != NULL && o->resume != NULL && names_same(o->checkpoint, o->resume);
}

bool keep_check(const struct keep_options *o, struct error *err)
{
    if (o->checkpoint == NULL)
        return true;
    enum os_kind kind = os_kind_of(o->checkpoint);
    if (strcmp(o->checkpoint, "-") == 0 || (kind != OS_NOTHING && kind != OS_FILE))
        return error_set(err, "--checkpoint %s: it needs a file", o->checkpoint);
    if (kind == OS_FILE && !resumes_its_own(o))
        return error_set(err, "%s: there is such a file already; go on with it by --resume %s, or remove it",
                         o->checkpoint, o->checkpoint);
    return outputs_possible(o->checkpoint, err);
}

/* Where that is so, its absence is the beginning. */
static bool resume(struct keep *k, struct error *err)
{
    const struct keep_options *o = k->options;
    struct part found;
    if (o->resume == NULL || (resumes_its_own(o) && !file_exists(o->resume)))
        return true;
    FILE *file = part_open(o->resume, &found, err);
    if (file == NULL)
        return false;
    struct part asked = k->part; /* the same picture, of however many samples */
    asked.planned = found.planned;
    bool ok = part_same(&found, o->resume, &asked, err);
    if (ok && (found.first != k->part.first || found.end > k->part.end))
        ok = error_set(err, "%s: it is for the samples %ld:%ld, not %ld:%ld", o->resume, found.first, found.end,
                       k->part.first, k->part.end);
    if (ok)
        ok = part_add(file, o->resume, &found, k->film, err);
    else
        fclose(file);
    part_free(&found);
    return ok;
}

/* Samples by what was learnt in haste are for the picture at hand alone: it is gone on with from the beginning. */
static bool save_film(const struct keep *k, struct error *err)
{
    const struct film *f = k->film;
    struct film none;
    if (!f->learnt_short)
        return part_save(k->options->checkpoint, &k->part, f, err);
    film_init(&none, f->rect, f->full_width, f->full_height);
    bool ok = part_save(k->options->checkpoint, &k->part, &none, err);
    film_free(&none);
    return ok;
}

static void save(struct keep *k)
{
    struct error err;
    if (!save_film(k, &err))
        fprintf(stderr, "asbdpt: warning: %s; rendering goes on\n", err.text);
    k->saved = os_wall_seconds();
}

/* While the method learns, and after each tile pass. */
static bool watch(void *context, double done)
{
    struct keep *k = context;
    const struct keep_options *o = k->options;
    double now = os_wall_seconds();
    interrupt_defer();
    bool signal = interrupt_caught() != 0;
    progress_update(&k->bar, done);
    if (o->checkpoint != NULL && ((signal && !k->hurried) || now - k->saved >= o->interval)) {
        k->hurried = signal;
        save(k);
    }
    k->late = o->time > 0 && now - k->bar.start >= o->time;
    return !signal && !k->late;
}

bool keep_begin(struct keep *k, const struct keep_options *o, bool quiet, const struct scene *scene,
                struct render_options *render, struct film *film, struct error *err)
{
    memset(k, 0, sizeof *k);
    render->planned = render->end;
    if (o->samples[1] > 0) {
        if (o->samples[1] > render->planned)
            return error_set(err, "--samples %d:%d: there are %ld per pixel, see --spp", o->samples[0], o->samples[1],
                             render->planned);
        render->first = o->samples[0];
        render->end = o->samples[1];
        render->is_part = true;
    }
    k->options = o;
    k->film = film;
    k->part = part_describe(scene, render);
    if (!resume(k, err)) {
        part_free(&k->part);
        return false;
    }
    render->first += film->iterations;
    render->progress = watch;
    render->progress_context = k;
    progress_start(&k->bar, quiet);
    k->saved = k->bar.start;
    return true;
}

bool keep_end(struct keep *k, bool ok, struct error *err)
{
    const struct film *f = k->film;
    int signal = interrupt_caught();
    long wanted = k->part.end - k->part.first;
    progress_end(&k->bar);
    if (ok && signal != 0)
        fprintf(stderr, "asbdpt: stopped by %s, at %ld of %ld samples per pixel\n", os_signal_name(signal),
                f->iterations, wanted);
    else if (ok && k->late && f->iterations < wanted)
        fprintf(stderr, "asbdpt: stopped after %.1f s, at %ld of %ld samples per pixel\n",
                os_wall_seconds() - k->bar.start, f->iterations, wanted);
    return ok && (k->options->checkpoint == NULL || save_film(k, err));
}
