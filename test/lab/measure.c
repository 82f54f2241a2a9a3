/* measure.c: see measure.h. */
#include "lab/directory.h"
#include "lab/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/progress.h"
#include "lab/equal.h"
#include "lab/plan_scene.h"
#include "lab/sheet.h"
#include "lab/stats.h"
#include "lab/store.h"
#include "lab/timed.h"

enum { REFERENCE_SEED = 100001, PROBE_WIDTH = 24, ROUNDS = 3, LEAST_TIMED = 4, TIMED_SHARE = 8 };

/* The measuring under way; progress is counted in runs. */
struct measuring {
    const struct plan *plan;
    struct progress bar;
    double total, done, share; /* share: of the run that is going on */
    struct error *err;
};

/* A scene being measured. */
struct subject {
    struct measuring *whole;
    struct scene scene;
    struct scene_results *out;
    unsigned long probe[METHODS_MAX]; /* what the program makes of the scene, see timed_probe; 0: not asked yet */
    float *picture[METHODS_MAX][PLAN_MAX_SEEDS]; /* after all samples, of the reference's size */
};

static enum render_wish show_progress(void *context, double done)
{
    struct measuring *m = context;
    progress_update(&m->bar, (m->done + done * m->share) / m->total);
    return RENDER_GO_ON;
}

static int scale_of(const struct plan *p) { return p->scale > 1 ? p->scale : 1; }

/* How a method is rendered; the scene's settings become the method's. */
static struct render_options options_of(struct subject *s, const struct measured *m, uint64_t seed, int n_threads)
{
    struct settings base = {0};
    if (s->whole->plan->no_roulette)
        settings_set(&base, "rrthreshold", "0", "experiment");
    settings_clear(&s->scene.settings);
    s->scene.settings = measured_settings(m, &base);
    settings_clear(&base);
    struct render_options o = {.integrator = m->integrator, .seed = seed, .n_threads = n_threads,
                               .max_depth = s->out->max_depth};
    return o;
}

/* --- names and keys ---------------------------------------------------------------------------------- */

/* What the program makes of a scene at a small size. */
static unsigned long probe(struct subject *s, int method)
{
    struct render_options o = options_of(s, &s->whole->plan->methods.item[method], 0, 1);
    int width = s->scene.width, height = s->scene.height;
    if (s->probe[method] == 0) {
        s->scene.width = width < PROBE_WIDTH ? width : PROBE_WIDTH;
        s->scene.height = 1 + (height - 1) * s->scene.width / width;
        camera_prepare(&s->scene.camera, s->scene.width, s->scene.height);
        s->probe[method] = timed_probe(&s->scene, &o);
        s->scene.width = width;
        s->scene.height = height;
        camera_prepare(&s->scene.camera, width, height);
    }
    return s->probe[method];
}

/* All that a method's measurements depend on but seed and samples. */
static int begin_key(struct subject *s, int method, char key[STORE_KEY])
{
    const struct plan *p = s->whole->plan;
    return snprintf(key, STORE_KEY, "%s %016" PRIx64 " %08lx %dx%d maxdepth=%d %s%s", s->out->name, s->scene.content,
                    probe(s, method), s->scene.width, s->scene.height, s->out->max_depth, p->methods.item[method].text,
                    p->no_roulette ? " rrthreshold=0" : "");
}

static void picture_key(struct subject *s, int method, uint64_t seed, long spp, char name[STORE_NAME],
                        char key[STORE_KEY])
{
    int n = begin_key(s, method, key);
    snprintf(key + n, (size_t)(STORE_KEY - n), " seed=%" PRIu64 " spp=%ld", seed, spp);
    snprintf(name, STORE_NAME, "store/%s--%s--%d--seed%" PRIu64 "--%ld", s->out->name,
             s->whole->plan->methods.item[method].file, s->scene.width, seed, spp);
}

/* --- prices ------------------------------------------------------------------------------------------ */

/* What preparing the method takes, and the length of the blocks that its samples come in; 0: any. */
static bool prepare(struct subject *s, const struct render_options *o, double *seconds, int *block)
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

/* CPU seconds of what a method prepares and of each of a few samples: a whole block of them, unless that is longer than
 * what the first method renders. */
