/* credit.c: see probe.h. */
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"
#include "learning/patience.h"
#include "learning/probe.h"

enum { SEQUENCE = 16, MOST_PIXELS = 1024 };
enum sum { BROAD, DELTA, ALL, N_SUMS }; /* direct light that s = 0 can find; that it cannot; everything */
static const double SAMPLES_PER_PIXEL = 0.64;
static const double MOST_CREDIT = 64;

/* Of one pixel, its two sequences together. */
struct pixel_sums {
    double mean[2][N_SUMS], square[N_SUMS]; /* square: mean over samples */
};

struct measure {
    const struct probe *probe;
    struct mis_counts counts;
    struct patience patience;
    struct pixel_sums *pixel; /* [n] */
    int64_t n;
};

/* Into the sums of one sample; the weights are those of counts 1. */
static void add_path(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    double *x = context, added = rgb_luminance(path->added);
    (void)sample;
    if (!fits_float(added))
        return;
    x[ALL] += added;
    if (path->s + path->t == 3)
        x[path->s == 1 && path->c->weight >= 1 ? DELTA : BROAD] += added;
}

/* One sample of a pixel by path tracing. */
static void take_sample(const struct measure *m, const struct render_job *job, int x, int y, long iteration,
                        struct workspace *work, struct tile *tile, double *value)
{
    const struct observer observer = {.context = value, .joined = add_path};
    struct pixel_rect rect = {x, y, x + 1, y + 1, 0, 0};
    struct tile_pass pass = {job, rect, iteration, iteration + 1, tile, work, &observer};
    tile_start(tile, rect, job->film_rect, &job->scene->filter);
    memset(value, 0, N_SUMS * sizeof *value);
    arena_reset(&work->arena);
    struct pixel_sample sample = pixel_sample_begin(&pass, &m->counts, x, y, iteration);
    int n = pixel_eye_path(&pass, &sample, work->eye, job->max_depth + 2);
    pixel_sum_eye(&sample, work->eye, n);
}

static void measure_pixel(void *context, int64_t number, int slot, int thread)
{
    struct measure *m = context;
    struct pixel_rect all = m->probe->job->film_rect;
    struct pixel_sums *sums = &m->pixel[number];
    struct tile tile = {.n_splats = 0};
    double u, v, value[N_SUMS], asked = 0;
    (void)slot;
    sampler_r2(number, &u, &v);
    int x = all.x0 + (int)(u * rect_width(all)), y = all.y0 + (int)(v * rect_height(all));
    for (int k = 0; k < 2 * SEQUENCE && patience_lasts(&m->patience, &asked); k++) {
        const struct render_job job = probe_job(m->probe->job, (uint64_t)(2 * number + k / SEQUENCE));
        take_sample(m, &job, x, y, k % SEQUENCE, &m->probe->work[thread], &tile, value);
        for (int i = 0; i < N_SUMS; i++) {
            sums->mean[k / SEQUENCE][i] += value[i] / SEQUENCE;
            sums->square[i] += sqr(value[i]) / (2 * SEQUENCE);
        }
    }
    tile_free(&tile);
}

static bool commit(void *context, int64_t number, int slot)
{
    (void)number;
    (void)slot;
    return patience_count(&((struct measure *)context)->patience, 2 * SEQUENCE);
}

/* From moments that are means over pixels, relative to their brightness. */
static double credit_of(const struct measure *m, enum sum i, double all)
{
    double square = 0, sequence = 0;
    for (const struct pixel_sums *p = m->pixel; p < m->pixel + m->n; p++) {
        double scale = probe_scale((p->mean[0][ALL] + p->mean[1][ALL]) / 2, all);
        square += fmin(p->square[i] / scale, PROBE_CLIP);
        sequence += fmin(sqr(p->mean[0][i] - p->mean[1][i]) / 2 / scale, PROBE_CLIP);
    }
    return square > 0 ? fmax(square / fmax(SEQUENCE * sequence, square / MOST_CREDIT), 1) : 1;
}

struct credit credit_measure(const struct probe *p, const struct tables *tables)
{
    struct measure m = {.probe = p, .counts = {{1, 1}, {1, 1}, {1, 1}, .tables = tables},
                        .patience = patience_begin(p->job)};
    double all = 0;
    m.n = int_within(SAMPLES_PER_PIXEL * pixel_light_count(p->job) / (2 * SEQUENCE), 64, MOST_PIXELS);
    m.pixel = mem_alloc((size_t)m.n, sizeof *m.pixel);
    struct parallel_jobs jobs = {m.n, p->job->n_threads, (int)m.n, &m, measure_pixel, commit, NULL};
    m.n = parallel_run(&jobs);
    for (int64_t k = 0; k < m.n; k++)
        all += (m.pixel[k].mean[0][ALL] + m.pixel[k].mean[1][ALL]) / (2 * (double)m.n);
    struct credit c = {credit_of(&m, BROAD, all), credit_of(&m, DELTA, all)};
    patience_end(&m.patience);
    free(m.pixel);
    return c;
}
