/* equal_run.c: see equal_run.h. */
#include "lab/equal_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "look/compare.h"
#include "lab/plan_scene.h"
#include "render/render.h"

enum { CORRECTIONS = 3, REFERENCE_SEED = 100001 };

/* A scene being measured. */
struct subject {
    struct equal_time *whole;
    struct equal_scene *out;
    struct scene scene;
    struct reference reference;
    struct progress *bar;
    struct error *err;
};

/* --- one render -------------------------------------------------------------------------------------- */

static struct render_options options_of(struct subject *s, int variant, long seed)
{
    const struct variant *v = &EQUAL_VARIANTS[variant];
    struct render_options o = {.integrator = v->integrator, .seed = (uint64_t)seed, .n_threads = 1};
    settings_clear(&s->scene.settings); /* defaults: what is compared is what a user gets */
    if (v->select != NULL)
        settings_set(&s->scene.settings, "select", v->select, "experiment");
    o.max_depth = s->out->max_depth;
    return o;
}

static void compare_film(const struct subject *s, const struct film *film, struct equal_render *out)
{
    size_t n = (size_t)s->out->width * (size_t)s->out->height * 3;
    float *pixels = mem_alloc(n, sizeof *pixels);
    film_develop(film, s->scene.film_scale, pixels);
    struct difference d = compare_pixels(pixels, s->reference.pixels, (long)n);
    out->rmse8 = d.rmse8;
    out->relmse = d.relmse;
    out->nonfinite = d.nonfinite + film->nonfinite;
    free(pixels);
}

/* Render so many samples, take the time, compare. */
static bool render_samples(struct subject *s, int variant, long spp, struct equal_render *out)
{
    struct film film;
    struct render_options o = options_of(s, variant, out->seed);
    o.end = out->spp = spp;
    film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
    double start = os_cpu_seconds();
    bool ok = render_scene(&s->scene, &o, &film, s->err);
    out->seconds = fmax(os_cpu_seconds() - start, 1e-6);
    if (ok)
        compare_film(s, &film, out);
    film_free(&film);
    return ok;
}

/* --- one variant and seed ---------------------------------------------------------------------------- */

static double off(const struct equal_render *r) { return fabs(r->seconds / r->target - 1); }

/* The samples that take r->target: by the calibration's time, then by the times they took. The nearest counts. */
static bool render_in_time(struct subject *s, int variant, const struct equal_render *calibration,
                           struct equal_render *r)
{
    struct equal_render trial = *r;
    long spp = equal_samples(calibration->spp, calibration->seconds, 1, r->target);
    for (int i = 0; i <= CORRECTIONS && spp != trial.spp; i++) {
        if (!render_samples(s, variant, spp, &trial))
            return false;
        trial.growth = equal_growth(calibration->spp, calibration->seconds, trial.spp, trial.seconds);
        if (i == 0 || off(&trial) < off(r))
            *r = trial;
        if (equal_met(r->seconds, r->target))
            break;
        spp = equal_samples(trial.spp, trial.seconds, trial.growth, trial.target);
    }
    return true;
}

/* bdpt's samples are given unless its time is; what it takes for them is the time of this seed. */
static bool measure_variant(struct subject *s, int variant, int seed)
{
    const struct plan *p = s->whole->plan;
    struct equal_render *r = &s->out->render[variant][seed - 1], calibration = {.seed = equal_seed(variant, seed)};
    if (!render_samples(s, variant, EQUAL_CALIBRATION, &calibration)) /* also warms up what the next will use */
        return false;
    r->seed = calibration.seed;
    r->target = s->whole->seconds > 0 ? s->whole->seconds : s->out->render[0][seed - 1].target;
    bool ok;
    if (variant == 0 && s->whole->seconds == 0) {
        ok = render_samples(s, variant, plan_last_spp(p), r);
        r->target = r->seconds;
        r->growth = 1;
    } else {
        ok = render_in_time(s, variant, &calibration, r);
    }
    progress_end(s->bar);
    if (ok && !p->quiet)
        fprintf(stderr, "%s, %s, seed %ld: %ld spp in %.3f s of CPU for %.3f s, rmse8 %.3f, relmse %.4f\n",
                s->out->name, EQUAL_VARIANTS[variant].label, r->seed, r->spp, r->seconds, r->target, r->rmse8,
                r->relmse);
    return ok;
}

/* --- scenes ------------------------------------------------------------------------------------------ */

static bool load_scene(struct subject *s)
{
    struct equal_scene *out = s->out;
    if (!plan_scene_load(s->whole->plan, out->path, out->name, &s->scene, &out->max_depth, &s->reference, s->err))
        return false;
    out->width = s->scene.width;
    out->height = s->scene.height;
    return true;
}

/* Where no reference is stored, one is rendered. */
static bool make_reference(struct subject *s)
{
    struct render_options o = options_of(s, 0, REFERENCE_SEED);
    bool ok = s->reference.pixels != NULL ||
              reference_render(&s->scene, &o, s->whole->plan->reference_spp, &s->reference, s->err);
    s->out->noise8 = s->reference.noise8;
    return ok;
}

/* Seeds come before variants, so that a machine that slows down slows down all alike. */
static bool measure_scene(struct subject *s, double done)
{
    int n = s->whole->plan->n_seeds * N_EQUAL, scenes = s->whole->plan->n_scenes;
    bool ok = make_reference(s);
    for (int i = 0; ok && i < n; i++) {
        progress_update(s->bar, (done + (double)i / n) / scenes);
        ok = measure_variant(s, i % N_EQUAL, i / N_EQUAL + 1);
    }
    scene_free(&s->scene);
    return ok;
}

bool equal_run(struct equal_time *out, struct error *err)
{
    const struct plan *p = out->plan;
    struct progress bar;
    bool ok = plan_names_differ(p, err) && file_make_directory(p->directory, err);
    out->scene = mem_alloc((size_t)p->n_scenes, sizeof *out->scene);
    progress_start(&bar, p->quiet);
    for (out->n_scenes = 0; ok && out->n_scenes < p->n_scenes;) {
        struct subject s = {.whole = out, .out = &out->scene[out->n_scenes], .bar = &bar, .err = err};
        s.out->path = p->scene[out->n_scenes];
        plan_scene_name(s.out->path, s.out->name, sizeof s.out->name);
        ok = load_scene(&s) && measure_scene(&s, out->n_scenes);
        reference_free(&s.reference);
        out->n_scenes += ok;
        ok = ok && equal_write(out, err);
    }
    progress_end(&bar);
    return ok;
}
