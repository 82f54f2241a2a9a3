/* equal_run.c: see equal_run.h. */
#include "lab/equal_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/progress.h"
#include "image/image.h"
#include "lab/sheet.h"
#include "lab/plan_scene.h"
#include "lab/timed.h"
#include "lab/compare.h"

enum { CORRECTIONS = 3, REFERENCE_SEED = 100001 };

/* --- one method and seed ----------------------------------------------------------------------------- */

static enum render_wish show_progress(void *context, double done)
{
    const struct subject *s = context;
    progress_update(s->bar, s->done + s->share * done);
    return RENDER_GO_ON;
}

bool subject_render(struct subject *s, const struct measured *m, struct equal_render *r, float **pixels,
                    struct error *err)
{
    const struct reference *ref = &s->reference;
    struct render_options o = {.integrator = m->integrator, .seed = (uint64_t)r->seed, .end = r->spp,
                               .n_threads = s->n_threads, .max_depth = s->max_depth};
    struct timed took;
    if (s->bar != NULL && r->spp > EQUAL_CALIBRATION) {
        o.progress = show_progress;
        o.progress_context = s;
    }
    settings_clear(&s->scene.settings);
    s->scene.settings = measured_settings(m, NULL);
    if (!timed_render(&s->scene, &o, &took, err))
        return false;
    float *small = sheet_shrink(took.pixels, s->scene.width, s->scene.height, s->scale);
    struct difference d = compare_pixels(small, ref->pixels, 3L * ref->width * ref->height);
    r->blocks = compare_blocks(small, ref->pixels, ref->width, ref->height);
    r->shown_blocks = compare_shown_blocks(small, ref->pixels, ref->width, ref->height);
    free(small);
    r->seconds = took.seconds;
    r->rmse8 = d.rmse8;
    r->relmse = d.relmse;
    r->nonfinite = d.nonfinite + took.nonfinite;
    if (pixels != NULL) {
        free(*pixels);
        *pixels = took.pixels;
    } else {
        free(took.pixels);
    }
    return true;
}

static double off(const struct equal_render *r) { return fabs(r->seconds / r->target - 1); }

