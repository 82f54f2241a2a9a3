/* pilot.c: see pilot.h. */
#include "integrators/pilot.h"

#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "base/parallel.h"

/* The kinds of samples whose number is free: a pixel's variance, given its eye sub-path, is theirs. HIT is the light
 * that the first bounce meets (s = 0, t = 3). An eye sub-path has one such sample, so its number is not free, but the
 * weights count it, too, for what it is worth. */
enum kind { DRAW_FIRST, DRAW_LATER, LIGHT_FIRST, LIGHT_PATH, N_KINDS, HIT = N_KINDS };

/* Samples per eye vertex (per pixel) of each kind while the pilot runs, and in its absence. The choice moves from the
 * latter by BOLDNESS of the way, on a logarithmic scale: more samples of a kind also take over weight from others, so
 * its variance falls more slowly than 1/n. */
static const double TRIED[N_KINDS] = {4, 4, 4, 0.25}, USUAL[N_KINDS] = {3, 1, 2, 0.25};
static const double BOLDNESS = 2.0 / 3;
static const double USUAL_CREDIT = 1.5, MOST_CREDIT = 4;

/* The budget: samples for each pixel of the picture, in whole tiles. */
static const double SAMPLES_PER_PIXEL = 1.28;
enum { MOST_TILES = 8 };

/* Renders of a tile: the second shares nothing with the first, the third its eye sub-paths. */
enum { RENDERS = 3 };

/* No squared relative deviation counts for more: a picture's white is not far off. Light sub-paths have more leave:
 * what they splat is rare and strong (caustics), and their number is all that is decided by it. */
static const double OUTLIER = 25, OUTLIER_PATHS = 400;

struct sums {
    double total, given_eye, given_paths;  /* variances relative to the squared brightness; the last: OUTLIER_PATHS */
    /* of the samples that one eye vertex has of a kind (HIT: one pixel): variance of their sum, sum of their squares */
    double spread[N_KINDS + 1], square[N_KINDS + 1];
};

struct pilot {
    struct render_job job;
    const struct preparation *method;
    struct workspace *work;       /* [n_threads] */
    struct tile (*tile)[RENDERS]; /* [n_slots] */
    struct sums *found;           /* [n_slots] */
    struct sums sums;
    bool stopped;
};

static double luminance_of(const float *c)
{
    return rgb_luminance(rgb_make((double)c[0], (double)c[1], (double)c[2]));
}

static double luminance_added(const struct strategy_record *r)
{
    return luminance_of(r->unweighted) * (double)r->weight;
}

/* Where the pixel of a record lies in the tile. */
static long place_in_tile(const struct tile *tile, const struct strategy_record *r)
{
    int width = rect_width(tile->film_rect);
    int x = r->at % width + tile->film_rect.x0, y = r->at / width + tile->film_rect.y0;
    return (long)(y - tile->rect.y0) * rect_width(tile->rect) + (x - tile->rect.x0);
}

/* Luminance of every pixel of the tile, splats included. */
static void pixel_values(const struct tile *tile, double *out)
{
    int n = rect_width(tile->rect) * rect_height(tile->rect);
    for (int i = 0; i < n; i++)
        out[i] = rgb_luminance(rgb_make(exact_value(&tile->sum[3 * i]), exact_value(&tile->sum[3 * i + 1]),
                                        exact_value(&tile->sum[3 * i + 2])));
    for (size_t k = 0; k < tile->n_splats; k++) {
        const struct splat *s = &tile->splat[k];
        struct pixel_rect r = tile->rect, range = splat_pixels(s, tile->filter, r);
        for (int y = range.y0; y < range.y1; y++)
            for (int x = range.x0; x < range.x1; x++) {
                float part[3];
                if (splat_part(s, tile->filter, x, y, part))
                    out[(y - r.y0) * rect_width(r) + (x - r.x0)] += luminance_of(part);
            }
    }
}

/* Squared brightness around every pixel: mostly of a small block, partly of the tile, where the block is dark by
 * chance. */
