/* state.c: see state.h. */
#include "library/state.h"

#include <stdarg.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"

void growing_add(struct growing *t, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    if (n < 0)
        return;
    t->text = mem_grow(t->text, &t->capacity, t->n + (size_t)n + 1, 1);
    va_start(args, format);
    vsnprintf(t->text + t->n, (size_t)n + 1, format, args);
    va_end(args);
    t->n += (size_t)n;
}

/* --- scene and film ----------------------------------------------------------------------------------- */

static void begin_film(struct asbdpt *r, bool halves)
{
    film_init(&r->film, r->job.film_rect, r->scene.width, r->scene.height);
    if (halves)
        film_keep_halves(&r->film);
}

bool state_open(struct asbdpt *r, struct error *err)
{
    const struct render_job asked = r->job;
    double start = os_wall_seconds();
    struct error why;
    if (!job_load(&r->job, &r->scene, &r->prepared, err)) {
        r->job = asked;
        return false;
    }
    r->load = os_wall_seconds() - start;
    r->open = budget_has(&r->scene.memory, film_bytes(r->job.film_rect, job_asks_noise(&r->job)), &why);
    if (!r->open) {
        error_set(err, "%s: its film of %dx%d pixels: %s; --res makes it smaller", r->job.scene_path, r->scene.width,
                  r->scene.height, why.text);
        method_release(&r->prepared);
        scene_free(&r->scene);
        r->job = asked;
        return false;
    }
    begin_film(r, job_asks_noise(&r->job));
    r->part = part_describe(&r->job);
    return true;
}

/* The part, if it ends there or later: calls may have added more samples than were asked for at first. */
static struct part grown(const struct asbdpt *r, long end)
{
    struct part p = r->part;
    p.end = end > p.end ? end : p.end;
    p.planned = p.end > p.planned ? p.end : p.planned;
    return p;
}

/* After learning that was cancelled, samples are of another picture than those of a checkpoint. */
static bool refuse_haste(struct error *err)
{
    return error_set(err, "learning was cancelled, but the samples of the checkpoint go by all of it: open both again");
}

bool state_load(struct asbdpt *r, const char *path, struct error *err)
{
    struct part found;
    if (r->prepared.hasty)
        return refuse_haste(err);
    FILE *file = part_open(path, &found, err);
    if (file == NULL)
        return false;
    const struct part before = r->part;
    if (r->by_parts)
        r->part = grown(r, found.end);
    struct part asked = r->part; /* the same picture, of however many samples */
    asked.planned = found.planned;
    bool ok = true;
    if (r->film.half != NULL && !found.halves && found.done + found.passes > 0)
        ok = error_set(err, "%s: it was made without --noise and cannot be continued with it", path);
    ok = ok && part_same(&found, path, &asked, err);
    if (ok && (found.first != r->part.first || found.end > r->part.end))
        ok = error_set(err, "%s: it is for the samples %ld:%ld, not %ld:%ld", path, found.first, found.end,
                       r->part.first, r->part.end);
    if (!ok) {
        fclose(file);
    } else if (!part_add(file, path, &found, &r->film, err)) {
        bool halves = r->film.half != NULL;
        ok = false;
        film_free(&r->film);
        begin_film(r, halves);
    }
    r->by_parts |= ok && found.end < r->part.end;
    part_free(&found);
    if (!ok)
        r->part = before;
    return ok;
}

bool state_save(const struct asbdpt *r, const char *path, struct error *err)
{
    const struct film *f = &r->film;
    struct film none = {.rect = f->rect};
    struct part part = grown(r, r->part.first + f->iterations + (f->passes > 0 ? f->block.iterations : 0));
    struct file_output file;
    if (!file_create(path, &file, err))
        return false;
    if (f->learnt_short)
        film_init(&none, f->rect, f->full_width, f->full_height);
    part_write(&file, &part, f->learnt_short ? &none : f);
    film_free(&none);
    return file_commit(&file, err);
}

void state_free(struct asbdpt *r)
{
    if (!r->open)
        return;
    part_free(&r->part);
    film_free(&r->film);
    method_release(&r->prepared);
    scene_free(&r->scene);
    r->open = false;
}

/* --- rendering ---------------------------------------------------------------------------------------- */

static void progress(void *context, double learnt, double done)
{
    const struct asbdpt *r = context;
    r->progress(r->context, learnt, done);
}

static enum cancel cancel(void *context)
{
    const struct asbdpt *r = context;
    int answer = r->cancel(r->context);
    return answer <= ASBDPT_CONTINUE ? CANCEL_NOT : answer == ASBDPT_END_BLOCK ? CANCEL_BLOCK : CANCEL_NOW;
}

/* Where so many samples more end: with a cycle of the filter, and with a block where the method says how long these are,
 * which shows when it is prepared. A block without an end is all of --spp. False with a message. */
static bool find_end(struct asbdpt *r, long samples, long *end, struct error *err)
{
    enum { LONG = 1 << 16 };
    struct film *f = &r->film;
    bool begun = f->iterations > 0 || f->passes > 0;
    if (r->prepared.tables == NULL)
        job_prepare(&r->job, &r->prepared);
    f->learnt_short |= r->prepared.hasty && !begun;
    if (r->prepared.hasty && !f->learnt_short)
        return refuse_haste(err);
    long block = r->prepared.size.block, unit = block > 0 && block < LONG ? block : filter_cycle(&r->scene.filter);
    *end = (r->part.first + f->iterations + samples + unit - 1) / unit * unit;
    if (block >= LONG && *end < r->part.end)
        *end = r->part.end;
    return true;
}

bool state_render(struct asbdpt *r, long samples, struct error *err)
{
    struct render_job *job = &r->job;
    const struct film *f = &r->film;
    long end = r->part.end;
    double had = film_samples(f), cpu = os_cpu_seconds(), wall = os_wall_seconds();
    bool more = true;
    job->progress = r->progress != NULL ? progress : NULL;
    job->cancel = r->cancel != NULL ? cancel : NULL;
    job->context = r;
    bool ok = !r->prepared.hasty || f->learnt_short || refuse_haste(err);
    ok = ok && (samples == 0 || find_end(r, samples, &end, err));
    while (ok && more) {
        bool within = f->passes > 0 && r->by_parts; /* a block that is incomplete ends where it was to end */
        job->first = r->part.first + f->iterations;
        job->end = within ? job->first + f->block.iterations : end;
        ok = render_scene(job, &r->prepared, &r->film, err);
        more = within && f->passes == 0 && r->part.first + f->iterations < end && job_cancelled(job) == CANCEL_NOT;
    }
    r->cpu += os_cpu_seconds() - cpu;
    r->wall += os_wall_seconds() - wall;
    r->samples += film_samples(f) - had;
    return ok;
}
