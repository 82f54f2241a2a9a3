/* credit.c: see probe.h. */
#include <stdlib.h>

#include "base/number.h"
#include "learning/probe.h"

enum { SEQUENCE = 16, MOST_PIXELS = 1024 };
enum sum { DIRECT, DELTA, ALL, N_SUMS }; /* direct light that s = 0 can find; that of delta lights; all light */
static const double SAMPLES_PER_PIXEL = 0.64;
static const double MOST_CREDIT = 64;

/* Sums of one pixel over its two sequences. */
struct pixel_sums {
    double mean[2][N_SUMS], square[N_SUMS]; /* square: mean over samples */
};

struct credit_probe {
    struct mis_counts counts;
    struct pixel_sums *pixel; /* [n] */
};

/* Add a path to the sums of its sample. The weights are those of a path tracer: 1 if s = 0 cannot find the light. */
static void add_path(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    double *x = context, added = rgb_luminance(path->added);
    (void)sample;
    if (!fits_float(added))
        return;
    x[ALL] += added;
    bool first = path->s + path->t > 2 && path->z[path->s - 1].eye_end == FIRST_HIT;
    if (first)
        x[path->s == 1 && path->c->weight >= 1 ? DELTA : DIRECT] += added;
}

static void measure(struct probe *p, int64_t k, int x, int y, int thread)
{
    const struct credit_probe *c = p->context;
    struct pixel_sums *sums = &c->pixel[k];
    double asked = 0;
    for (int i = 0; i < 2 * SEQUENCE && patience_lasts(&p->patience, &asked); i++) {
        double value[N_SUMS] = {0};
        const struct observer observer = {.context = value, .joined = add_path};
        probe_sample(p, &c->counts, (uint64_t)(2 * k + i / SEQUENCE), x, y, i % SEQUENCE, thread, &observer);
        for (int j = 0; j < N_SUMS; j++) {
            sums->mean[i / SEQUENCE][j] += value[j] / SEQUENCE;
            sums->square[j] += sqr(value[j]) / (2 * SEQUENCE);
        }
    }
}

/* The credit, from means over pixels of moments relative to the pixel's brightness. */
static double credit_of(const struct pixel_sums *pixel, int64_t n, enum sum i, double all)
{
    double square = 0, sequence = 0;
    for (const struct pixel_sums *p = pixel; p < pixel + n; p++) {
        double scale = probe_scale((p->mean[0][ALL] + p->mean[1][ALL]) / 2, all);
        square += fmin(p->square[i] / scale, PROBE_CLIP);
        sequence += fmin(sqr(p->mean[0][i] - p->mean[1][i]) / 2 / scale, PROBE_CLIP);
    }
    return square > 0 ? fmax(square / fmax(SEQUENCE * sequence, square / MOST_CREDIT), 1) : 1;
}

struct credits credit_measure(const struct render_job *job, const struct tables *tables)
{
    const struct numbers path_tracer = {.light_points = 1, .path_tracing = true};
    struct credit_probe c = {.counts = counts_of(path_tracer, NO_CREDITS, 1)};
    struct probe p = {.job = job, .context = &c, .measure = measure};
    double all = 0;
    p.n = int_within(SAMPLES_PER_PIXEL * pixel_light_count(job) / (2 * SEQUENCE), 64, MOST_PIXELS);
    c.counts.tables = tables;
    c.pixel = mem_alloc((size_t)p.n, sizeof *c.pixel);
    probe_run(&p);
    for (int64_t k = 0; k < p.n; k++)
        all += (c.pixel[k].mean[0][ALL] + c.pixel[k].mean[1][ALL]) / (2 * (double)p.n);
    double direct = credit_of(c.pixel, p.n, DIRECT, all), delta = credit_of(c.pixel, p.n, DELTA, all);
    free(c.pixel);
    return (struct credits){.hit = direct, .direct = direct, .direct_delta = delta, .draw = 1};
}