static void brightness(struct pixel_rect rect, const double *a, const double *b, double *out)
{
    enum { BLOCK = 4 };
    int width = rect_width(rect), height = rect_height(rect);
    double all = 0;
    for (int i = 0; i < width * height; i++)
        all += (a[i] + b[i]) / (2.0 * width * height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int x0 = x / BLOCK * BLOCK, y0 = y / BLOCK * BLOCK, n = 0;
            double sum = 0;
            for (int j = y0; j < height && j < y0 + BLOCK; j++)
                for (int i = x0; i < width && i < x0 + BLOCK; i++, n += 2)
                    sum += a[j * width + i] + b[j * width + i];
            out[y * width + x] = sqr(0.75 * sum / n + 0.25 * all) + 1e-30;
        }
}

/* -1: a strategy whose number of samples is not free, or whose samples are not those of one eye vertex. */
static int kind_of(const struct strategy_record *r)
{
    if (r->s == 1)
        return r->t == 2 ? LIGHT_FIRST : -1;
    return r->s < 2 || r->t == 1 ? -1 : r->t == 2 ? DRAW_FIRST : DRAW_LATER;
}

/* Records of one eye vertex and kind stand in a row; samples that brought nothing have none. */
static void add_records(const struct tile *tile, const double *scale, struct sums *out)
{
    for (size_t i = 0; i < tile->n_records;) {
        const struct strategy_record *first = &tile->record[i];
        int kind = kind_of(first);
        double x = 0, x2 = 0, n = kind >= 0 ? TRIED[kind] : 1;
        for (; i < tile->n_records; i++) {
            const struct strategy_record *r = &tile->record[i];
            if (r->at != first->at || r->t != first->t || kind_of(r) != kind)
                break;
            double one = luminance_added(r);
            x += one;
            x2 += one * one;
        }
        if (kind < 0)
            continue;
        long at = place_in_tile(tile, first);
        out->spread[kind] += fmin((x2 - x * x / n) * n / (n - 1) / scale[at], OUTLIER);
        out->square[kind] += fmin(x2 / scale[at], OUTLIER);
    }
}

/* A pixel's light that was met by the eye sub-path's first bounce, of two renders with sub-paths of their own: value is
 * room for 2 n numbers. */
static void add_hits(const struct tile *a, const struct tile *b, const double *scale, double *value, size_t n,
                     struct sums *out)
{
    memset(value, 0, 2 * n * sizeof *value);
    for (int i = 0; i < 2; i++) {
        const struct tile *tile = i == 0 ? a : b;
        for (size_t k = 0; k < tile->n_records; k++) {
            const struct strategy_record *r = &tile->record[k];
            if (r->s == 0 && r->t == 3)
                value[(size_t)i * n + (size_t)place_in_tile(tile, r)] += luminance_added(r);
        }
    }
    for (size_t i = 0; i < n; i++) {
        out->spread[HIT] += fmin(sqr(value[i] - value[n + i]) / 2 / scale[i], OUTLIER);
        out->square[HIT] += fmin((sqr(value[i]) + sqr(value[n + i])) / 2 / scale[i], OUTLIER);
    }
}

/* Tile k lies around point k of an even sequence over the film. */
static struct pixel_rect rect_of(const struct pilot *p, int64_t k)
{
    struct pixel_rect all = p->job.film_rect, r;
    double u, v;
    sampler_r2(k, &u, &v);
    int w = rect_width(all) < MAX_TILE_SIZE ? rect_width(all) : MAX_TILE_SIZE;
    int h = rect_height(all) < MAX_TILE_SIZE ? rect_height(all) : MAX_TILE_SIZE;
    r.x0 = all.x0 + (int)(u * (rect_width(all) - w + 1));
    r.y0 = all.y0 + (int)(v * (rect_height(all) - h + 1));
    r.x1 = r.x0 + w;
    r.y1 = r.y0 + h;
    return r;
}

