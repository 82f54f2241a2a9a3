/* first_light.c: see first_light.h. */
#include "pilot/first_light.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"

enum { SEQUENCE = 16, MOST_PIXELS = 1024 };
enum sum { BROAD, DELTA, ALL, N_SUMS }; /* direct light that s = 0 can find; that it cannot; everything */
static const double SAMPLES_PER_PIXEL = 1.28;
static const double MOST_CREDIT = 64, OUTLIER = 25;

/* Of one pixel, its two sequences together. */
struct pixel_sums {
    double mean[2][N_SUMS], square[N_SUMS]; /* square: mean over samples */
};

struct first_light_job {
    struct render_job job;
    struct mis_counts counts;
    struct workspace *work;   /* [n_threads], the pilot's */
    struct tile *tile;        /* [n_threads] */
    struct pixel_sums *pixel; /* [n] */
    int64_t n;
};

/* A credit is found from moments that are means over pixels, relative to their brightness. */
struct moments {
    double square, sequence; /* second moment; variance of the mean of SEQUENCE */
};

/* Into the sums of one sample, what each strategy brought; the weights are those of counts 1. */
static void add_path(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    double *x = context;
    rgb value = rgb_scale(path->c->value, path->scale);
    (void)sample;
    if (rgb_is_black(value) || !rgb_fits_float(value))
        return;
    const float unweighted[3] = {(float)value.r, (float)value.g, (float)value.b};
    double w = (double)(float)path->c->weight, added = rgb_luminance(rgb_of_floats(unweighted)) * w;
    x[ALL] += added;
    if (path->s + path->t == 3)
        x[path->s == 1 && w >= 1 ? DELTA : BROAD] += added;
}

/* One sample of a pixel by path tracing, from stream `seed`. */
static void take_sample(const struct first_light_job *f, int x, int y, uint64_t seed, long iteration, int thread,
                        double *value)
{
    struct render_job job = f->job;
    struct tile *tile = &f->tile[thread];
    struct pixel_rect rect = {x, y, x + 1, y + 1, 0, 0};
    const struct observer observer = {.context = value, .joined = add_path};
    struct tile_pass pass = {&job, rect, iteration, iteration + 1, tile, &f->work[thread], &observer};
    job.seed = job.eye_seed = seed;
    tile_start(tile, rect, job.film_rect, &job.scene->filter);
    memset(value, 0, N_SUMS * sizeof *value);
    arena_reset(&pass.work->arena);
    struct pixel_sample sample = pixel_sample_begin(&pass, &f->counts, x, y, iteration);
    int n = pixel_eye_path(&pass, &sample, iteration, pass.work->eye, job.max_depth + 2);
    pixel_sum_eye(&sample, pass.work->eye, n);
}

static void measure_pixel(void *context, int64_t job, int slot, int thread)
{
    struct first_light_job *f = context;
    struct pixel_rect all = f->job.film_rect;
    struct pixel_sums *sums = &f->pixel[job];
    double u, v, value[N_SUMS];
    (void)slot;
    sampler_r2(job, &u, &v);
    int x = all.x0 + (int)(u * rect_width(all)), y = all.y0 + (int)(v * rect_height(all));
    for (int k = 0; k < 2 * SEQUENCE; k++) {
        uint64_t seed = hash_combine(f->job.seed, (uint64_t)(2 * job + k / SEQUENCE));
        take_sample(f, x, y, seed, k % SEQUENCE, thread, value);
        for (int i = 0; i < N_SUMS; i++) {
            sums->mean[k / SEQUENCE][i] += value[i] / SEQUENCE;
            sums->square[i] += sqr(value[i]) / (2 * SEQUENCE);
        }
    }
}

static bool commit(void *context, int64_t job, int slot)
{
    struct first_light_job *f = context;
    (void)slot;
    return f->job.watch == NULL || f->job.watch(f->job.watch_context, 2.0 * SEQUENCE * (double)(job + 1));
}

static struct moments moments_of(const struct first_light_job *f, int i, double bright)
{
    struct moments m = {0, 0};
    for (int64_t k = 0; k < f->n; k++) {
        const struct pixel_sums *p = &f->pixel[k];
        double scale = sqr(0.375 * (p->mean[0][ALL] + p->mean[1][ALL]) + 0.25 * bright) + 1e-30;
        double V = sqr(p->mean[0][i] - p->mean[1][i]) / 2;
        m.square += fmin(p->square[i] / scale, OUTLIER);
        m.sequence += fmin(V / scale, OUTLIER);
    }
    return m;
}

static double credit_of(struct moments m)
{
    return m.square > 0 ? fmax(m.square / fmax(SEQUENCE * m.sequence, m.square / MOST_CREDIT), 1) : 1;
}

static void choose(const struct first_light_job *f, struct first_light *out)
{
    double bright = 0;
    for (int64_t k = 0; k < f->n; k++)
        bright += (f->pixel[k].mean[0][ALL] + f->pixel[k].mean[1][ALL]) / (2 * (double)f->n);
    out->broad = credit_of(moments_of(f, BROAD, bright));
    out->delta = credit_of(moments_of(f, DELTA, bright));
}

void first_light_measure(const struct render_job *job, const struct tables *tables, struct workspace *work,
                         struct first_light *out)
{
    struct first_light_job f = {.job = *job, .counts = {{1, 1}, {1, 1}, {1, 1}, .tables = tables}, .work = work};
    double pixels = (double)rect_width(job->film_rect) * rect_height(job->film_rect);
    f.n = int_within(SAMPLES_PER_PIXEL * pixels / (2 * SEQUENCE), 64, MOST_PIXELS);
    f.job.seed = hash_combine(job->seed, 0x9e3779b97f4a7c15u);
    f.tile = mem_alloc((size_t)job->n_threads, sizeof *f.tile);
    f.pixel = mem_alloc((size_t)f.n, sizeof *f.pixel);
    struct parallel_jobs jobs = {f.n, job->n_threads, (int)f.n, &f, measure_pixel, commit, NULL};
    f.n = parallel_run(&jobs);
    choose(&f, out);
    for (int i = 0; i < job->n_threads; i++)
        tile_free(&f.tile[i]);
    free(f.tile);
    free(f.pixel);
}
