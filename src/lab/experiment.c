/* experiment.c: see experiment.h. */
#define _POSIX_C_SOURCE 200809L

#include "lab/experiment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#include "image/zlib.h"
#include "lab/compare.h"
#include "image/image.h"
#include "base/mem.h"
#include "parser/parser.h"
#include "base/progress.h"

enum { PATH_SIZE = 4096, KEY_SIZE = 1024, REFERENCE_SEED = 100001 };

/* What is being done, and the share of it that is done; in samples per pixel, scenes being of similar size. */
struct desk {
    const struct plan *plan;
    struct results *results;
    struct progress bar;
    double total, done, current; /* current: samples of the render that is going on */
    struct error *err;
};

/* A scene being measured. */
struct stage {
    struct desk *desk;
    struct scene scene;
    struct scene_results *out;
    unsigned long probe[N_VARIANTS]; /* what the program makes of the scene, see probe_variant; 0: not asked yet */
};

static bool show_progress(void *context, double done)
{
    struct desk *d = context;
    return progress_update(&d->bar, (d->done + done * d->current) / fmax(d->total, 1));
}

/* Work found done already counts neither as done nor as to be done, so that the time left comes out right. */
static void skip_work(struct desk *d, double spp) { d->total -= spp; }

static void finish_work(struct desk *d, double spp)
{
    d->done += spp;
    d->current = 0;
}

/* --- files ------------------------------------------------------------------------------------------- */

static void file_path(const struct plan *p, char *out, const char *format, const char *scene, const char *variant,
                      int seed)
{
    char name[1024];
    snprintf(name, sizeof name, format, scene, variant, seed);
    snprintf(out, PATH_SIZE, "%s/%s", p->directory, name);
}

/* Make a directory and those above it. */
static bool make_directory(const char *wanted, struct error *err)
{
    char path[PATH_SIZE];
    struct stat s;
    snprintf(path, sizeof path, "%s", wanted);
    for (char *c = path + 1; *c != '\0'; c++)
        if (*c == '/') {
            *c = '\0';
            mkdir(path, 0777); /* if that fails, the last one says so */
            *c = '/';
        }
    if (mkdir(path, 0777) != 0 && (stat(path, &s) != 0 || !S_ISDIR(s.st_mode)))
        return error_set(err, "%s: cannot make this directory", path);
    return true;
}

static bool make_directories(const struct plan *p, struct error *err)
{
    static const char *const names[] = {"runs", "images", "reference", "plots"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s/%s", p->directory, names[i]);
        if (!make_directory(path, err))
            return false;
    }
    return true;
}

static unsigned long crc_of(const float *pixels, const struct scene_results *r)
{
    return checksum_crc32(0, (const uint8_t *)pixels, (size_t)r->width * (size_t)r->height * 3 * sizeof *pixels);
}

/* Checksum of a picture of one sample per pixel: it changes when the scene, its files or the program do, so that
 * results of another scene or another version of a method are not taken for this one's. 0 when it cannot be
 * rendered, which the run itself will report. */
static unsigned long probe_variant(struct stage *s, int variant)
{
    const struct plan *p = s->desk->plan;
    struct render_options o = {
        .method = method_find(VARIANTS[variant].method), .end = 1, .n_threads = p->n_threads};
    struct film film;
    if (s->probe[variant] != 0)
        return s->probe[variant];
    o.max_depth = s->out->max_depth;
    film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
    variant_settings(&VARIANTS[variant], &s->scene.settings);
    if (render_scene(&s->scene, &o, &film, NULL)) {
        float *pixels = mem_alloc((size_t)s->out->width * (size_t)s->out->height * 3, sizeof *pixels);
        film_develop(&film, s->scene.film_scale, pixels);
        s->probe[variant] = crc_of(pixels, s->out);
        free(pixels);
    }
    film_free(&film);
    return s->probe[variant];
}

/* The key of a run: everything its numbers depend on. */
static void run_key(struct stage *s, int variant, int seed, char *out)
{
    const struct variant *v = &VARIANTS[variant];
    const struct scene_results *r = s->out;
    int n = snprintf(out, KEY_SIZE,
                     "%s %08lx %dx%d maxdepth=%d reference=%08lx %s paths=%d restart=%d seed=%ld spp=", r->name,
                     probe_variant(s, variant), r->width, r->height, r->max_depth, crc_of(r->reference.pixels, r),
                     v->name, v->bin_paths, v->restart, plan_seed(variant, seed));
    for (int i = 0; i < s->desk->plan->n_steps && n < KEY_SIZE; i++)
        n += snprintf(out + n, (size_t)(KEY_SIZE - n), "%s%ld", i > 0 ? "," : "", s->desk->plan->spp[i]);
}

/* --- one run ----------------------------------------------------------------------------------------- */