static void render_tile(void *context, int64_t job, int slot, int thread)
{
    struct pilot *p = context;
    struct pixel_rect rect = rect_of(p, job);
    size_t n = (size_t)rect_width(rect) * (size_t)rect_height(rect);
    double *value = mem_alloc((RENDERS + 1) * n, sizeof *value), *scale = value + RENDERS * n;
    struct sums *found = &p->found[slot];
    memset(found, 0, sizeof *found);
    for (int i = 0; i < RENDERS; i++) {
        struct tile *tile = &p->tile[slot][i];
        struct render_job this = p->job;
        this.seed = hash_combine(p->job.seed, (uint64_t)i);
        this.eye_seed = hash_combine(p->job.seed, RENDERS + (i == 1));
        struct tile_pass pass = {&this, rect, (long)job, (long)job + 1, tile, &p->work[thread], NULL};
        tile_start(tile, rect, p->job.film_rect, &p->job.scene->filter, true);
        p->method->method->render(p->method, &pass);
        pixel_values(tile, value + (size_t)i * n);
    }
    brightness(rect, value, value + n, scale);
    for (int i = 0; i < RENDERS; i++)
        add_records(&p->tile[slot][i], scale, found);
    for (size_t i = 0; i < n; i++) {
        found->total += fmin(sqr(value[i] - value[n + i]) / 2 / scale[i], OUTLIER);
        double given = sqr(value[i] - value[2 * n + i]) / 2 / scale[i];
        found->given_eye += fmin(given, OUTLIER);
        found->given_paths += fmin(given, OUTLIER_PATHS);
    }
    add_hits(&p->tile[slot][0], &p->tile[slot][1], scale, value, n, found);
    free(value);
}

static bool add_tile(void *context, int64_t job, int slot)
{
    struct pilot *p = context;
    const struct sums *s = &p->found[slot];
    double n = RENDERS * (double)(job + 1) * MAX_TILE_SIZE * MAX_TILE_SIZE;
    p->sums.total += s->total;
    p->sums.given_eye += s->given_eye;
    p->sums.given_paths += s->given_paths;
    for (int k = 0; k <= HIT; k++) {
        p->sums.spread[k] += s->spread[k] / (k == HIT ? 1 : RENDERS); /* a pair of renders is one value of HIT */
        p->sums.square[k] += s->square[k] / (k == HIT ? 1 : RENDERS);
    }
    p->stopped = p->job.watch != NULL && !p->job.watch(p->job.watch_context, n);
    return !p->stopped;
}

/* --- the choice -------------------------------------------------------------------------------------- */

static void set_numbers(struct subspaces_state *s, const double *n, const double *credit)
{
    struct frozen *f = &s->frozen;
    s->draws[FIRST_HIT] = clamp(n[DRAW_FIRST], 0.25, 16);
    s->draws[LATER_HIT] = clamp(n[DRAW_LATER], 0.125, 8);
    f->lights = (int)clamp(n[LIGHT_FIRST] + 0.5, 1, 8);
    f->path_pixels = (int)clamp(1 / n[LIGHT_PATH] + 0.5, 1, 64);
    f->counts.connect[FIRST_HIT] = credit[DRAW_FIRST] * s->draws[FIRST_HIT];
    f->counts.connect[LATER_HIT] = credit[DRAW_LATER] * s->draws[LATER_HIT];
    f->counts.direct[FIRST_HIT] = credit[LIGHT_FIRST] * f->lights;
    f->counts.direct[LATER_HIT] = 1;
}

void pilot_set_draws(struct subspaces_state *s, double C)
{
    for (int end = 0; end < EYE_ENDS; end++) {
        s->frozen.counts.connect[end] *= C / s->draws[end];
        s->draws[end] = C;
    }
}

/* In units of a ray that looks for the closest hit; the factors were measured. */
static void costs(const struct importance *importance, double *fixed, double *cost)
{
    const double CONNECTION = 0.6, POINT = 0.8;
    double n_eye = importance->eye_vertices, n_first = importance->first_vertices, n_light = importance->light_vertices;
    *fixed = 1 + n_eye;
    cost[DRAW_FIRST] = CONNECTION * n_first;
    cost[DRAW_LATER] = CONNECTION * (n_eye - n_first);
    cost[LIGHT_FIRST] = POINT * n_first;
    cost[LIGHT_PATH] = 1 + (1 + CONNECTION) * n_light;
}

/* What samples are worth to the weights, compared with independent ones: second moment over variance. */
static double credit_of(double square, double spread)
{
    return spread > 0 ? clamp(square / spread, 1, MOST_CREDIT) : 1;
}

