/* noise.c: see noise.h. */
#include "pilot/noise.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"

/* The budget: samples for each pixel of the picture, in whole tiles. */
static const double SAMPLES_PER_PIXEL = 1.28;
enum { MOST_TILES = 8 };

/* Renders of a tile: the second shares nothing with the first, the third its eye sub-paths, the last all but the
 * counts. */
enum { FIRST, OTHER, SAME_EYE, INDEPENDENT, AGAIN = INDEPENDENT, RENDERS };

/* No squared relative deviation counts for more: a picture's white is not far off. What the path tracer would bring has
 * more leave, since nothing else warns of it. */
static const double OUTLIER = 25, OUTLIER_TAIL = 1e4;

/* A path that a strategy made. */
struct record {
    int x, y, s, t; /* of the sample's pixel */
    float unweighted[3], weight;
};
struct records {
    struct record *item; /* [n] in the order of adding; owned */
    size_t n, capacity;
};

struct measure {
    struct render_job job;
    const struct pilot_method *method;
    struct subspaces_state *state, *again; /* again: with the counts of s <= 1 twice as large */
    const double *tried;
    struct tile (*tile)[RENDERS];      /* [n_slots] */
    struct records (*records)[RENDERS]; /* [n_slots] */
    struct noise *found;          /* [n_slots] */
    struct noise sums;
    bool stopped;
};

static void note(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct records *all = context;
    rgb value = rgb_scale(path->c->value, path->scale);
    if (rgb_is_black(value) || !rgb_fits_float(value) || !rgb_fits_float(path->added))
        return;
    all->item = mem_grow(all->item, &all->capacity, all->n + 1, sizeof *all->item);
    const struct record r = {sample->x, sample->y, path->s, path->t,
                             {(float)value.r, (float)value.g, (float)value.b}, (float)path->c->weight};
    all->item[all->n++] = r;
}

static double luminance_added(const struct record *r)
{
    return rgb_luminance(rgb_of_floats(r->unweighted)) * (double)r->weight;
}