static bool timed_render(struct stage *s, struct render_options *o, struct film *film, double *seconds)
{
    clock_t start = clock();
    bool ok = render_scene(&s->scene, o, film, s->desk->err);
    *seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    return ok;
}

/* Start the film again. */
static void clear_film(const struct stage *s, struct film *film)
{
    film_free(film);
    film_init(film, render_crop(&s->scene), s->scene.width, s->scene.height);
}

static void measure(const struct stage *s, const struct film *film, long spp, double seconds, struct run_step *out,
                    float *pixels)
{
    film_develop(film, s->scene.film_scale, pixels);
    struct difference d =
        compare_pixels(pixels, s->out->reference.pixels, (long)s->out->width * s->out->height * 3);
    struct run_step step = {.spp = spp, .seconds = seconds, .rmse = d.rmse, .rmse8 = d.rmse8, .relmse = d.relmse};
    step.mean_error = d.mean_ratio - 1;
    step.mean_noise = picture_mean_error(film);
    step.nonfinite = d.nonfinite + film->nonfinite;
    *out = step;
}

/* Render all steps of a run. Each continues the film of an earlier one where the method allows it, so only its own
 * samples are rendered and timed. Preparing the method again for each is not part of what a user would wait for: an
 * empty render measures it, and it is charged once. */
static bool render_steps(struct stage *s, int variant, int seed, struct film *film, struct run *run, float *pixels)
{
    const struct plan *p = s->desk->plan;
    struct render_options o = {.method = method_find(VARIANTS[variant].method),
                               .seed = (uint64_t)plan_seed(variant, seed)};
    o.n_threads = p->n_threads;
    o.max_depth = s->out->max_depth;
    o.progress = show_progress;
    o.progress_context = s->desk;
    double prepare, seconds;
    variant_settings(&VARIANTS[variant], &s->scene.settings);
    if (!timed_render(s, &o, film, &prepare))
        return false;
    for (int i = 0; i < p->n_steps; i++) {
        o.first = plan_first_sample(p, variant, i);
        o.end = p->spp[i];
        if (o.first == 0)
            clear_film(s, film);
        s->desk->current = (double)(o.end - o.first);
        if (!timed_render(s, &o, film, &seconds))
            return false;
        double before = o.first > 0 ? run->step[i - 1].seconds : prepare;
        measure(s, film, o.end, before + fmax(seconds - prepare, 0), &run->step[i], pixels);
        finish_work(s->desk, (double)(o.end - o.first));
    }
    run->n = p->n_steps;
    return true;
}

static void tell_run(const struct stage *s, int variant, int seed, const struct run *run)
{
    const struct run_step *last = &run->step[run->n - 1];
    progress_end(&s->desk->bar);
    if (!s->desk->plan->quiet)
        fprintf(stderr, "%s, %s, seed %d: %ld spp in %.1f s of CPU, rmse8 %.3f\n", s->out->name,
                VARIANTS[variant].label, seed, last->spp, last->seconds, last->rmse8);
}

static bool do_run(struct stage *s, int variant, int seed, const char *file, const char *key, const char *picture)
{
    struct run *run = &s->out->run[variant][seed - 1];
    size_t n = (size_t)s->out->width * (size_t)s->out->height * 3;
    float *pixels = mem_alloc(n, sizeof *pixels);
    struct film film;
    film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
    bool ok = render_steps(s, variant, seed, &film, run, pixels) &&
              (picture == NULL || image_write(picture, s->out->width, s->out->height, pixels, s->desk->err)) &&
              run_write(file, key, run, s->desk->err);
    if (ok)
        tell_run(s, variant, seed, run);
    if (picture != NULL)
        s->out->image[variant] = pixels;
    else
        free(pixels);
    film_free(&film);
    return ok;
}

/* The picture of an earlier run, if it is there. */
static float *old_picture(const struct stage *s, const char *path)
{
    int w, h;
    float *pixels = load_linear(path, &w, &h, NULL);
    if (pixels != NULL && (w != s->out->width || h != s->out->height)) {
        free(pixels);
        pixels = NULL;
    }
    return pixels;
}