static bool time_method(struct subject *s, int method, long spp, double *before, double *each)
{
    struct render_options o = options_of(s, &s->whole->plan->methods.item[method], 0, 1);
    struct timed took;
    int block;
    if (!prepare(s, &o, before, &block))
        return false;
    o.end = block > spp && block <= plan_last_spp(s->whole->plan) ? block : spp;
    if (!timed_render(&s->scene, &o, &took, s->whole->err))
        return false;
    free(took.pixels);
    *each = fmax(took.seconds - *before, 1e-6) / (double)o.end;
    return true;
}

static double median(double *x, int n)
{
    stats_sort(x, (size_t)n);
    return n % 2 == 1 ? x[n / 2] : 0.5 * (x[n / 2 - 1] + x[n / 2]);
}

/* The first method and another by turns. */
static bool measure_price(struct subject *s, int method, struct record *out)
{
    const struct plan *p = s->whole->plan;
    double before[ROUNDS], each[ROUNDS], first[ROUNDS], ignored;
    long spp = plan_last_spp(p) / TIMED_SHARE > LEAST_TIMED ? plan_last_spp(p) / TIMED_SHARE : LEAST_TIMED;
    for (int i = 0; i < ROUNDS; i++) {
        if (!time_method(s, 0, spp, &ignored, &first[i]) || !time_method(s, method, spp, &before[i], &each[i]))
            return false;
        before[i] /= first[i];
        each[i] = method == 0 ? 1 : each[i] / first[i];
    }
    stats_sort(first, ROUNDS);
    stats_sort(each, ROUNDS);
    out->number[0] = median(before, ROUNDS);
    out->number[1] = median(each, ROUNDS);
    out->number[2] = each[ROUNDS - 1] / each[0] - 1;
    out->number[3] = first[0];
    return true;
}

static bool read_or_measure_price(struct subject *s, int method)
{
    const struct plan *p = s->whole->plan;
    const struct measured *first = &p->methods.item[0];
    struct record r = {{0}, NULL, 0, 0};
    char name[STORE_NAME], key[STORE_KEY];
    int n = begin_key(s, method, key);
    snprintf(key + n, (size_t)(STORE_KEY - n), " price over %s, %08lx, spp=%ld", first->text, probe(s, 0),
             plan_last_spp(p));
    snprintf(name, sizeof name, "store/%s--%s--%d--price-over-%s", s->out->name, p->methods.item[method].file,
             s->scene.width, first->file);
    bool ok = store_read(p->directory, name, key, &r) ||
              (measure_price(s, method, &r) && store_write(p->directory, name, key, &r, s->whole->err));
    struct price price = {r.number[0], r.number[1], r.number[2]};
    s->out->price[method] = price;
    s->out->seconds = method == 0 || r.number[3] < s->out->seconds ? r.number[3] : s->out->seconds;
    return ok;
}

/* --- one run ----------------------------------------------------------------------------------------- */

/* Against the reference. */
static void compare_picture(struct subject *s, int method, int seed, int step)
{
    struct scene_results *out = s->out;
    const struct reference *ref = &out->reference;
    struct run_step *to = &out->run[method][seed - 1].step[step];
    const float *x = s->picture[method][seed - 1];
    struct difference d = compare_pixels(x, ref->pixels, 3L * out->width * out->height);
    to->value[Q_RMSE] = d.rmse;
    to->value[Q_RMSE8] = d.rmse8;
    to->value[Q_RELMSE] = d.relmse;
    to->value[Q_MEAN_ERROR] = d.mean_ratio - 1;
    to->nonfinite += d.nonfinite;
    compare_squares(x, ref->pixels, ref->pixels, out->width, out->height, to->square);
    to->value[Q_BLOCKS] = to->square[SQUARE_BLOCKS];
    for (int k = 0; k < N_SQUARES; k++)
        to->square[k] -= ref->noise[k];
}

