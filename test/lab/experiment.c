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
#include "lab/plan_scene.h"
#include "lab/timed.h"
#include "lab/compare.h"
#include "lab/pyramid.h"

enum { PATH_SIZE = 4096, KEY_SIZE = 1024, REFERENCE_SEED = 100001, PYRAMID_SPP = 64, PYRAMID_LENGTH = 5 };

/* The experiment under way; progress is counted in runs. */
struct experiment {
    const struct plan *plan;
    struct results *results;
    struct progress bar;
    double total, done, share; /* share: of the run that is going on */
    struct error *err;
};

/* A scene being measured. */
struct scene_experiment {
    struct experiment *whole;
    struct scene scene;
    struct scene_results *out;
    unsigned long probe[METHODS_MAX]; /* what the program makes of the scene, see timed_probe; 0: not asked yet */
};

static enum render_wish show_progress(void *context, double done)
{
    struct experiment *e = context;
    progress_update(&e->bar, (e->done + done * e->share) / e->total);
    return RENDER_GO_ON;
}

/* The scene's settings become the method's, without Russian roulette unless it asks for that: what is compared is the
 * choice of sub-paths alone. */
static void take_settings(struct scene *scene, const struct measured *m)
{
    struct settings base = {0};
    settings_set(&base, "rrthreshold", "0", "experiment");
    settings_clear(&scene->settings);
    scene->settings = measured_settings(m, &base);
    settings_clear(&base);
}

/* How a method is rendered; the scene's settings become the method's. */
static struct render_options options_of(struct scene_experiment *s, int method, long seed, long end)
{
    const struct plan *p = s->whole->plan;
    take_settings(&s->scene, &p->methods.item[method]);
    struct render_options o = {.integrator = p->methods.item[method].integrator, .seed = (uint64_t)seed, .end = end,
                               .n_threads = p->n_threads, .max_depth = s->out->max_depth};
    o.progress = show_progress;
    o.progress_context = s->whole;
    return o;
}

static void begin_film(const struct scene_experiment *s, struct film *film)
{
    film_init(film, render_crop(&s->scene), s->scene.width, s->scene.height);
}

/* --- files ------------------------------------------------------------------------------------------- */

static bool make_directories(const struct plan *p, struct error *err)
{
    static const char *const names[] = {"runs", "images", "plots"};
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
    return timed_checksum(pixels, r->width, r->height);
}

static unsigned long probe(struct scene_experiment *s, int method)
{
    struct render_options o = options_of(s, method, 0, 1);
    if (s->probe[method] == 0)
        s->probe[method] = timed_probe(&s->scene, &o);
    return s->probe[method];
}

/* The key of a run: everything its numbers depend on. */
static void run_key(struct scene_experiment *s, int method, int seed, char *out)
{
    const struct plan *p = s->whole->plan;
    const struct scene_results *r = s->out;
    int n = snprintf(out, KEY_SIZE, "%s %08lx %dx%d maxdepth=%d reference=%08lx %s seed=%ld spp=", r->name,
                     probe(s, method), r->width, r->height, r->max_depth, crc_of(r->reference.pixels, r),
                     p->methods.item[method].text, plan_seed(method, seed));
    for (int i = 0; i < p->n_steps && n < KEY_SIZE; i++)
        n += snprintf(out + n, (size_t)(KEY_SIZE - n), "%s%ld", i > 0 ? "," : "", p->spp[i]);
}

/* --- one run ----------------------------------------------------------------------------------------- */

static void measure(const struct scene_experiment *s, const struct film *film, long spp, double seconds,
                    struct run_step *out, float **pixels)
{
    free(*pixels);
    *pixels = timed_develop(&s->scene, film);
    struct difference d = compare_pixels(*pixels, s->out->reference.pixels, (long)s->out->width * s->out->height * 3);
    double blocks = compare_blocks(*pixels, s->out->reference.pixels, s->out->width, s->out->height);
    struct run_step step = {spp,
                            {seconds, d.rmse, d.rmse8, d.relmse, blocks, d.mean_ratio - 1},
                            d.nonfinite + film->nonfinite};
    *out = step;
}

/* What preparing the method takes, and the length of the blocks that its samples come in; 0: any. */
static bool prepare(struct scene_experiment *s, const struct render_options *o, double *seconds, int *block)
{
    struct render_job job;
    struct preparation prepared;
    double start = os_cpu_seconds();
    if (!render_prepare(&s->scene, o, render_crop(&s->scene), &job, &prepared, s->whole->err))
        return false;
    *block = prepared.size.block;
    method_release(&prepared);
    *seconds = os_cpu_seconds() - start;
    return true;
}

/* Render all steps of a run. Each continues the film of the one before, so only its own samples are rendered and timed,
 * unless that ends within a block of samples, which must not be cut. Preparing the method again for each is not part
 * of what a user would wait for: it is charged once. */
static bool render_steps(struct scene_experiment *s, int method, int seed, struct film *film, struct seed_run *run,
                         float **pixels)
{
    const struct plan *p = s->whole->plan;
    struct render_options o = options_of(s, method, plan_seed(method, seed), plan_last_spp(p));
    double before;
    int block;
    if (!prepare(s, &o, &before, &block))
        return false;
    double prepared = before;
    for (int i = 0; i < p->n_steps; i++) {
        struct timed took = {0};
        o.first = i > 0 && (block == 0 || p->spp[i - 1] % block == 0) ? p->spp[i - 1] : 0;
        o.end = p->spp[i];
        if (o.first == 0) {
            before = prepared;
            film_free(film);
            begin_film(s, film);
        }
        s->whole->share = (double)(o.end - o.first) / (double)plan_last_spp(p);
        if (!timed_film(&s->scene, &o, film, &took, s->whole->err))
            return false;
        before += fmax(took.seconds - prepared, 0);
        measure(s, film, o.end, before, &run->step[i], pixels);
    }
    run->n = p->n_steps;
    return true;
}