static bool get_run(struct stage *s, int variant, int seed)
{
    const struct plan *p = s->desk->plan;
    char file[PATH_SIZE], picture[PATH_SIZE], key[KEY_SIZE];
    bool wants_picture = variant < N_METHODS && seed == 1;
    file_path(p, file, "runs/%s--%s--seed%d.csv", s->out->name, VARIANTS[variant].name, seed);
    file_path(p, picture, "images/%s-%s.pfm", s->out->name, VARIANTS[variant].name, 0);
    run_key(s, variant, seed, key);
    if (run_read(file, key, p->n_steps, &s->out->run[variant][seed - 1]) &&
        (!wants_picture || (s->out->image[variant] = old_picture(s, picture)) != NULL)) {
        skip_work(s->desk, (double)plan_run_spp(p, variant));
        return true;
    }
    return do_run(s, variant, seed, file, key, wants_picture ? picture : NULL);
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* A reference kept by an earlier start, or a new one. */
static bool make_reference(struct stage *s)
{
    const struct plan *p = s->desk->plan;
    struct scene_results *r = s->out;
    char key[KEY_SIZE], directory[PATH_SIZE];
    snprintf(directory, sizeof directory, "%s/reference", p->directory);
    snprintf(key, sizeof key, "%s %08lx %dx%d maxdepth=%d bdpt spp=%ld", r->name, probe_variant(s, VARIANT_BDPT),
             r->width, r->height, r->max_depth, p->reference_spp);
    if (reference_read(directory, r->name, key, r->width, r->height, &r->reference)) {
        skip_work(s->desk, (double)p->reference_spp);
        return true;
    }
    struct render_options o = {.method = method_find("bdpt"), .seed = REFERENCE_SEED, .n_threads = p->n_threads};
    o.max_depth = r->max_depth;
    o.progress = show_progress;
    o.progress_context = s->desk;
    s->desk->current = (double)p->reference_spp;
    variant_settings(&VARIANTS[VARIANT_BDPT], &s->scene.settings);
    if (!reference_render(&s->scene, &o, p->reference_spp, &r->reference, s->desk->err))
        return false;
    finish_work(s->desk, (double)p->reference_spp);
    return reference_write(&r->reference, directory, r->name, key, r->width, r->height, r->max_depth, s->desk->err);
}

static bool get_reference(struct stage *s)
{
    const struct plan *p = s->desk->plan;
    struct scene_results *r = s->out;
    int found = reference_find(p->reference, r->path, r->name, r->width, r->height, r->max_depth, &r->reference,
                               s->desk->err);
    if (found == 1)
        skip_work(s->desk, (double)p->reference_spp);
    return found == 1 || (found == 0 && make_reference(s));
}

static bool load_scene(struct stage *s)
{
    const struct plan *p = s->desk->plan;
    struct error *err = s->desk->err;
    if (!parse_scene(s->out->path, &s->scene, NULL, err))
        return false;
    struct scene *scene = &s->scene;
    static const double whole[4] = {0, 1, 0, 1};
    /* Widths of plans go up to 8192 and films up to 65536 a side: below 2^30. */
    int height = (int)(0.5 + (double)p->width * scene->height / scene->width);
    memcpy(scene->crop, whole, sizeof whole);
    scene->width = s->out->width = p->width;
    scene->height = s->out->height = p->height > 0 ? p->height : height > 1 ? height : 1;
    filter_default("box", &scene->filter);
    if (!render_max_depth(scene, p->max_depth, &s->out->max_depth, err)) {
        scene_free(scene);
        return false;
    }
    scene_prepare(scene);
    return true;
}

/* Seeds come before variants, so that a machine that slows down in between slows down all methods alike. */
static bool do_runs(struct stage *s)
{
    for (int seed = 1; seed <= s->desk->plan->n_seeds; seed++)
        for (int v = 0; v < N_VARIANTS; v++)
            if (seed <= plan_seeds(s->desk->plan, v) && !get_run(s, v, seed))
                return false;
    return true;
}

static bool do_scene(struct desk *d, int number)
{
    struct stage s = {.desk = d, .out = &d->results->scene[number]};
    if (!load_scene(&s))
        return false;
    bool ok = get_reference(&s) && do_runs(&s);
    scene_free(&s.scene);
    return ok;
}

/* --- the whole --------------------------------------------------------------------------------------- */

static bool name_scenes(const struct plan *p, struct results *r, struct error *err)
{
    for (int i = 0; i < p->n_scenes; i++) {
        struct scene_results *s = &r->scene[i];
        s->path = p->scene[i];
        plan_scene_name(s->path, s->name, sizeof s->name);
        for (int k = 0; k < i; k++)
            if (strcmp(s->name, r->scene[k].name) == 0)
                return error_set(err, "%s and %s have the same name, %s; experiment with them one at a time",
                                 s->path, r->scene[k].path, s->name);
    }
    return true;
}

bool experiment_run(const struct plan *plan, struct results *out, struct error *err)
{
    struct desk d = {.plan = plan, .results = out, .err = err};
    out->plan = plan;
    out->scene = mem_alloc((size_t)plan->n_scenes, sizeof *out->scene);
    if (!name_scenes(plan, out, err) || !make_directories(plan, err))
        return false;
    for (int v = 0; v < N_VARIANTS; v++)
        d.total += (double)(plan_seeds(plan, v) * plan_run_spp(plan, v));
    d.total = plan->n_scenes * (d.total + (double)plan->reference_spp);
    progress_start(&d.bar, plan->quiet);
    bool ok = true;
    for (int i = 0; ok && i < plan->n_scenes; i++)
        ok = do_scene(&d, i);
    progress_end(&d.bar);
    return ok;
}
