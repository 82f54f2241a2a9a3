/* race.c: see race.h. */
#include "integrators/race.h"

#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"

enum { LAPS = 2 * RUNNERS, SIDE = 16, MOST_PIXELS = SIDE * SIDE, SAMPLES = 4, RARE = 32, BLIND_SHARE = 8 };
static const double FIREFLY = 11, CAUTION = 4.0 / 3;
static const double NOTHING = 1e-30, BLIND = 1e30; /* not 0 and infinity: others are divided by them */

/* Prices, fitted to CPU times; a sample costs 1, an eye vertex, too. That of a light vertex includes its splat. */
enum { PRICE_CONNECTION = 2, PRICE_LIGHT_VERTEX = 3 };

/* Samples of a runner. What the render makes in one of `every` iterations, a lap makes in each, and counts it as in the
 * render: `every` times. */
struct lap {
    struct render_job job; /* with random numbers of its own */
    struct prepared by;    /* how the runner samples; shares all that it points to */
    int every;
    struct tile_pixels pixels;
    /* Sums of the luminance of a pixel, and of the splats in its cell: all that the render makes in each iteration; and
     * the rest, by iteration of the lap. */
    double often[MOST_PIXELS], rare[SAMPLES][MOST_PIXELS];
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
    *(every > 1 ? &l->rare[sample->iteration][cell] : &l->often[cell]) += value;
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

/* The variance of a sample, from two sums of samples, relative to a unit of brightness. */
static double variance(double a, double b, double unit) { return huber(fabs(a - b) / unit / sqrt(2.0 * SAMPLES)); }

/* What the render makes of a pixel, the mean over a lap. */
static double mean_of(const struct lap *l, int i)
{
    double mean = l->often[i] / SAMPLES;
    for (int j = 0; j < SAMPLES; j++)
        mean += l->rare[j][i] / (SAMPLES * l->every);
    return mean;
}

/* The number of pixels in which a runner has met light in one of its two laps. */
static int pixels_lit(const struct lap *a)
{
    int lit = 0;
    for (int i = 0; i < pixels_count(a->pixels); i++)
        lit += mean_of(a, i) + mean_of(a + 1, i) > 0;
    return lit;
}

/* From the two laps of a runner; most: of pixels_lit. For what the render makes in one of `every` iterations we take the
 * second moment, which is nearly the variance. */
static void judge(struct runner *k, const struct lap *a, const double *unit, int most)
{
    const struct lap *b = a + 1;
    double n = pixels_count(a->pixels), samples = 2 * SAMPLES * n;
    k->price = (a->price + b->price) / samples;
    k->variance = NOTHING;
    for (int i = 0; i < n; i++) {
        k->variance += variance(a->often[i], b->often[i], unit[i]) / n;
        for (int j = 0; j < SAMPLES; j++)
            k->variance += (huber(a->rare[j][i] / unit[i]) + huber(b->rare[j][i] / unit[i])) / (samples * a->every);
    }
    if (BLIND_SHARE * pixels_lit(a) < most)
        k->variance = BLIND;
}

/* The brightness that noise is relative to: the mean of the pixel's and the picture's, over all laps. */
static void find_units(const struct lap *lap, double *unit)
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

/* Lay the laps of all runners, and judge them. False if there is no light, or the job is cancelled. */
static bool compete(const struct render_job *job, struct prepared *p, struct lap *lap)
{
    struct parallel_jobs jobs = {LAPS, job->n_threads, LAPS, lap, run_lap, count_lap, NULL};
    double unit[MOST_PIXELS];
    int most = 0;
    for (int i = 0; i < LAPS; i++)
        start_lap(job, p, &p->runner[i / 2], (uint64_t)i % 2, &lap[i]);
    if (job->scene->lights.n == 0 || parallel_run(&jobs) < LAPS || job_cancelled(job) != CANCEL_NOT)
        return false;
    find_units(lap, unit);
    for (int i = 0; i < LAPS; i += 2)
        most = most > pixels_lit(&lap[i]) ? most : pixels_lit(&lap[i]);
    for (int i = 0; i < RUNNERS; i++)
        judge(&p->runner[i], &lap[2 * i], unit, most);
    return true;
}

bool race_blind(const struct runner *k) { return k->variance >= BLIND; }

int race_winner(const struct runner runner[RUNNERS])
{
    double least = INFINITY;
    int winner = RUNNER_ALL;
    for (int i = 0; i < RUNNERS; i++) {
        double cost = runner_cost(&runner[i]) * (i < RUNNER_PATH_TRACER ? 1 : CAUTION);
        winner = cost < least ? i : winner;
        least = fmin(cost, least);
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
