/* probe.c: see probe.h. */
#include "learning/probe.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"
#include "learning/patience.h"
#include "transport/counts.h"
#include "transport/pixel_sample.h"

enum { LEAST_PIXELS = 512, MOST_PIXELS = 4096 };
static const double SHARE_OF_PIXELS = 0.25;
static const double ENOUGH = 0.4;    /* see light_paths_useful */
static const double CLIP = 25;       /* bound of a squared relative deviation; an image cuts larger ones at white */
static const double CLIP_TAIL = 1e4; /* bound of a pixel's sum; large, because only this sum shows fireflies */

/* The samples of a pixel. OTHER has other random numbers than FIRST; AGAIN has those of FIRST and other counts. */
enum render { FIRST, OTHER, AGAIN, RENDERS };

struct pixel {
    double value[2];  /* luminance of FIRST and OTHER, t >= 2 */
    double direct[2]; /* the part of it that is direct light */
    double splats;    /* sum of squares of the contributions of FIRST with t = 1 */
    double tail, direct_tail; /* sums of X^2 (1/P - 1): paths of three edges or more; direct light */
};

struct path {
    double x, weight; /* in FIRST */
};

struct probe {
    const struct render_job *job;
    struct mis_counts counts[RENDERS];
    struct pixel *pixel; /* [n], at points of a low-discrepancy sequence over the film */
    struct workspace *work;
    struct tile *tile; /* [n_threads], as work */
    struct patience patience;
};

/* --- one sample -------------------------------------------------------------------------------------- */

/* Data of one pixel while it takes its samples. */
struct notes {
    struct pixel *pixel;
    enum render render;
    struct path *path; /* [n], paths of FIRST in their order; `next` is the number that AGAIN makes next; owned */
    size_t n, next;
};

static void add_tail(struct notes *n, const struct joined *now)
{
    const struct path *before = &n->path[n->next++];
    double w = now->c->weight;
    int edges = now->s + now->t - 1;
    if (edges < 2 || !(before->weight > 0) || !(w > 0))
        return; /* light that the camera sees directly has one strategy */
    double P = clamp((now->s <= 1 ? 2 : 1) * before->weight / w - 1, 1e-6, 1);
    *(edges == 2 ? &n->pixel->direct_tail : &n->pixel->tail) += sqr(before->x) * (1 / P - 1);
}

static void note(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct notes *n = context;
    double x = rgb_luminance(path->added);
    (void)sample;
    if (!(rgb_luminance(path->c->value) > 0))
        return; /* both samples leave it out */
    if (n->render == AGAIN) {
        add_tail(n, path);
        return;
    }
    x = fits_float(x) ? x : 0;
    if (path->t > 1) {
        n->pixel->value[n->render] += x;
        n->pixel->direct[n->render] += path->s + path->t == 3 ? x : 0;
    }
    if (n->render == FIRST) {
        n->pixel->splats += path->t == 1 ? x * x : 0;
        n->path = mem_append(n->path, n->n, sizeof *n->path);
        n->path[n->n++] = (struct path){x, path->c->weight};
    }
}

static void take_sample(const struct probe *p, struct notes *notes, int64_t k, int x, int y, int thread)
{
    struct render_job job = *p->job;
    struct workspace *work = &p->work[thread];
    struct tile *tile = &p->tile[thread];
    const struct mis_counts *counts = &p->counts[notes->render];
    const struct observer observer = {.context = notes, .joined = note};
    struct tile_pass pass = {.job = &job, .first = (long)k, .end = (long)k + 1, .tile = tile, .work = work,
                             .observer = &observer};
    job.seed = job.eye_seed = hash_combine(hash_combine(job.seed, 0x3c6ef372fe94f82bu), notes->render == OTHER);
    tile_start(tile, pixels_all((struct pixel_rect){x, y, x + 1, y + 1}), job.film_rect, &job.scene->filter);
    arena_reset(&work->arena);
    struct pixel_sample sample = pixel_sample_begin(&pass, counts, x, y, (long)k);
    int n_eye = pixel_eye_path(&pass, &sample, work->eye, job.max_depth + 2);
    sample.filter_weight = fabs(sample.filter_weight); /* that signs differ is no noise of an image (filter.h) */
    int n_light = pixel_light_path(&pass, counts, x, y, (uint64_t)k, &work->arena, work->light);
    pixel_sum_eye(&sample, work->eye, n_eye);
    pixel_sum_pairs(&sample, work->eye, n_eye, work->light, n_light, NO_CHOICE);
    pixel_splat_path(&sample, work->light, n_light, 1);
}

