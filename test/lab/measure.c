/* measure.c: see measure.h. */
#include "lab/measure.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/progress.h"
#include "lab/files.h"
#include "lab/equal.h"
#include "lab/plan.h"
#include "lab/subject.h"
#include "lab/timed.h"

enum {
    REFERENCE_SEED = 100001,
    CLEANER = 4 /* times as many samples of it, where all errors are against it */
};

/* How far all is; counted in runs. At equal time a render is stored at earlier numbers of samples, too. */
struct pace {
    struct progress bar;
    double total, done, share; /* share: of the run that is going on */
    struct subject *s;         /* of a render at equal time; NULL: of another */
    const struct film *film;
    int method;
    uint64_t seed;
    long spp; /* that it will have */
};

/* Step i > 0 of a render of so many samples: powers of two from a sixteenth on; 0: there is none. */
static long earlier_step(long spp, int i)
{
    long n = 1;
    while (n <= spp / 32)
        n *= 2;
    return i < PLAN_MAX_STEPS && n << (i - 1) < spp ? n << (i - 1) : 0;
}


/* --- one run ----------------------------------------------------------------------------------------- */

/* Of so many samples; of > 0: on the way to as many. */
static void picture_key(struct subject *s, int method, uint64_t seed, long spp, long of, char name[STORE_NAME],
                        char key[STORE_KEY])
{
    int n = subject_key(s, method, key);
    n += snprintf(key + n, (size_t)(STORE_KEY - n), " seed=%" PRIu64 " spp=%ld", seed, spp);
    int k = snprintf(name, STORE_NAME, "store/%s--%s--%d--seed%" PRIu64 "--%ld", s->out->name,
                     s->plan->methods.item[method].file, s->scene.width, seed, spp);
    if (of > 0) {
        snprintf(key + n, (size_t)(STORE_KEY - n), " of %ld", of);
        snprintf(name + k, (size_t)(STORE_NAME - k), "-of-%ld", of);
    }
}

/* If the film has as many samples as one of the earlier steps. What cannot be stored is a point less. */
static void keep_earlier(const struct pace *pace)
{
    char name[STORE_NAME], key[STORE_KEY];
    struct subject *s = pace->s;
    struct record r = {{0, (double)pace->film->nonfinite}, NULL, s->scene.width, s->scene.height};
    int i = 1;
    while (earlier_step(pace->spp, i) != 0 && earlier_step(pace->spp, i) != pace->film->iterations)
        i++;
    if (earlier_step(pace->spp, i) == 0)
        return;
    picture_key(s, pace->method, pace->seed, earlier_step(pace->spp, i), pace->spp, name, key);
    r.pixels = timed_develop(&s->scene, pace->film);
    store_write(s->plan->directory, name, key, &r, NULL);
    free(r.pixels);
}

static void show_progress(void *context, double learnt, double done)
{
    struct pace *pace = context;
    (void)learnt;
    progress_update(&pace->bar, (pace->done + done * pace->share) / pace->total);
    if (pace->s != NULL && done < 1 && pace->film->passes == 0 && pace->film->iterations > 0)
        keep_earlier(pace);
}

/* Against the reference. */
static void compare_picture(struct subject *s, int method, int seed, int step, const float *x)
{
    struct scene_results *out = s->out;
    const struct reference *ref = &out->reference;
    struct run *to = &out->run[method][seed - 1][step];
    struct difference d = compare_pixels(x, ref->pixels, 3L * out->width * out->height);
    to->value[Q_RMSE8] = d.rmse8;
    to->value[Q_MEAN_ERROR] = d.mean_ratio - 1;
    to->nonfinite += d.nonfinite;
    compare_squares(x, ref->pixels, ref->pixels, out->width, out->height, to->square);
    for (int k = 0; k < N_SQUARES; k++)
        to->square[k] -= ref->noise[k];
}