/* The picture of the last step is kept; of the first seed as it is. */
static void take_step(struct subject *s, int method, int seed, int step, long spp, struct record *r)
{
    struct run_step *to = &s->out->run[method][seed - 1].step[step];
    float **picture = &s->picture[method][seed - 1], **image = &s->out->image[method];
    bool shown = method < s->whole->plan->n_compared && seed == 1;
    free(*picture);
    *picture = sheet_shrink(r->pixels, s->scene.width, s->scene.height, scale_of(s->whole->plan));
    to->spp = spp;
    to->value[Q_SECONDS] = r->number[0];
    to->nonfinite = (long)r->number[1];
    free(shown ? *image : r->pixels);
    if (shown)
        *image = r->pixels;
    if (s->out->reference.pixels != NULL)
        compare_picture(s, method, seed, step);
}

/* Those kept by an earlier start. */
static bool read_run(struct subject *s, int method, int seed, const long *spp, int n)
{
    const struct plan *p = s->whole->plan;
    char name[STORE_NAME], key[STORE_KEY];
    for (int i = 0; i < n; i++) {
        struct record r = {{0}, NULL, 0, 0};
        picture_key(s, method, plan_seed(p, method, seed), spp[i], name, key);
        if (!store_read(p->directory, name, key, &r))
            return false;
        take_step(s, method, seed, i, spp[i], &r);
    }
    return true;
}

/* Render all steps of a run. Each continues the film of the one before, so only its own samples are rendered and timed,
 * unless that ends within a block of samples, which must not be cut. Preparing the method again for each is not part
 * of what a user would wait for: it is charged once. */
static bool render_run(struct subject *s, int method, int seed, const long *spp, int n)
{
    const struct plan *p = s->whole->plan;
    uint64_t number = plan_seed(p, method, seed);
    struct render_options o = options_of(s, &p->methods.item[method], number, p->n_threads);
    struct film film;
    double prepared = 0, seconds = 0;
    int block = 0;
    bool ok = n == 1 || prepare(s, &o, &prepared, &block);
    o.progress = show_progress;
    o.progress_context = s->whole;
    film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
    for (int i = 0; ok && i < n; i++) {
        struct timed took = {0};
        char name[STORE_NAME], key[STORE_KEY];
        picture_key(s, method, number, spp[i], name, key);
        o.first = i > 0 && (block == 0 || spp[i - 1] % block == 0) ? spp[i - 1] : 0;
        o.end = spp[i];
        if (o.first == 0 && i > 0) {
            film_free(&film);
            film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
        }
        seconds = o.first == 0 ? prepared : seconds;
        s->whole->share = (double)(o.end - o.first) / (double)spp[n - 1];
        ok = timed_film(&s->scene, &o, &film, &took, s->whole->err);
        seconds += fmax(took.seconds - prepared, 0);
        struct record r = {{seconds, (double)took.nonfinite}, NULL, s->scene.width, s->scene.height};
        r.pixels = timed_develop(&s->scene, &film);
        ok = ok && store_write(p->directory, name, key, &r, s->whole->err);
        take_step(s, method, seed, i, spp[i], &r);
    }
    film_free(&film);
    progress_end(&s->whole->bar);
    if (ok && !p->quiet)
        fprintf(stderr, "%s, %s, seed %" PRIu64 ": %ld spp in %.2f s of CPU\n", s->out->name,
                p->methods.item[method].text, number, spp[n - 1], seconds);
    return ok;
}

static bool read_or_render_run(struct subject *s, int method, int seed)
{
    const struct plan *p = s->whole->plan;
    long spp = p->equal ? equal_samples(s->out, method) : 0;
    const long *steps = p->equal ? &spp : p->spp;
    struct seed_run *run = &s->out->run[method][seed - 1];
    run->n = p->equal ? 1 : p->n_steps;
    s->whole->share = 0;
    bool ok = read_run(s, method, seed, steps, run->n) || render_run(s, method, seed, steps, run->n);
    s->whole->done++;
    return ok;
}

/* --- errors from pairs ------------------------------------------------------------------------------- */

bool measure_by_pairs(const struct plan *p, int method)
{
    return p->equal && p->n_seeds >= 3 && p->reference == NULL && !measured_biased(&p->methods.item[method]);
}

