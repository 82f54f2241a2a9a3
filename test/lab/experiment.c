/* experiment.c: see experiment.h. */
#include "lab/experiment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "image/image.h"
#include "image/zlib.h"
#include "look/compare.h"
#include "lab/plan_scene.h"
#include "look/pyramid.h"

enum { PATH_SIZE = 4096, KEY_SIZE = 1024, REFERENCE_SEED = 100001, PYRAMID_SPP = 64, PYRAMID_LENGTH = 5 };

/* The experiment under way, and the share of it that is done; in samples per pixel, scenes being of similar size. */
struct experiment {
    const struct plan *plan;
    struct results *results;
    struct progress bar;
    double total, done, current; /* current: samples of the render that is going on */
    struct error *err;
};

/* A scene being measured. */
struct scene_experiment {
    struct experiment *whole;
    struct scene scene;
    struct scene_results *out;
    unsigned long probe[N_VARIANTS]; /* what the program makes of the scene, see probe_variant; 0: not asked yet */
};

static bool show_progress(void *context, double done)
{
    struct experiment *e = context;
    return progress_update(&e->bar, (e->done + done * e->current) / fmax(e->total, 1));
}

/* Work found done already counts neither as done nor as to be done, so that the time left comes out right. */
static void skip_work(struct experiment *e, double spp) { e->total -= spp; }

static void finish_work(struct experiment *e, double spp)
{
    e->done += spp;
    e->current = 0;
}

/* How a variant is rendered; the scene's settings become the variant's. */
static struct render_options options_of(struct scene_experiment *s, int variant, long seed, long end)
{
    variant_settings(&VARIANTS[variant], &s->scene.settings);
    struct render_options o = {
        .integrator = VARIANTS[variant].integrator, .seed = (uint64_t)seed, .end = end};
    o.n_threads = s->whole->plan->n_threads;
    o.max_depth = s->out->max_depth;
    o.progress = show_progress;
    o.progress_context = s->whole;
    return o;
}

static void begin_film(const struct scene_experiment *s, struct film *film)
{
    film_init(film, render_crop(&s->scene), s->scene.width, s->scene.height);
}

static float *new_pixels(const struct scene_results *r)
{
    return mem_alloc((size_t)r->width * (size_t)r->height * 3, sizeof(float));
}

/* --- files ------------------------------------------------------------------------------------------- */

static bool make_directories(const struct plan *p, struct error *err)
{
    static const char *const names[] = {"runs", "images", "reference", "plots"};
    char path[PATH_SIZE];
    bool ok = file_make_directory(p->directory, err);
    for (size_t i = 0; ok && i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", p->directory, names[i]);
        ok = file_make_directory(path, err);
    }
    return ok;
}

static unsigned long crc_of(const float *pixels, const struct scene_results *r)
{
    return checksum_crc32(0, (const uint8_t *)pixels, (size_t)r->width * (size_t)r->height * 3 * sizeof *pixels);
}

/* Checksum of a picture of one sample per pixel: it changes when the scene, its files or the program do, so that
 * results of another scene or another version of an integrator are not taken for this one's. 0 when it cannot be
 * rendered, which the run itself will report. */
static unsigned long probe_variant(struct scene_experiment *s, int variant)
{
    struct film film;
    if (s->probe[variant] != 0)
        return s->probe[variant];
    struct render_options o = options_of(s, variant, 0, 1);
    begin_film(s, &film);
    if (render_scene(&s->scene, &o, &film, NULL)) {
        float *pixels = new_pixels(s->out);
        film_develop(&film, s->scene.film_scale, pixels);
        s->probe[variant] = crc_of(pixels, s->out);
        free(pixels);
    }
    film_free(&film);
    return s->probe[variant];
}

/* The key of a run: everything its numbers depend on. */
static void run_key(struct scene_experiment *s, int variant, int seed, char *out)
{
    const struct variant *v = &VARIANTS[variant];
    const struct scene_results *r = s->out;
    int n = snprintf(out, KEY_SIZE,
                     "%s %08lx %dx%d maxdepth=%d reference=%08lx %s paths=%d restart=%d seed=%ld spp=", r->name,
                     probe_variant(s, variant), r->width, r->height, r->max_depth, crc_of(r->reference.pixels, r),
                     v->name, v->bin_paths, v->restart, plan_seed(variant, seed));
    for (int i = 0; i < s->whole->plan->n_steps && n < KEY_SIZE; i++)
        n += snprintf(out + n, (size_t)(KEY_SIZE - n), "%s%ld", i > 0 ? "," : "", s->whole->plan->spp[i]);
}

/* --- one run ----------------------------------------------------------------------------------------- */

