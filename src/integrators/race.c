/* race.c: see race.h. */
#include "integrators/race.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"

enum { LAPS = 2 * RUNNERS, SIDE = 16, MOST_PIXELS = SIDE * SIDE, SAMPLES = 4, RARE = 32 };
static const double FIREFLY = 11, SURE = 3; /* standard deviations */
static const double NOTHING = 1e-30;        /* not 0: others are divided by it */

/* Prices, fitted to CPU times; a sample costs 1, an eye vertex, too. That of a light vertex includes its splat. */
enum { PRICE_CONNECTION = 2, PRICE_LIGHT_VERTEX = 3 };

/* Samples of a runner. What the render makes in one of `every` iterations, a lap makes in each, and counts it as in the
 * render: `every` times. */
struct lap {
    struct render_job job; /* with random numbers of its own */
    struct prepared by;    /* how the runner samples; shares all that it points to */
    int every;
    struct tile_pixels pixels;
    /* The luminance of a pixel, and of the splats in its cell, by iteration of the lap: all that the render makes in
     * each iteration; and the rest. */
    double often[SAMPLES][MOST_PIXELS], rare[SAMPLES][MOST_PIXELS];
    double price;
};

/* --- one lap ----------------------------------------------------------------------------------------- */

static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct lap *l = context;
    struct pixel_rect film = l->pixels.rect; /* splats around it are left out */
    double x = p->t == 1 ? floor(p->px) : sample->x, y = p->t == 1 ? floor(p->py) : sample->y;
    double value = fabs(rgb_luminance(p->added)); /* that signs of a filter differ is no noise of an image (filter.h) */
    int every = p->s < 2 ? 1 : l->every;
    if (p->t > 1 && p->s > 0)
        l->price += (double)PRICE_CONNECTION / every;
    if (p->s + p->t == 2 || !fits_float(value) || !(x >= film.x0 && x < film.x1 && y >= film.y0 && y < film.y1))
        return; /* all runners have the same of light that the camera sees directly */
    int cell = pixels_cell(l->pixels, (int)x, (int)y);
    value *= p->t == 1 ? 1 : every; /* splats are divided by the count in the weights */
    (every > 1 ? l->rare : l->often)[sample->iteration][cell] += value;
}

static void walked(void *context, const struct sample *sample, enum transport mode, const struct vertex *path, int n)
{
    struct lap *l = context;
    (void)sample, (void)path;
    l->price += mode == RADIANCE ? 1 + n : (double)n * PRICE_LIGHT_VERTEX / l->every;
}

static void start_lap(const struct render_job *job, const struct prepared *p, const struct runner *k, uint64_t number,
                      struct lap *l)
{
    struct pixel_rect film = job->film_rect;
    int side = int_within(sqrt((double)rect_pixels(film) / (2 * SAMPLES)), 1, SIDE); /* at most a sample of each */
    int nx = (rect_width(film) + side - 1) / side, ny = (rect_height(film) + side - 1) / side;
    *l = (struct lap){.job = *job, .by = *p, .every = numbers_every(&k->numbers), .pixels = {film, nx, ny, 0, 0}};
    l->job.seed = l->job.eye_seed = hash_combine(hash_combine(job->seed, 0x3c6ef372fe94f82bu), number);
    l->by.numbers = k->numbers;
    method_settle(job, &l->by);
    l->by.numbers.every = 1; /* counted as in the render, made in each */
}

static void run_lap(void *context, int64_t number, int slot, int thread)
{
    struct lap *l = (struct lap *)context + number;
    struct workspace *work = workspaces_new(1, l->job.max_depth);
    struct tile tile = {.n_pixels = 0};
    const struct observer observer = {.context = l, .walked = walked, .joined = joined};
    const struct tile_pass pass = {.job = &l->job, .counts = &l->by.counts, .end = SAMPLES, .tile = &tile,
                                   .work = work, .observer = &observer, .ends_at = CANCEL_BLOCK};
    (void)slot, (void)thread;
    tile_start(&tile, l->pixels, l->job.film_rect, &l->job.scene->filter);
    l->by.method->render(&l->by, &pass);
    tile_free(&tile);
    workspaces_free(work, 1);
}

static bool count_lap(void *context, int64_t number, int slot)
{
    (void)number, (void)slot;
    return job_cancelled(&((struct lap *)context)->job) == CANCEL_NOT;
}

/* --- what laps tell ---------------------------------------------------------------------------------- */

/* The square of x >= 0, continued by its tangent above FIREFLY. */
static double huber(double x) { return x < FIREFLY ? x * x : 2 * FIREFLY * x - FIREFLY * FIREFLY; }

/* What an iteration of the render makes of a pixel, and the mean over a lap. */
static double made(const struct lap *l, int j, int i) { return l->often[j][i] + l->rare[j][i] / l->every; }

static double mean_of(const struct lap *l, int i)
{
    double sum = 0;
    for (int j = 0; j < SAMPLES; j++)
        sum += made(l, j, i);
    return sum / SAMPLES;
}

/* From the two laps of a runner. Of what the render makes in one of `every` iterations we take the second moment, which
 * is nearly the variance. */