/* The median of the methods' means over seeds, value by value: what errors are relative to. To be freed. */
static float *median_picture(const struct subject *s)
{
    const struct plan *p = s->out->plan;
    size_t n = 3 * (size_t)s->out->width * (size_t)s->out->height;
    float *out = mem_alloc(n, sizeof *out);
    for (size_t i = 0; i < n; i++) {
        double mean[METHODS_MAX] = {0};
        for (int v = 0; v < p->methods.n; v++)
            for (int k = 0; k < p->n_seeds; k++)
                mean[v] += (double)s->picture[v][k][i] / p->n_seeds;
        out[i] = (float)median(mean, p->methods.n);
    }
    return out;
}

/* The mean of all that unbiased methods made, and its own noise: each weighted as its squared error says. */
static void agree(struct subject *s)
{
    struct scene_results *out = s->out;
    struct reference *ref = &out->reference;
    const struct plan *p = out->plan;
    double weight[METHODS_MAX] = {0}, total = 0;
    size_t n = 3 * (size_t)out->width * (size_t)out->height;
    memset(ref->pixels, 0, n * sizeof *ref->pixels);
    for (int v = 0; v < p->methods.n; v++) {
        double error = results_square(out, v, 0, SQUARE_RELMSE).mean;
        weight[v] = measure_by_pairs(p, v) ? 1 / fmax(error, 1e-12) : 0;
        total += weight[v];
    }
    for (int v = 0; v < p->methods.n; v++) {
        double w = weight[v] / total;
        for (int k = 0; k < N_SQUARES; k++)
            ref->noise[k] += w > 0 ? w * w * results_square(out, v, 0, (enum square)k).mean / p->n_seeds : 0;
        for (int seed = 0; w > 0 && seed < p->n_seeds; seed++)
            for (size_t i = 0; i < n; i++)
                ref->pixels[i] += (float)(w / p->n_seeds) * s->picture[v][seed][i];
    }
    ref->noise8 = sqrt(ref->noise[SQUARE_RMSE8]);
    ref->mean_error = NAN;
    snprintf(ref->origin, sizeof ref->origin, "mean of what is measured");
}

static void compare_pairs(struct subject *s, int method)
{
    struct scene_results *out = s->out;
    int n = out->plan->n_seeds;
    double half[N_SQUARES][PLAN_MAX_SEEDS * PLAN_MAX_SEEDS], square[N_SQUARES], each[PLAN_MAX_SEEDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            compare_squares(s->picture[method][i], s->picture[method][j], out->reference.pixels, out->width,
                            out->height, square);
            for (int k = 0; k < N_SQUARES; k++)
                half[k][i * n + j] = half[k][j * n + i] = square[k] / 2;
        }
    for (int k = 0; k < N_SQUARES; k++) {
        results_pairs(half[k], n, each);
        for (int i = 0; i < n; i++)
            out->run[method][i].step[0].square[k] = each[i];
    }
}

/* --- one scene --------------------------------------------------------------------------------------- */

static bool needs_reference(const struct plan *p)
{
    bool needed = true;
    for (int v = 0; v < p->methods.n; v++)
        needed = needed && !measure_by_pairs(p, v);
    return needed;
}

/* The stored reference, or one kept by an earlier start, or a new one. */
static bool make_reference(struct subject *s)
{
    const struct plan *p = s->whole->plan;
    struct scene_results *r = s->out;
    char key[STORE_KEY], directory[4096];
    struct measured m = {.text = METHOD_REFERENCE, .integrator = METHOD_REFERENCE};
    if (r->reference.pixels != NULL || !needs_reference(p))
        return true;
    snprintf(directory, sizeof directory, "%s/reference", p->directory != NULL ? p->directory : "");
    snprintf(key, sizeof key, "%s %016" PRIx64 " %08lx %dx%d maxdepth=%d %s spp=%ld", r->name, s->scene.content,
             probe(s, 0), r->width, r->height, r->max_depth, m.text, p->reference_spp);
    struct render_options o = options_of(s, &m, ~p->seed - REFERENCE_SEED, p->n_threads);
    return reference_make(&s->scene, &o, p->reference_spp, p->directory != NULL ? directory : NULL, r->name, key,
                          &r->reference, s->whole->err);
}

/* At the size of its errors. */
static bool load_scene(struct subject *s)
{
    struct scene_results *r = s->out;
    if (!plan_scene_load(s->whole->plan, r->path, r->name, &s->scene, &r->max_depth, &r->reference, s->whole->err))
        return false;
    r->width = s->scene.width;
    r->height = s->scene.height;
    return true;
}