/* The picture is kept if it is of the last step, or if there are pairs. */
static void take_step(struct subject *s, int method, int seed, int step, long spp, struct record *r)
{
    struct run *to = &s->out->run[method][seed - 1][step];
    to->spp = spp;
    to->value[Q_SECONDS] = r->number[0];
    to->nonfinite = (long)r->number[1];
    compare_picture(s, method, seed, step, r->pixels);
    float *old = s->picture[method][step][seed - 1];
    bool kept = step == plan_last_step(s->plan) || plan_seeds(s->plan, method) >= 3;
    s->picture[method][step][seed - 1] = kept ? r->pixels : NULL;
    free(kept ? old : r->pixels);
}

/* Those kept by an earlier start. */
static bool read_run(struct subject *s, int method, int seed, const long *spp, int n)
{
    const struct plan *p = s->plan;
    char name[STORE_NAME], key[STORE_KEY];
    for (int i = 0; i < n; i++) {
        struct record r = {{0}, NULL, 0, 0};
        picture_key(s, method, plan_seed(p, method, seed), spp[i], 0, name, key);
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
    const struct plan *p = s->plan;
    uint64_t number = plan_seed(p, method, seed);
    struct render_job o = subject_options(s, &p->methods.item[method], number, p->n_threads);
    struct film film;
    double prepared = 0, seconds = 0;
    int block = 0;
    bool ok = n == 1 || timed_prepare(&s->scene, &o, &prepared, &block, s->err);
    o.progress = show_progress;
    o.context = s->pace;
    s->pace->s = NULL;
    if (p->equal) {
        o.block = (int)earlier_step(spp[0], 1); /* where the method leaves that open; changes nothing of the picture */
        s->pace->s = s;
        s->pace->film = &film;
        s->pace->method = method;
        s->pace->seed = number;
        s->pace->spp = spp[0];
    }
    film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
    for (int i = 0; ok && i < n; i++) {
        struct timed took = {0};
        char name[STORE_NAME], key[STORE_KEY];
        picture_key(s, method, number, spp[i], 0, name, key);
        o.first = i > 0 && (block == 0 || spp[i - 1] % block == 0) ? spp[i - 1] : 0;
        o.end = spp[i];
        if (o.first == 0 && i > 0) {
            film_free(&film);
            film_init(&film, render_crop(&s->scene), s->scene.width, s->scene.height);
        }
        seconds = o.first == 0 ? prepared : seconds;
        s->pace->share = (double)(o.end - o.first) / (double)spp[n - 1];
        ok = timed_film(&s->scene, &o, &film, &took, s->err);
        seconds += fmax(took.seconds - prepared, 0);
        struct record r = {{seconds, (double)took.nonfinite}, NULL, s->scene.width, s->scene.height};
        r.pixels = timed_develop(&s->scene, &film);
        ok = ok && store_write(p->directory, name, key, &r, s->err);
        take_step(s, method, seed, i, spp[i], &r);
    }
    film_free(&film);
    progress_end(&s->pace->bar);
    if (ok && !p->quiet)
        say_line("%s, %s, seed %" PRIu64 ": %ld spp in %.2f s of CPU", s->out->name, p->methods.item[method].text,
                 number, spp[n - 1], seconds);
    return ok;
}

static bool read_or_render_run(struct subject *s, int method, int seed)
{
    const struct plan *p = s->plan;
    long spp = p->equal ? equal_samples(s->out, method, seed - 1) : 0;
    const long *steps = p->equal ? &spp : p->spp;
    s->pace->share = 0;
    bool ok = read_run(s, method, seed, steps, p->n_steps) || render_run(s, method, seed, steps, p->n_steps);
    s->pace->done++;
    return ok;
}

/* --- errors from pairs ------------------------------------------------------------------------------- */

/*   picture  [n_seeds] of the step */
static void compare_pairs(struct subject *s, int method, int step, float *const *picture)
{
    struct scene_results *out = s->out;
    int n = out->plan->n_seeds;
    double half[N_SQUARES][PLAN_MAX_SEEDS * PLAN_MAX_SEEDS], square[N_SQUARES], each[PLAN_MAX_SEEDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            compare_squares(picture[i], picture[j], out->reference.pixels, out->width, out->height, square);
            for (int k = 0; k < N_SQUARES; k++)
                half[k][i * n + j] = half[k][j * n + i] = square[k] / 2;
        }
    for (int k = 0; k < N_SQUARES; k++) {
        results_pairs(half[k], n, each);
        for (int i = 0; i < n; i++)
            out->run[method][i][step].square[k] = each[i];
    }
}

/* At equal time: what all seeds have stored on the way. */
static void compare_earlier(struct subject *s, int method, int step)
{
    const struct plan *p = s->plan;
    long spp[PLAN_MAX_SEEDS];
    float *picture[PLAN_MAX_SEEDS];
    int n = 0;
    for (bool there = true; there && n < p->n_seeds; n += there) {
        char name[STORE_NAME], key[STORE_KEY];
        struct record r = {{0}, NULL, 0, 0};
        long of = s->out->run[method][n][0].spp;
        spp[n] = earlier_step(of, step);
        picture_key(s, method, plan_seed(p, method, n + 1), spp[n], of, name, key);
        there = spp[n] > 0 && store_read(p->directory, name, key, &r);
        picture[n] = r.pixels;
    }
    for (int i = 0; n == p->n_seeds && i < n; i++) {
        s->out->run[method][i][step].spp = spp[i];
        compare_picture(s, method, i + 1, step, picture[i]);
    }
    if (n == p->n_seeds && results_by_pairs(s->out, method))
        compare_pairs(s, method, step, picture);
    while (n > 0)
        free(picture[--n]);
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* The stored reference, or one kept by an earlier start, or a new one. */
static bool make_reference(struct subject *s)
{
    const struct plan *p = s->plan;
    struct scene_results *r = s->out;
    char key[STORE_KEY], directory[4096];
    struct measured m = {.halves = 0};
    bool all;
    const char *by = reference_method(&s->scene, &all);
    int spp = p->equal && !all ? CLEANER * p->reference_spp : p->reference_spp;
    r->lacks = !all;
    if (r->reference.pixels != NULL)
        return true;
    r->by = by;
    snprintf(m.text, sizeof m.text, "%s", by);
    snprintf(m.integrator, sizeof m.integrator, "%s", by);
    snprintf(directory, sizeof directory, "%s/reference", p->directory);
    snprintf(key, sizeof key, "%s %016" PRIx64 " %08lx %dx%d maxdepth=%d %s spp=%d", r->name, s->scene.content,
             subject_probe(s, 0), r->width, r->height, r->max_depth, m.text, spp);
    struct render_job o = subject_options(s, &m, ~p->seed - REFERENCE_SEED, p->n_threads);
    return reference_make(&s->scene, &o, spp, directory, r->name, key, &r->reference, s->err);
}

/* Seeds come before methods, so that a machine that slows down in between slows down all alike. */
static bool measure_methods(struct subject *s)
{
    const struct plan *p = s->plan;
    bool ok = true;
    for (int i = 0; ok && p->equal && i < p->methods.n * p->n_seeds; i++)
        ok = subject_price(s, i % p->methods.n, i / p->methods.n + 1);
    for (int seed = 1; ok && seed <= p->n_seeds; seed++)
        for (int v = 0; ok && v < p->methods.n; v++)
            ok = seed > plan_seeds(p, v) || read_or_render_run(s, v, seed);
    return ok;
}

/* Which methods have the light of the reference, and of these the errors by pairs. */
static void judge(struct subject *s)
{
    struct scene_results *out = s->out;
    const struct plan *p = s->plan;
    for (int v = 0; v < p->methods.n; v++) {
        int n = plan_seeds(p, v);
        if (n >= 2 && out->reference.variance != NULL)
            out->mark[v] = mark_of(mark_tests(s->picture[v][plan_last_step(p)], n, &out->reference),
                                   p->methods.n * p->n_scenes);
        for (int step = 0; results_by_pairs(out, v) && step < p->n_steps; step++)
            compare_pairs(s, v, step, s->picture[v][step]);
        for (int step = 1; p->equal && step < PLAN_MAX_STEPS; step++)
            compare_earlier(s, v, step);
    }
}

/* Not before a scene has been read: what is refused leaves nothing behind. */
static bool make_directories(const struct plan *p, struct error *err)
{
    static const char *const names[] = {"store", "images"};
    char path[4096];
    bool ok = true;
    for (size_t i = 0; ok && i < sizeof names / sizeof names[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", p->directory, names[i]);
        ok = file_make_directory(path, err);
    }
    return ok;
}

/* Errors of fewer than three seeds are against the reference, and one that is made here is as noisy as they are. */
static bool has_enough(const struct scene_results *s, struct error *err)
{
    bool known = s->reference.pixels != NULL && isfinite(s->reference.noise8);
    return !s->plan->equal || s->plan->n_seeds >= 3 || known ||
           error_set(err, "%s: fewer than three seeds need a stored reference whose noise is known; use --seeds 3, or "
                     "--reference NAME.pfm with NAME.error.pfm, or with \"noise8 X\" in NAME.txt", s->path);
}

/* *begun: what fails then is not the scene's fault. */
static bool measure_scene(struct pace *pace, struct scene_results *out, bool *begun, struct error *err)
{
    struct subject s = {.plan = out->plan, .out = out, .pace = pace, .err = err};
    *begun = false;
    if (!plan_scene_load(s.plan, out->path, out->name, &s.scene, &out->max_depth, &out->reference, err))
        return false;
    out->width = s.scene.width;
    out->height = s.scene.height;
    *begun = has_enough(out, err);
    bool ok = *begun && make_directories(s.plan, err) && make_reference(&s) && measure_methods(&s);
    if (ok)
        judge(&s);
    for (int v = 0; v < METHODS_MAX; v++) {
        out->image[v] = s.picture[v][plan_last_step(s.plan)][0];
        s.picture[v][plan_last_step(s.plan)][0] = NULL;
        for (int i = 0; i < PLAN_MAX_STEPS * PLAN_MAX_SEEDS; i++)
            free(s.picture[v][i / PLAN_MAX_SEEDS][i % PLAN_MAX_SEEDS]);
    }
    scene_free(&s.scene);
    return ok;
}

/* --- the whole --------------------------------------------------------------------------------------- */

/* The scene leaves plan and results, and its memory goes. */
static void leave_out(struct plan *plan, struct results *out, int scene)
{
    struct scene_results *s = &out->scene[scene];
    reference_free(&s->reference);
    *s = (struct scene_results){.plan = NULL};
    plan->n_scenes--;
    for (int i = scene; i < plan->n_scenes; i++)
        plan->scene[i] = plan->scene[i + 1];
}

bool measure(struct plan *plan, struct results *out, struct error *err)
{
    struct pace pace = {.total = 0};
    bool begun;
    out->plan = plan;
    out->scene = mem_alloc((size_t)plan->n_scenes, sizeof *out->scene);
    bool ok = plan_names_differ(plan, err);
    for (int v = 0; v < plan->methods.n; v++)
        pace.total += plan->n_scenes * plan_seeds(plan, v);
    progress_start(&pace.bar, plan->quiet);
    for (int i = 0; ok && i < plan->n_scenes; i++) {
        out->scene[i].plan = plan;
        out->scene[i].path = plan->scene[i];
        plan_scene_name(plan->scene[i], out->scene[i].name, PLAN_NAME);
        ok = measure_scene(&pace, &out->scene[i], &begun, err);
        if (!ok && !begun && plan->n_scenes > 1) {
            say_line("asbdpt: %s; it is left out", err->text);
            leave_out(plan, out, i--);
            ok = true;
        }
    }
    progress_end(&pace.bar);
    return ok;
}