/* --- all pixels -------------------------------------------------------------------------------------- */

static void measure(void *context, int64_t k, int slot, int thread)
{
    struct probe *p = context;
    struct pixel_rect film = p->job->film_rect;
    struct notes n = {.pixel = &p->pixel[k]};
    double u, v, asked = 0;
    (void)slot;
    sampler_r2(k, &u, &v);
    for (n.render = FIRST; n.render < RENDERS && patience_lasts(&p->patience, &asked); n.render++)
        take_sample(p, &n, k, film.x0 + (int)(u * rect_width(film)), film.y0 + (int)(v * rect_height(film)), thread);
    free(n.path);
}

static bool count(void *context, int64_t k, int slot)
{
    (void)k;
    (void)slot;
    return patience_count(&((struct probe *)context)->patience, 1);
}

/* Measure `wanted` pixels; returns how many, fewer if job->watch ends it. */
static int64_t run(struct probe *p, int64_t wanted)
{
    int n_threads = p->job->n_threads;
    struct parallel_jobs jobs = {wanted, n_threads, (int)wanted, p, measure, count, NULL};
    p->work = workspaces_new(n_threads, p->job->max_depth);
    p->tile = mem_alloc((size_t)n_threads, sizeof *p->tile);
    p->patience = patience_begin(p->job);
    int64_t n = parallel_run(&jobs);
    patience_end(&p->patience);
    for (int i = 0; i < n_threads; i++)
        tile_free(&p->tile[i]);
    free(p->tile);
    workspaces_free(p->work, n_threads);
    return n;
}

/* The divisor of squares in a pixel of brightness `local`, if the mean brightness is `all`. */
static double scale_of(double local, double all) { return sqr(0.75 * local + 0.25 * all) + 1e-30; }

/* Is the sum that path tracing adds to the second moment large enough? */
static bool compare(const struct pixel *pixel, int64_t n)
{
    double all = 0, variance = 0, tail = 0, direct = 0, direct_square = 0, direct_tail = 0;
    for (const struct pixel *x = pixel; x < pixel + n; x++)
        all += (x->value[0] + x->value[1]) / (2 * (double)n);
    for (const struct pixel *x = pixel; x < pixel + n; x++) {
        double scale = scale_of((x->value[0] + x->value[1]) / 2, all);
        variance += fmin(sqr(x->value[0] - x->value[1]) / 2 / scale, CLIP);
        variance += fmin(x->splats / scale_of(all, all), CLIP); /* they land on any pixel */
        tail += fmin(x->tail / scale, CLIP_TAIL);
        direct += fmin(sqr(x->direct[0] - x->direct[1]) / 2 / scale, CLIP);
        direct_square += fmin((sqr(x->direct[0]) + sqr(x->direct[1])) / 2 / scale, CLIP);
        direct_tail += fmin(x->direct_tail / scale, CLIP_TAIL);
    }
    if (direct_square > 0)
        tail += direct_tail * direct / direct_square;
    return !(tail < ENOUGH * variance);
}

bool light_paths_useful(const struct render_job *job)
{
    const struct numbers bdpt = NUMBERS_OF_BDPT;
    const struct mis_counts counts = counts_of(bdpt, NO_CREDITS, pixel_light_count(job));
    struct probe p = {.job = job, .counts = {counts, counts, counts}};
    int64_t wanted = int_within(SHARE_OF_PIXELS * pixel_light_count(job), LEAST_PIXELS, MOST_PIXELS);
    p.counts[AGAIN].connect[FIRST_HIT] = p.counts[AGAIN].connect[LATER_HIT] = 0.5;
    p.counts[AGAIN].splat /= 2;
    p.pixel = mem_alloc((size_t)wanted, sizeof *p.pixel);
    int64_t n = run(&p, wanted);
    bool useful = n < wanted || compare(p.pixel, n);
    free(p.pixel);
    return useful;
}