static bool enlarge(struct subject *s)
{
    int k = scale_of(s->whole->plan);
    if (!picture_size_ok((uint64_t)s->out->width * (uint64_t)k, (uint64_t)s->out->height * (uint64_t)k, s->whole->err))
        return false;
    s->scene.width = s->out->width * k;
    s->scene.height = s->out->height * k;
    camera_prepare(&s->scene.camera, s->scene.width, s->scene.height);
    return true;
}

/* What is about to take long. */
static void announce(struct subject *s)
{
    const struct plan *p = s->whole->plan;
    double seed = equal_seconds(s->out);
    char all[32];
    progress_duration(p->n_seeds * seed, all, sizeof all);
    progress_end(&s->whole->bar);
    fprintf(stderr, "%s, %dx%d: %d renders of %.2g s each: some %s of CPU, less what is kept from before\n",
            s->out->name, s->out->width, s->out->height, p->n_seeds * p->methods.n, seed / p->methods.n, all);
}

/* Seeds come before methods, so that a machine that slows down in between slows down all alike. */
static bool measure_methods(struct subject *s)
{
    const struct plan *p = s->whole->plan;
    bool ok = true;
    for (int v = 0; ok && p->equal && v < p->methods.n; v++)
        ok = read_or_measure_price(s, v);
    if (ok && p->equal && !p->quiet)
        announce(s);
    for (int seed = 1; ok && seed <= p->n_seeds; seed++)
        for (int v = 0; ok && v < p->methods.n; v++)
            ok = seed > plan_seeds(p, v) || read_or_render_run(s, v, seed);
    return ok;
}

static void compare_all_pairs(struct subject *s)
{
    for (int v = 0; v < s->whole->plan->methods.n; v++)
        if (measure_by_pairs(s->whole->plan, v))
            compare_pairs(s, v);
}

/* Errors as far as they need all pictures: by pairs, and against what the methods agree on. */
static void judge(struct subject *s)
{
    const struct plan *p = s->whole->plan;
    if (s->out->reference.pixels == NULL) {
        s->out->reference.pixels = median_picture(s);
        compare_all_pairs(s);
        agree(s);
        for (int v = 0; v < p->methods.n; v++)
            for (int seed = 1; seed <= p->n_seeds; seed++)
                compare_picture(s, v, seed, 0);
    }
    compare_all_pairs(s);
}

static bool make_directories(const struct plan *p, struct error *err)
{
    static const char *const names[] = {"store", "images", "plots"};
    char path[4096];
    bool ok = p->directory == NULL || file_make_directory(p->directory, err);
    for (size_t i = 0; ok && p->directory != NULL && i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", p->directory, names[i]);
        ok = file_make_directory(path, err);
    }
    return ok;
}

static bool measure_scene(struct measuring *m, struct scene_results *out)
{
    struct subject s = {.whole = m, .out = out};
    if (!load_scene(&s))
        return false;
    bool ok = make_directories(m->plan, m->err) && make_reference(&s) && enlarge(&s) && measure_methods(&s);
    if (ok)
        judge(&s);
    for (int v = 0; v < METHODS_MAX; v++)
        for (int i = 0; i < PLAN_MAX_SEEDS; i++)
            free(s.picture[v][i]);
    scene_free(&s.scene);
    return ok;
}

/* --- the whole --------------------------------------------------------------------------------------- */

bool measure(const struct plan *plan, struct results *out, struct error *err)
{
    struct measuring m = {.plan = plan, .err = err};
    out->plan = plan;
    out->scene = mem_alloc((size_t)plan->n_scenes, sizeof *out->scene);
    if (!plan_names_differ(plan, err))
        return false;
    for (int v = 0; v < plan->methods.n; v++)
        m.total += plan->n_scenes * plan_seeds(plan, v);
    progress_start(&m.bar, plan->quiet);
    bool ok = true;
    for (int i = 0; ok && i < plan->n_scenes; i++) {
        out->scene[i].plan = plan;
        out->scene[i].path = plan->scene[i];
        plan_name(plan, i, out->scene[i].name);
        ok = measure_scene(&m, &out->scene[i]);
    }
    progress_end(&m.bar);
    return ok;
}