static bool timed_render(struct scene_experiment *s, struct render_options *o, struct film *film, double *seconds)
{
    double start = os_cpu_seconds();
    bool ok = render_scene(&s->scene, o, film, s->whole->err);
    *seconds = os_cpu_seconds() - start;
    return ok;
}

static void measure(const struct scene_experiment *s, const struct film *film, long spp, double seconds,
                    struct run_step *out, float *pixels)
{
    film_develop(film, s->scene.film_scale, pixels);
    struct difference d = compare_pixels(pixels, s->out->reference.pixels, (long)s->out->width * s->out->height * 3);
    struct run_step step = {spp,
                            {seconds, d.rmse, d.rmse8, d.relmse, d.mean_ratio - 1},
                            d.nonfinite + film->nonfinite};
    *out = step;
}

/* Render all steps of a run. Each continues the film of an earlier one where the integrator allows it, so only its own
 * samples are rendered and timed. Preparing the integrator again for each is not part of what a user would wait for: an
 * empty render measures it, and it is charged once. */
static bool render_steps(struct scene_experiment *s, int variant, int seed, struct film *film, struct seed_run *run,
                         float *pixels)
{
    const struct plan *p = s->whole->plan;
    struct render_options o = options_of(s, variant, plan_seed(variant, seed), 0);
    double prepare, seconds;
    if (!timed_render(s, &o, film, &prepare))
        return false;
    for (int i = 0; i < p->n_steps; i++) {
        o.first = plan_first_sample(p, variant, i);
        o.end = p->spp[i];
        if (o.first == 0) {
            film_free(film);
            begin_film(s, film);
        }
        s->whole->current = (double)(o.end - o.first);
        if (!timed_render(s, &o, film, &seconds))
            return false;
        double before = o.first > 0 ? run->step[i - 1].value[Q_SECONDS] : prepare;
        measure(s, film, o.end, before + fmax(seconds - prepare, 0), &run->step[i], pixels);
        finish_work(s->whole, (double)(o.end - o.first));
    }
    run->n = p->n_steps;
    return true;
}

static void print_run(const struct scene_experiment *s, int variant, int seed, const struct seed_run *run)
{
    const struct run_step *last = &run->step[run->n - 1];
    progress_end(&s->whole->bar);
    if (!s->whole->plan->quiet)
        fprintf(stderr, "%s, %s, seed %d: %ld spp in %.1f s of CPU, rmse8 %.3f\n", s->out->name,
                VARIANTS[variant].label, seed, last->spp, last->value[Q_SECONDS], last->value[Q_RMSE8]);
}

static bool render_run(struct scene_experiment *s, int variant, int seed, const char *file, const char *key,
                       const char *picture)
{
    struct seed_run *run = &s->out->run[variant][seed - 1];
    float *pixels = new_pixels(s->out);
    struct film film;
    begin_film(s, &film);
    bool ok = render_steps(s, variant, seed, &film, run, pixels) &&
              (picture == NULL || image_write(picture, s->out->width, s->out->height, pixels, s->whole->err)) &&
              run_write(file, key, run, s->whole->err);
    if (ok)
        print_run(s, variant, seed, run);
    if (picture != NULL)
        s->out->image[variant] = pixels;
    else
        free(pixels);
    film_free(&film);
    return ok;
}

/* The picture of an earlier run, if it is there. */
static float *read_picture(const struct scene_experiment *s, const char *path)
{
    int w, h;
    float *pixels = load_linear(path, &w, &h, NULL, NULL);
    if (pixels == NULL || (w == s->out->width && h == s->out->height))
        return pixels;
    free(pixels);
    return NULL;
}