/* Where the pixel of a record lies in the tile. */
static long place_in_tile(const struct tile *tile, const struct record *r)
{
    return (long)(r->y - tile->rect.y0) * rect_width(tile->rect) + (r->x - tile->rect.x0);
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
                    out[(y - r.y0) * rect_width(r) + (x - r.x0)] += rgb_luminance(rgb_of_floats(part));
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
static int kind_of(const struct record *r)
{
    if (r->s == 1)
        return r->t == 2 ? LIGHT_FIRST : -1;
    return r->s < 2 || r->t == 1 ? -1 : r->t == 2 ? DRAW_FIRST : DRAW_LATER;
}

/* Records of one eye vertex and kind stand in a row; samples that brought nothing have none. */
static void add_records(const struct tile *tile, const struct records *all, const double *tried, const double *scale,
                        struct noise *out)
{
    for (size_t i = 0; i < all->n;) {
        const struct record *first = &all->item[i];
        int kind = kind_of(first);
        double x = 0, x2 = 0, n = kind >= 0 ? tried[kind] : 1;
        for (; i < all->n; i++) {
            const struct record *r = &all->item[i];
            if (r->x != first->x || r->y != first->y || r->t != first->t || kind_of(r) != kind)
                break;
            double one = luminance_added(r);
            x += one;
            x2 += one * one;
        }
        if (kind < 0)
            continue;
        long at = place_in_tile(tile, first);
        out->spread[kind] += fmin((x2 - x * x / n) * n / (n - 1) / scale[at], OUTLIER);
    }
}

/* See noise.h; splats come from the whole tile, wherever they land. */
static void add_tail(const struct tile *tile, const struct records *all, const struct records *again,
                     const double *scale, double mean_scale, struct noise *out)
{
    for (size_t i = 0; i < all->n && i < again->n; i++) {
        const struct record *r = &all->item[i], *a = &again->item[i];
        if (r->s + r->t < 4 || !(r->weight > 0) || !(a->weight > 0))
            continue; /* light that comes straight to the first hit has credits of its own */
        double grown = (double)a->weight / (double)r->weight, P = clamp((r->s <= 1 ? 2 : 1) / grown - 1, 1e-6, 1);
        double X2 = sqr(luminance_added(r)) / (r->t == 1 ? mean_scale : scale[place_in_tile(tile, r)]);
        out->tail += fmin(X2 * (1 / P - 1), OUTLIER_TAIL);
    }
}

/* Tile k lies around point k of an even sequence over the film. */
static struct pixel_rect rect_of(const struct measure *p, int64_t k)
{
    struct pixel_rect all = p->job.film_rect, r = {0, 0, 0, 0, 0, 0};
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

/* Half the squared differences of the blocks' sums. */
static double of_blocks(struct pixel_rect rect, const double *a, const double *b, const double *scale)
{
    enum { SIDE = 8, PIXELS = SIDE * SIDE };
    int width = rect_width(rect), height = rect_height(rect);
    double all = 0;
    for (int y = 0; y + SIDE <= height; y += SIDE)
        for (int x = 0; x + SIDE <= width; x += SIDE) {
            double difference = 0, bright = 0;
            for (int i = 0; i < PIXELS; i++) {
                int at = (y + i / SIDE) * width + x + i % SIDE;
                difference += a[at] - b[at];
                bright += scale[at] / PIXELS;
            }
            all += fmin(sqr(difference) / 2 / bright, OUTLIER * PIXELS);
        }
    return all;
}

static void render_one(struct measure *m, int64_t number, int i, struct pixel_rect rect, struct tile *tile,
                       struct records *records, struct workspace *work)
{
    struct render_job job = m->job;
    job.seed = hash_combine(m->job.seed, (uint64_t)(i % INDEPENDENT));
    job.eye_seed = hash_combine(m->job.seed, INDEPENDENT + (i == OTHER));
    const struct observer observer = {.context = records, .joined = note};
    struct tile_pass pass = {&job, rect, (long)number, (long)number + 1, tile, work, &observer};
    records->n = 0;
    tile_start(tile, rect, job.film_rect, &job.scene->filter);
    m->method->render(m->method->method, i == AGAIN ? m->again : m->state, &pass);
}

static void render_tile(void *context, int64_t job, int slot, int thread)
{
    struct measure *m = context;
    struct pixel_rect rect = rect_of(m, job);
    struct tile *tile = m->tile[slot];
    struct records *records = m->records[slot];
    size_t n = (size_t)rect_width(rect) * (size_t)rect_height(rect);
    double *value = mem_alloc((INDEPENDENT + 1) * n, sizeof *value), *scale = value + INDEPENDENT * n, mean_scale = 0;
    const double *other = value + OTHER * n, *same_eye = value + SAME_EYE * n;
    struct noise *found = &m->found[slot];
    memset(found, 0, sizeof *found);
    for (int i = 0; i < RENDERS; i++)
        render_one(m, job, i, rect, &tile[i], &records[i], &m->method->work[thread]);
    for (int i = 0; i < INDEPENDENT; i++)
        pixel_values(&tile[i], value + (size_t)i * n);
    brightness(rect, value, other, scale);
    for (int i = 0; i < INDEPENDENT; i++)
        add_records(&tile[i], &records[i], m->tried, scale, found);
    for (size_t i = 0; i < n; i++) {
        found->total += fmin(sqr(value[i] - other[i]) / 2 / scale[i], OUTLIER);
        found->given_eye += fmin(sqr(value[i] - same_eye[i]) / 2 / scale[i], OUTLIER);
        mean_scale += scale[i] / (double)n;
    }
    found->blocks = of_blocks(rect, value, same_eye, scale);
    add_tail(&tile[FIRST], &records[FIRST], &records[AGAIN], scale, mean_scale, found);
    free(value);
}

static bool add_tile(void *context, int64_t job, int slot)
{
    struct measure *m = context;
    const struct noise *s = &m->found[slot];
    double n = RENDERS * (double)(job + 1) * MAX_TILE_SIZE * MAX_TILE_SIZE;
    m->sums.total += s->total;
    m->sums.given_eye += s->given_eye;
    m->sums.blocks += s->blocks;
    m->sums.tail += s->tail;
    for (int k = 0; k < N_KINDS; k++)
        m->sums.spread[k] += s->spread[k] / INDEPENDENT;
    m->stopped = m->job.watch != NULL && !m->job.watch(m->job.watch_context, n);
    return !m->stopped;
}

int noise_tiles(const struct render_job *job)
{
    struct measure m = {.job = *job};
    struct pixel_rect rect = rect_of(&m, 0);
    double tile = (double)rect_width(rect) * rect_height(rect);
    return int_within(SAMPLES_PER_PIXEL * pixel_light_count(job) / (INDEPENDENT * tile) + 0.75, 1, MOST_TILES);
}

bool noise_measure(const struct render_job *job, const struct pilot_method *method, struct subspaces_state *state,
                   const double *tried, int n, struct noise *out)
{
    int n_slots = 2 * job->n_threads;
    struct subspaces_state twice = *state;
    struct measure m = {.job = *job, .method = method, .state = state, .again = &twice, .tried = tried};
    for (int end = 0; end < EYE_ENDS; end++) {
        twice.frozen.counts.hit[end] *= 2;
        twice.frozen.counts.direct[end] *= 2;
        twice.frozen.counts.delta[end] *= 2;
    }
    struct parallel_jobs jobs = {n, job->n_threads, n_slots, &m, render_tile, add_tile, NULL};
    m.tile = mem_alloc((size_t)n_slots, sizeof *m.tile);
    m.records = mem_alloc((size_t)n_slots, sizeof *m.records);
    m.found = mem_alloc((size_t)n_slots, sizeof *m.found);
    parallel_run(&jobs);
    for (int i = 0; i < n_slots * RENDERS; i++) {
        tile_free(&m.tile[i / RENDERS][i % RENDERS]);
        free(m.records[i / RENDERS][i % RENDERS].item);
    }
    free(m.tile);
    free(m.records);
    free(m.found);
    *out = m.sums;
    return !m.stopped;
}