/* The samples are chosen by the calibration's time, then by the times they took. The nearest counts. */
bool subject_render_in_time(struct subject *s, const struct measured *m, struct equal_render *r, float **pixels,
                            struct error *err)
{
    struct equal_render first = *r, trial = *r;
    first.spp = EQUAL_CALIBRATION;
    if (!subject_render(s, m, &first, NULL, err))
        return false;
    long spp = equal_samples(first.spp, first.seconds, 1, r->target);
    trial.spp = 0;
    for (int i = 0; i <= CORRECTIONS && spp != trial.spp && !(i > 0 && equal_met(r->seconds, r->target)); i++) {
        float *picture = NULL;
        trial.spp = spp;
        if (!subject_render(s, m, &trial, &picture, err))
            return false;
        trial.growth = equal_growth(first.spp, first.seconds, trial.spp, trial.seconds);
        if (i == 0 || off(&trial) < off(r)) {
            *r = trial;
            if (pixels != NULL) {
                float *worse = *pixels;
                *pixels = picture;
                picture = worse;
            }
        }
        free(picture);
        spp = equal_samples(trial.spp, trial.seconds, trial.growth, trial.target);
    }
    return true;
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* A scene of the whole. */
struct part {
    struct equal_time *whole;
    struct equal_scene *out;
    struct subject subject;
    unsigned long probe[METHODS_MAX]; /* what the program makes of the scene, see timed_probe; 0: not asked yet */
    struct progress *bar;
    struct error *err;
};

/* The key of a render: everything its numbers depend on. */
static void render_key(struct part *s, int method, const struct equal_render *r, char key[EQUAL_KEY])
{
    const struct measured *m = &s->whole->plan->methods.item[method];
    const struct reference *ref = &s->subject.reference;
    struct render_options o = {.integrator = m->integrator, .n_threads = 1, .max_depth = s->out->max_depth};
    settings_clear(&s->subject.scene.settings);
    s->subject.scene.settings = measured_settings(m, NULL);
    if (s->probe[method] == 0)
        s->probe[method] = timed_probe(&s->subject.scene, &o);
    snprintf(key, EQUAL_KEY, "%s %08lx %dx%d maxdepth=%d reference=%08lx %s seed=%ld spp=%ld target=%.17g",
             s->out->name, s->probe[method], s->out->width, s->out->height, s->out->max_depth,
             timed_checksum(ref->pixels, ref->width, ref->height), m->text, r->seed, r->spp, r->target);
}

/* The first method's samples are given unless its time is; what it takes for them is the time of this seed. A short
 * render before it warms up what it will use. */
static bool render(struct part *s, int method, struct equal_render *r, float **pixels)
{
    const struct measured *m = &s->whole->plan->methods.item[method];
    struct equal_render warm = {.seed = r->seed, .spp = EQUAL_CALIBRATION};
    if (r->spp == 0)
        return subject_render_in_time(&s->subject, m, r, pixels, s->err);
    r->growth = 1;
    bool ok = subject_render(&s->subject, m, &warm, NULL, s->err) && subject_render(&s->subject, m, r, pixels, s->err);
    r->target = r->seconds;
    return ok;
}

static bool keep_picture(const struct part *s, int method, const float *pixels)
{
    char path[4096];
    equal_picture(s->whole, s->out, method, path, sizeof path);
    return image_write(path, s->out->width, s->out->height, pixels, s->err);
}

/* One kept by an earlier start, or a new one. */
static bool measure(struct part *s, int method, int seed)
{
    const struct plan *p = s->whole->plan;
    const struct measured *m = &p->methods.item[method];
    struct equal_render *r = &s->out->render[method][seed - 1];
    char key[EQUAL_KEY], file[4096];
    float *pixels = NULL;
    bool given = method > 0 || s->whole->seconds > 0, kept = s->whole->pictures && seed == 1;
    r->seed = equal_seed(method, seed);
    r->spp = given ? 0 : plan_last_spp(p);
    r->target = s->whole->seconds > 0 ? s->whole->seconds : given ? s->out->render[0][seed - 1].seconds : 0;
    render_key(s, method, r, key);
    snprintf(file, sizeof file, "%s/runs/%s--%s--seed%d.csv", p->directory, s->out->name, m->file, seed);
    if (equal_recall(file, key, r))
        return true;
    bool ok = render(s, method, r, kept ? &pixels : NULL) && (!kept || keep_picture(s, method, pixels)) &&
              equal_keep(file, key, r, s->err);
    free(pixels);
    progress_end(s->bar);
    if (ok && !p->quiet)
        fprintf(stderr, "%s, %s, seed %ld: %ld spp in %.3f s of CPU for %.3f s, rmse8 %.3f, relmse %.4f\n",
                s->out->name, m->text, r->seed, r->spp, r->seconds, r->target, r->rmse8, r->relmse);
    return ok;
}

static bool load_scene(struct part *s)
{
    const struct plan *p = s->whole->plan;
    struct subject *subject = &s->subject;
    subject->scale = subject->n_threads = 1;
    if (!plan_scene_load(p, s->out->path, s->out->name, &subject->scene, &subject->max_depth, &subject->reference,
                         s->err))
        return false;
    s->out->width = subject->scene.width;
    s->out->height = subject->scene.height;
    s->out->max_depth = subject->max_depth;
    return true;
}

/* Where no reference is stored, one is rendered. */
static bool find_reference(struct part *s)
{
    const struct plan *p = s->whole->plan;
    struct subject *subject = &s->subject;
    struct render_options o = {.integrator = METHOD_REFERENCE, .seed = REFERENCE_SEED, .n_threads = p->n_threads,
                               .max_depth = subject->max_depth};
    char key[400], directory[4096];
    snprintf(directory, sizeof directory, "%s/reference", p->directory);
    snprintf(key, sizeof key, "%s %dx%d maxdepth=%d spp=%ld", s->out->name, s->out->width, s->out->height,
             subject->max_depth, p->reference_spp);
    settings_clear(&subject->scene.settings);
    bool ok = subject->reference.pixels != NULL ||
              reference_make(&subject->scene, &o, p->reference_spp, directory, s->out->name, key, &subject->reference,
                             s->err);
    s->out->noise8 = subject->reference.noise8;
    return ok;
}

/* How long it will take, before anything that takes long: by what the first method takes for a few samples. */
static bool announce(struct part *s)
{
    const struct plan *p = s->whole->plan;
    struct render_options o = {.integrator = p->methods.item[0].integrator, .end = EQUAL_CALIBRATION, .n_threads = 1,
                               .max_depth = s->out->max_depth};
    int n = p->n_seeds * p->methods.n;
    struct timed took;
    char all[32];
    settings_clear(&s->subject.scene.settings);
    s->subject.scene.settings = measured_settings(&p->methods.item[0], NULL);
    if (p->quiet)
        return true;
    if (!timed_render(&s->subject.scene, &o, &took, s->err))
        return false;
    free(took.pixels);
    double sample = took.seconds / EQUAL_CALIBRATION; /* of each pixel */
    double each = s->whole->seconds > 0 ? s->whole->seconds : sample * (double)plan_last_spp(p);
    double reference = s->subject.reference.pixels != NULL ? 0 : sample * (double)p->reference_spp;
    progress_duration(n * each * 1.5 + reference, all, sizeof all); /* 1.5: half of them are rendered twice */
    fprintf(stderr, "%s, %dx%d: %d renders of %.2g s%s; some %s of CPU in all, unless some are kept from before\n",
            s->out->name, s->out->width, s->out->height, n, each, reference > 0 ? " and a reference" : "", all);
    return true;
}

/* Seeds come before methods, so that a machine that slows down slows down all alike. */
static bool measure_scene(struct part *s, double done)
{
    const struct plan *p = s->whole->plan;
    int methods = p->methods.n, n = p->n_seeds * methods;
    bool ok = announce(s) && find_reference(s) &&
              (!s->whole->pictures || keep_picture(s, -1, s->subject.reference.pixels));
    for (int i = 0; ok && i < n; i++) {
        s->subject.bar = s->bar;
        s->subject.done = (done + (double)i / n) / p->n_scenes;
        s->subject.share = 1.0 / n / p->n_scenes;
        progress_update(s->bar, s->subject.done);
        ok = measure(s, i % methods, i / methods + 1);
    }
    scene_free(&s->subject.scene);
    return ok;
}

static bool make_directories(const struct equal_time *e, struct error *err)
{
    char path[4096];
    bool ok = file_make_directory(e->plan->directory, err);
    for (int i = 0; ok && i < 1 + e->pictures; i++) {
        snprintf(path, sizeof path, "%s/%s", e->plan->directory, i == 0 ? "runs" : "images");
        ok = file_make_directory(path, err);
    }
    return ok;
}

bool equal_run(struct equal_time *out, struct error *err)
{
    const struct plan *p = out->plan;
    struct progress bar;
    bool ok = plan_names_differ(p, err) && make_directories(out, err);
    out->scene = mem_alloc((size_t)p->n_scenes, sizeof *out->scene);
    progress_start(&bar, p->quiet);
    for (out->n_scenes = 0; ok && out->n_scenes < p->n_scenes;) {
        struct part s = {.whole = out, .out = &out->scene[out->n_scenes], .bar = &bar, .err = err};
        s.out->path = p->scene[out->n_scenes];
        plan_name(p, out->n_scenes, s.out->name);
        ok = load_scene(&s) && measure_scene(&s, out->n_scenes);
        reference_free(&s.subject.reference);
        out->n_scenes += ok;
        ok = ok && equal_write(out, err);
    }
    progress_end(&bar);
    return ok;
}