/* A run kept by an earlier start, or a new one. */
static bool read_or_render_run(struct scene_experiment *s, int variant, int seed)
{
    const struct plan *p = s->whole->plan;
    char file[PATH_SIZE], picture[PATH_SIZE], key[KEY_SIZE];
    bool wants_picture = variant < N_COMPARED && seed == 1;
    snprintf(file, sizeof file, "%s/runs/%s--%s--seed%d.csv", p->directory, s->out->name, VARIANTS[variant].name, seed);
    snprintf(picture, sizeof picture, "%s/images/%s-%s.pfm", p->directory, s->out->name, VARIANTS[variant].name);
    run_key(s, variant, seed, key);
    if (run_read(file, key, p->n_steps, &s->out->run[variant][seed - 1]) &&
        (!wants_picture || (s->out->image[variant] = read_picture(s, picture)) != NULL)) {
        skip_work(s->whole, (double)plan_run_spp(p, variant));
        return true;
    }
    return render_run(s, variant, seed, file, key, wants_picture ? picture : NULL);
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* The stored reference, or one kept by an earlier start, or a new one. */
static bool make_reference(struct scene_experiment *s)
{
    const struct plan *p = s->whole->plan;
    struct scene_results *r = s->out;
    char key[KEY_SIZE], directory[PATH_SIZE];
    if (r->reference.pixels != NULL) {
        skip_work(s->whole, (double)p->reference_spp);
        return true;
    }
    snprintf(directory, sizeof directory, "%s/reference", p->directory);
    snprintf(key, sizeof key, "%s %08lx %dx%d maxdepth=%d bdpt spp=%ld", r->name, probe_variant(s, VARIANT_BDPT),
             r->width, r->height, r->max_depth, p->reference_spp);
    if (reference_read(directory, r->name, key, &r->reference) &&
        reference_fit(&r->reference, r->width, r->height, r->max_depth, NULL)) {
        skip_work(s->whole, (double)p->reference_spp);
        return true;
    }
    reference_free(&r->reference);
    struct render_options o = options_of(s, VARIANT_BDPT, REFERENCE_SEED, 0);
    s->whole->current = (double)p->reference_spp;
    if (!reference_render(&s->scene, &o, p->reference_spp, &r->reference, s->whole->err))
        return false;
    finish_work(s->whole, (double)p->reference_spp);
    return reference_write(&r->reference, directory, r->name, key, s->whole->err);
}

static bool load_scene(struct scene_experiment *s)
{
    struct scene_results *r = s->out;
    if (!plan_scene_load(s->whole->plan, r->path, r->name, &s->scene, &r->max_depth, &r->reference, s->whole->err))
        return false;
    r->width = s->scene.width;
    r->height = s->scene.height;
    return true;
}

/* Seeds come before variants, so that a machine that slows down in between slows down all alike. */
static bool all_runs(struct scene_experiment *s)
{
    for (int seed = 1; seed <= s->whole->plan->n_seeds; seed++)
        for (int v = 0; v < N_VARIANTS; v++)
            if (seed <= plan_seeds(s->whole->plan, v) && !read_or_render_run(s, v, seed))
                return false;
    return true;
}

/* All strategies of bdpt, of few samples: what they are is to be seen, not their noise. */
static bool render_pyramid(struct scene_experiment *s)
{
    const struct plan *p = s->whole->plan;
    struct render_options o = options_of(s, VARIANT_BDPT, 0, plan_last_spp(p));
    struct film film;
    char path[PATH_SIZE];
    o.end = o.end < PYRAMID_SPP ? o.end : PYRAMID_SPP;
    o.max_depth = o.max_depth < PYRAMID_LENGTH ? o.max_depth : PYRAMID_LENGTH;
    begin_film(s, &film);
    film_keep_strategies(&film, o.max_depth);
    snprintf(path, sizeof path, "%s/images/%s-strategies.png", p->directory, s->out->name);
    bool ok = render_scene(&s->scene, &o, &film, s->whole->err) &&
              pyramid_write(path, &film, s->scene.film_scale, s->whole->err);
    film_free(&film);
    return ok;
}

static bool measure_scene(struct experiment *e, int number)
{
    struct scene_experiment s = {.whole = e, .out = &e->results->scene[number]};
    if (!load_scene(&s))
        return false;
    bool ok = make_reference(&s) && all_runs(&s) && render_pyramid(&s);
    scene_free(&s.scene);
    return ok;
}

/* --- the whole --------------------------------------------------------------------------------------- */

static void name_scenes(const struct plan *p, struct results *r)
{
    for (int i = 0; i < p->n_scenes; i++) {
        struct scene_results *s = &r->scene[i];
        s->plan = p;
        s->path = p->scene[i];
        plan_scene_name(s->path, s->name, sizeof s->name);
    }
}

bool experiment_run(const struct plan *plan, struct results *out, struct error *err)
{
    struct experiment e = {.plan = plan, .results = out, .err = err};
    out->plan = plan;
    out->scene = mem_alloc((size_t)plan->n_scenes, sizeof *out->scene);
    name_scenes(plan, out);
    if (!plan_names_differ(plan, err) || !make_directories(plan, err))
        return false;
    for (int v = 0; v < N_VARIANTS; v++)
        e.total += (double)(plan_seeds(plan, v) * plan_run_spp(plan, v));
    e.total = plan->n_scenes * (e.total + (double)plan->reference_spp);
    progress_start(&e.bar, plan->quiet);
    bool ok = true;
    for (int i = 0; ok && i < plan->n_scenes; i++)
        ok = measure_scene(&e, i);
    progress_end(&e.bar);
    return ok;
}