static void choose_numbers(struct subspaces_state *state, const struct sums *s)
{
    const double LEAST = 0.2, LEAST_PATH = 0.02; /* shares of the variance that A and light sub-paths have at least */
    double fixed, cost[N_KINDS], b[N_KINDS], n[N_KINDS], credit[N_KINDS], rest = s->given_paths;
    double A = fmax(s->total - s->given_eye, LEAST * s->total);
    for (int k = 0; k < LIGHT_PATH; k++)
        rest -= b[k] = s->spread[k];
    b[LIGHT_PATH] = fmax(rest, LEAST_PATH * s->total);
    costs(&state->learnt.importance, &fixed, cost);
    for (int k = 0; k < N_KINDS; k++) {
        double best = cost[k] > 0 ? sqrt(b[k] * TRIED[k] / cost[k] * fixed / A) : USUAL[k];
        n[k] = USUAL[k] * m_pow(fmax(best, 1e-3) / USUAL[k], BOLDNESS);
        credit[k] = credit_of(s->square[k], s->spread[k]);
    }
    set_numbers(state, n, credit);
    state->frozen.counts.hit = credit_of(s->square[HIT], s->spread[HIT]);
}

static void make_memory(struct pilot *p, int n_slots)
{
    p->work = workspaces_new(p->job.n_threads, p->job.max_depth);
    for (int i = 0; i < p->job.n_threads; i++)
        p->work[i].scratch = method_scratch(p->method);
    p->tile = mem_alloc((size_t)n_slots, sizeof *p->tile);
    p->found = mem_alloc((size_t)n_slots, sizeof *p->found);
}

static void free_memory(struct pilot *p, int n_slots)
{
    for (int i = 0; i < n_slots; i++)
        for (int k = 0; k < RENDERS; k++)
            tile_free(&p->tile[i][k]);
    for (int i = 0; i < p->job.n_threads; i++)
        method_scratch_free(p->method, p->work[i].scratch);
    workspaces_free(p->work, p->job.n_threads);
    free(p->tile);
    free(p->found);
}

/* What was chosen, as struct learnt keeps it. */
static void exchange(struct subspaces_state *s, bool store)
{
    struct mis_counts *c = &s->frozen.counts;
    double lights = s->frozen.lights, path_pixels = s->frozen.path_pixels, *kept = s->learnt.number;
    double *const chosen[] = {&s->draws[FIRST_HIT], &s->draws[LATER_HIT], &lights, &path_pixels, &c->hit,
                              &c->direct[FIRST_HIT], &c->direct[LATER_HIT], &c->connect[FIRST_HIT],
                              &c->connect[LATER_HIT]};
    for (size_t i = 0; i < sizeof chosen / sizeof chosen[0]; i++)
        *(store ? &kept[i] : chosen[i]) = *(store ? chosen[i] : &kept[i]);
    for (int end = 0; end < EYE_ENDS; end++)
        s->draws[end] = clamp(s->draws[end], 0.125, 16);
    s->frozen.lights = int_within(lights, 1, 8); /* whatever a file says */
    s->frozen.path_pixels = int_within(path_pixels, 1, MAX_TILE_SIZE * MAX_TILE_SIZE);
}

void pilot_recall(struct subspaces_state *s) { exchange(s, false); }

void pilot_run(const struct render_job *job, struct preparation *method)
{
    const double credit[N_KINDS] = {USUAL_CREDIT, USUAL_CREDIT, USUAL_CREDIT, USUAL_CREDIT};
    struct subspaces_state *s = method->state;
    struct pilot p = {.job = *job, .method = method};
    struct pixel_rect rect = rect_of(&p, 0);
    double tile = (double)rect_width(rect) * rect_height(rect);
    int tiles = int_within(SAMPLES_PER_PIXEL * pixel_light_count(job) / (RENDERS * tile) + 0.75, 1, MOST_TILES);
    int n_slots = 2 * job->n_threads;
    set_numbers(s, TRIED, credit);
    s->frozen.counts.splat = pixel_light_count(job) / s->frozen.path_pixels;
    p.job.seed = hash_combine(job->seed, 0x3c6ef372fe94f82bu); /* unlike the render's */
    struct parallel_jobs jobs = {tiles, job->n_threads, n_slots, &p, render_tile, add_tile, NULL};
    make_memory(&p, n_slots);
    parallel_run(&jobs);
    free_memory(&p, n_slots);
    if (p.sums.total > 0 && !p.stopped)
        choose_numbers(s, &p.sums);
    else
        set_numbers(s, USUAL, credit);
    exchange(s, true);
}