static void print_run(const struct scene_experiment *s, int method, int seed, const struct seed_run *run)
{
    const struct run_step *last = &run->step[run->n - 1];
    progress_end(&s->whole->bar);
    if (!s->whole->plan->quiet)
        fprintf(stderr, "%s, %s, seed %d: %ld spp in %.1f s of CPU, rmse8 %.3f\n", s->out->name,
                s->whole->plan->methods.item[method].text, seed, last->spp, last->value[Q_SECONDS],
                last->value[Q_RMSE8]);
}

/* The picture of the first seed goes into a file, and is kept. */
static bool render_run(struct scene_experiment *s, int method, int seed, const char *file, const char *key,
                       const char *picture)
{
    struct seed_run *run = &s->out->run[method][seed - 1];
    float *pixels = NULL;
    struct film film;
    begin_film(s, &film);
    bool ok = render_steps(s, method, seed, &film, run, &pixels) &&
              (picture == NULL || image_write(picture, s->out->width, s->out->height, pixels, s->whole->err)) &&
              run_write(file, key, run, s->whole->err);
    if (ok)
        print_run(s, method, seed, run);
    if (picture != NULL)
        s->out->image[method] = pixels;
    else
        free(pixels);
    film_free(&film);
    return ok;
}

/* The picture of an earlier run, if it is there. */
static float *read_picture(const struct scene_experiment *s, const char *path)
{
    int w, h;
    float *pixels = image_read_linear(path, &w, &h, NULL, NULL);
    if (pixels == NULL || (w == s->out->width && h == s->out->height))
        return pixels;
    free(pixels);
    return NULL;
}

/* A run kept by an earlier start, or a new one. */
static bool read_or_render_run(struct scene_experiment *s, int method, int seed)
{
    const struct plan *p = s->whole->plan;
    const char *name = p->methods.item[method].file;
    char file[PATH_SIZE], picture[PATH_SIZE], key[KEY_SIZE];
    bool wants_picture = method < p->n_compared && seed == 1;
    snprintf(file, sizeof file, "%s/runs/%s--%s--seed%d.csv", p->directory, s->out->name, name, seed);
    snprintf(picture, sizeof picture, "%s/images/%s-%s.pfm", p->directory, s->out->name, name);
    s->whole->share = 0;
    run_key(s, method, seed, key);
    bool ok = (run_read(file, key, p->n_steps, &s->out->run[method][seed - 1]) &&
               (!wants_picture || (s->out->image[method] = read_picture(s, picture)) != NULL)) ||
              render_run(s, method, seed, file, key, wants_picture ? picture : NULL);
    s->whole->done++;
    return ok;
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* The stored reference, or one kept by an earlier start, or a new one. */
static bool make_reference(struct scene_experiment *s)
{
    const struct plan *p = s->whole->plan;
    struct scene_results *r = s->out;
    char key[KEY_SIZE], directory[PATH_SIZE];
    struct measured m = {.text = METHOD_REFERENCE};
    struct render_options o = {.integrator = METHOD_REFERENCE, .seed = REFERENCE_SEED, .n_threads = p->n_threads,
                               .max_depth = r->max_depth};
    if (r->reference.pixels != NULL)
        return true;
    snprintf(directory, sizeof directory, "%s/reference", p->directory);
    snprintf(key, sizeof key, "%s %08lx %dx%d maxdepth=%d %s spp=%ld", r->name, probe(s, 0), r->width, r->height,
             r->max_depth, o.integrator, p->reference_spp);
    take_settings(&s->scene, &m);
    return reference_make(&s->scene, &o, p->reference_spp, directory, r->name, key, &r->reference, s->whole->err);
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

/* Seeds come before methods, so that a machine that slows down in between slows down all alike. */
static bool all_runs(struct scene_experiment *s)
{
    const struct plan *p = s->whole->plan;
    for (int seed = 1; seed <= p->n_seeds; seed++)
        for (int v = 0; v < p->methods.n; v++)
            if (seed <= plan_seeds(p, v) && !read_or_render_run(s, v, seed))
                return false;
    return true;
}

/* All strategies of bdpt, of few samples: what they are is to be seen, not their noise. */
static bool render_pyramid(struct scene_experiment *s)
{
    const struct plan *p = s->whole->plan;
    struct measured m = {.text = METHOD_REFERENCE};
    struct render_options o = {.integrator = METHOD_REFERENCE, .n_threads = p->n_threads};
    struct strategy_images images;
    char path[PATH_SIZE];
    o.end = plan_last_spp(p) < PYRAMID_SPP ? plan_last_spp(p) : PYRAMID_SPP;
    o.max_depth = s->out->max_depth < PYRAMID_LENGTH ? s->out->max_depth : PYRAMID_LENGTH;
    take_settings(&s->scene, &m);
    strategies_init(&images, render_crop(&s->scene), o.max_depth);
    snprintf(path, sizeof path, "%s/images/%s-strategies.png", p->directory, s->out->name);
    bool ok = strategies_render(&s->scene, &o, &images, s->whole->err) &&
              pyramid_write(path, &images, s->scene.film_scale, s->whole->err);
    strategies_free(&images);
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
        plan_name(p, i, s->name);
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
    for (int v = 0; v < plan->methods.n; v++)
        e.total += plan->n_scenes * plan_seeds(plan, v);
    progress_start(&e.bar, plan->quiet);
    bool ok = true;
    for (int i = 0; ok && i < plan->n_scenes; i++)
        ok = measure_scene(&e, i);
    progress_end(&e.bar);
    return ok;
}