static void judge(struct runner *k, const struct lap *a, const double *unit)
{
    const struct lap *b = a + 1;
    double n = pixels_count(a->pixels), samples = 2 * SAMPLES * n;
    k->price = (a->price + b->price) / samples;
    k->variance = NOTHING;
    for (int i = 0; i < n; i++) {
        double d = 0;
        for (int j = 0; j < SAMPLES; j++) {
            d += a->often[j][i] - b->often[j][i];
            k->variance += (huber(a->rare[j][i] / unit[i]) + huber(b->rare[j][i] / unit[i])) / (samples * a->every);
        }
        k->variance += huber(fabs(d) / unit[i] / sqrt(2.0 * SAMPLES)) / n; /* two sums of samples */
    }
}

/* The mean over a runner's samples, in units, and its variance, by the iterations of its two laps: within one, pixels
 * share light sub-paths. */
static double mean_over(const struct lap *lap, const double *unit, double *variance)
{
    double sum = 0, squares = 0, n = pixels_count(lap->pixels);
    for (int j = 0; j < 2 * SAMPLES; j++) {
        double x = 0;
        for (int i = 0; i < n; i++)
            x += made(&lap[j / SAMPLES], j % SAMPLES, i) / (n * unit[i]);
        sum += x / (2 * SAMPLES);
        squares += x * x / (2 * SAMPLES);
    }
    *variance = fmax(squares - sum * sum, 0) / (2 * SAMPLES - 1);
    return sum;
}

/* What N samples have missed comes about once in N, or less often. So if their mean surely lacks d of that of the first
 * runner, whose laps are all[2], their variance is at least d^2 N. */
static void judge_lack(struct runner *k, const struct lap *a, const struct lap *all, const double *unit)
{
    double v[2], d = mean_over(all, unit, &v[0]) - mean_over(a, unit, &v[1]);
    if (d > SURE * sqrt(v[0] + v[1]))
        k->variance = d * d * 2 * SAMPLES * pixels_count(a->pixels);
}

/* The brightness that noise is relative to: the mean of the pixel's and the picture's, over all laps. Is there any? */
static bool find_units(const struct lap *lap, double *unit)
{
    int pixels = pixels_count(lap->pixels);
    double picture = 0;
    for (int i = 0; i < pixels; i++) {
        unit[i] = NOTHING;
        for (const struct lap *l = lap; l < lap + LAPS; l++)
            unit[i] += mean_of(l, i) / LAPS;
        picture += unit[i] / pixels;
    }
    for (int i = 0; i < pixels; i++)
        unit[i] = (unit[i] + picture) / 2;
    return picture > 2 * NOTHING;
}

/* --- the race ---------------------------------------------------------------------------------------- */

/* If not, a lobe may be so sharp that s = 0 and s = 1 find next to nothing of what it makes of a small light. */
static bool is_diffuse(const struct scene *scene)
{
    bool diffuse = true;
    for (int i = 0; i < scene->n_materials; i++)
        diffuse &= scene->material[i]->row->diffuse;
    return diffuse;
}

void race_begin(const struct scene *scene, struct prepared *p)
{
    struct numbers *all = &p->runner[RUNNER_ALL].numbers, *quarter = &p->runner[RUNNER_QUARTER].numbers;
    struct numbers *pt = &p->runner[RUNNER_PATH_TRACER].numbers, *one = &p->runner[RUNNER_ONE_POINT].numbers;
    *all = *quarter = *pt = p->numbers;
    quarter->path_pixels = 4 * all->path_pixels;
    pt->every = RARE;
    if (is_diffuse(scene))
        *pt = (struct numbers){.light_points = all->light_points};
    *one = *pt;
    one->light_points = 1;
}

/* Lay the laps of all runners, and judge them. False if no light is met, or the job is cancelled. */
static bool compete(const struct render_job *job, struct prepared *p, struct lap *lap)
{
    struct parallel_jobs jobs = {LAPS, job->n_threads, LAPS, lap, run_lap, count_lap, NULL};
    double unit[MOST_PIXELS];
    for (int i = 0; i < LAPS; i++)
        start_lap(job, p, &p->runner[i / 2], (uint64_t)i % 2, &lap[i]);
    if (job->scene->lights.n == 0 || parallel_run(&jobs) < LAPS || job_cancelled(job) != CANCEL_NOT ||
        !find_units(lap, unit))
        return false;
    for (int i = 0; i < RUNNERS; i++) {
        judge(&p->runner[i], &lap[2 * i], unit);
        judge_lack(&p->runner[i], &lap[2 * i], lap, unit);
    }
    return true;
}

int race_winner(const struct runner runner[RUNNERS])
{
    double least = INFINITY;
    int winner = RUNNER_ALL;
    for (int i = 0; i < RUNNERS; i++) {
        winner = runner_cost(&runner[i]) < least ? i : winner;
        least = fmin(runner_cost(&runner[i]), least);
    }
    return winner;
}

void race(const struct render_job *job, struct prepared *p)
{
    struct lap *lap = mem_alloc(LAPS, sizeof *lap);
    for (int i = 0; i < RUNNERS; i++)
        p->runner[i].variance = p->runner[i].price = 0; /* of an earlier race */
    p->winner = compete(job, p, lap) ? race_winner(p->runner) : RUNNER_ALL;
    free(lap);
}
