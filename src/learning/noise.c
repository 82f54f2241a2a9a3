/* noise.c: see probe.h. */
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"
#include "learning/patience.h"
#include "learning/probe.h"

enum { MOST_SAMPLES = 8 * 1024, BLOCK = 8 };

/* Renders of a tile: the second shares nothing with the first, the third its eye sub-paths, the last all but the
 * counts. */
enum { FIRST, OTHER, SAME_EYE, INDEPENDENT, AGAIN = INDEPENDENT, RENDERS };

static const double CLIP_TAIL = 1e4; /* what the path tracer would bring has more leave: nothing else warns of it */

/* Where a tile's pixels lie; what is known of one of them before it is known how bright it is. */
struct pixel {
    double value[INDEPENDENT]; /* luminance of what t >= 2 brings */
    double spread[LIGHT_PATH], tail, scale;
};

/* A tile, being measured. */
struct tile_noise {
    struct pixel_rect rect;
    const double *tried;
    struct patience *patience;
    double asked;
    struct pixel pixel[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* row by row */
    int render;                      /* which of them */
    double tail, mean_scale;         /* tail: of t = 1 */
    float *weight;                   /* [n_weights] of the first's paths, in their order; owned */
    size_t n_weights, capacity, next;
    /* The samples of one eye vertex and kind, which stand in a row; those that brought nothing are not told of: */
    int kind, t;
    struct pixel *of;
    double x, x2;
    struct noise found;
};

static struct pixel *pixel_at(struct tile_noise *m, int x, int y)
{
    int i = (x - m->rect.x0) / (m->rect.skip_x + 1), j = (y - m->rect.y0) / (m->rect.skip_y + 1);
    return &m->pixel[j * rect_width(m->rect) + i];
}

/* -1: a strategy whose number of samples is not free, or whose samples are not those of one eye vertex. */
static int kind_of(const struct joined *p)
{
    if (p->s == 1)
        return p->t == 2 ? LIGHT_FIRST : -1;
    return p->s < 2 ? -1 : p->t == 2 ? DRAW_FIRST : DRAW_LATER;
}

/* The variance of the sum of n samples of one eye vertex, when all have been told of. */
static void end_vertex(struct tile_noise *m)
{
    double n = m->kind >= 0 ? m->tried[m->kind] : 1;
    if (m->kind >= 0 && n > 1)
        m->of->spread[m->kind] += (m->x2 - m->x * m->x / n) * n / (n - 1) / INDEPENDENT;
    m->kind = -1;
    m->x = m->x2 = 0;
}

static void add_sample(struct tile_noise *m, struct pixel *of, const struct joined *path, double x)
{
    int kind = kind_of(path);
    if (kind != m->kind || path->t != m->t || of != m->of)
        end_vertex(m);
    m->kind = kind;
    m->t = path->t;
    m->of = of;
    m->x += x;
    m->x2 += x * x;
}

/* What the path tracer would bring more: from the path's weight before, and now. */
static void add_tail(struct tile_noise *m, struct pixel *of, const struct joined *path, double x)
{
    double before = m->next < m->n_weights ? (double)m->weight[m->next++] : 0, w = path->c->weight;
    if (path->s + path->t < 4 || !(before > 0) || !(w > 0))
        return; /* light that comes straight to the first hit has credits of its own */
    double P = clamp((path->s <= 1 ? 2 : 1) * before / w - 1, 1e-6, 1);
    *(path->t == 1 ? &m->tail : &of->tail) += sqr(x * before / w) * (1 / P - 1);
}

static void note(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct tile_noise *m = context;
    double C = rgb_luminance(path->c->value) * path->scale, x = C * path->c->weight;
    struct pixel *of = pixel_at(m, sample->x, sample->y);
    if (!(C > 0) || !fits_float(C))
        return;
    if (m->render == AGAIN) {
        add_tail(m, of, path, x);
        return;
    }
    if (m->render == FIRST) {
        m->weight = mem_grow(m->weight, &m->capacity, m->n_weights + 1, sizeof *m->weight);
        m->weight[m->n_weights++] = (float)path->c->weight;
    }
    if (path->t > 1) {
        of->value[m->render] += x;
        add_sample(m, of, path, x);
    }
}

/* What squares are divided by, by pixel, from what is around it. */
static void find_scales(struct tile_noise *m)
{
    enum { AROUND = 4 };
    int width = rect_width(m->rect), height = rect_height(m->rect);
    double all = 0;
    for (int i = 0; i < width * height; i++)
        all += (m->pixel[i].value[FIRST] + m->pixel[i].value[OTHER]) / (2.0 * width * height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int x0 = x / AROUND * AROUND, y0 = y / AROUND * AROUND, n = 0;
            double sum = 0;
            for (int j = y0; j < height && j < y0 + AROUND; j++)
                for (int i = x0; i < width && i < x0 + AROUND; i++, n += 2)
                    sum += m->pixel[j * width + i].value[FIRST] + m->pixel[j * width + i].value[OTHER];
            m->pixel[y * width + x].scale = probe_scale(sum / n, all);
            m->mean_scale += m->pixel[y * width + x].scale / (width * height);
        }
}

static double clip(double square, double scale) { return fmin(square / scale, PROBE_CLIP); }

/* Half the squared differences of what the tile has in the film's blocks. */
static double of_blocks(const struct tile_noise *m)
{
    int width = rect_width(m->rect), height = rect_height(m->rect);
    int w = (BLOCK + m->rect.skip_x) / (m->rect.skip_x + 1), h = (BLOCK + m->rect.skip_y) / (m->rect.skip_y + 1);
    double all = 0;
    for (int y = 0; y + h <= height; y += h)
        for (int x = 0; x + w <= width; x += w) {
            double difference = 0, scale = 0;
            for (int i = 0; i < w * h; i++) {
                const struct pixel *p = &m->pixel[(y + i / w) * width + x + i % w];
                difference += p->value[FIRST] - p->value[SAME_EYE];
                scale += p->scale;
            }
            all += fmin(sqr(difference) / 2 * (w * h) / scale, PROBE_CLIP * w * h);
        }
    return all;
}

/* Splats land on the tile's pixels, between them, or elsewhere. */
static double of_splats(struct tile_noise *m, const struct tile *tile)
{
    struct pixel_rect r = m->rect;
    double sum = 0;
    for (const struct splat *s = tile->splat; s < tile->splat + tile->n_splats; s++) {
        struct pixel_rect range = splat_pixels(s, tile->filter, tile->film_rect);
        float part[3];
        for (int y = range.y0; y < range.y1; y++)
            for (int x = range.x0; x < range.x1; x++)
                if (splat_part(s, tile->filter, x, y, part)) {
                    bool near = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
                    sum += clip(sqr(rgb_luminance(rgb_of_floats(part))),
                                near ? pixel_at(m, x, y)->scale : m->mean_scale);
                }
    }
    return sum;
}

static void reduce(struct tile_noise *m)
{
    struct noise *n = &m->found;
    n->tail = fmin(m->tail / m->mean_scale, CLIP_TAIL);
    n->blocks = of_blocks(m);
    for (const struct pixel *p = m->pixel; p < m->pixel + rect_width(m->rect) * rect_height(m->rect); p++) {
        n->total += clip(sqr(p->value[FIRST] - p->value[OTHER]) / 2, p->scale);
        n->given_eye += clip(sqr(p->value[FIRST] - p->value[SAME_EYE]) / 2, p->scale);
        n->tail += fmin(p->tail / p->scale, CLIP_TAIL);
        for (int k = 0; k < LIGHT_PATH; k++)
            n->spread[k] += clip(p->spread[k], p->scale);
    }
}

/* --- tiles ------------------------------------------------------------------------------------------- */

struct measure {
    const struct probe *probe;
    const double *tried;
    struct mis_counts again; /* with the counts of s <= 1 twice as large */
    struct tile *tile;       /* [n_threads] */
    struct noise *found;     /* [n_slots] */
    struct noise sums;
    struct patience patience;
};

static bool enough(void *context)
{
    struct tile_noise *t = context;
    return !patience_lasts(t->patience, &t->asked);
}

/* On one axis of n pixels: as many as a tile has, as far apart as the render's, around point u. */
static void lay(const struct pass_size *size, int n, double u, int *begin, int *end, int *skip)
{
    *skip = (int)clamp((n + size->tile / 2) / size->tile, 1, size->spread) - 1;
    int reach = (size->tile - 1) * (*skip + 1) + 1 < n ? (size->tile - 1) * (*skip + 1) + 1 : n;
    *begin += (int)(u * (n - reach + 1));
    *end = *begin + reach;
}

/* Tile k lies around point k of an even sequence over the film. */
static struct pixel_rect rect_of(const struct probe *p, int64_t k)
{
    struct pixel_rect r = p->job->film_rect;
    double u, v;
    sampler_r2(k, &u, &v);
    lay(&p->size, rect_width(r), u, &r.x0, &r.x1, &r.skip_x);
    lay(&p->size, rect_height(r), v, &r.y0, &r.y1, &r.skip_y);
    return r;
}

static void render_tile(void *context, int64_t number, int slot, int thread)
{
    struct measure *m = context;
    const struct probe *p = m->probe;
    struct tile_noise *t = mem_alloc(1, sizeof *t);
    struct tile *tile = &m->tile[thread];
    const struct observer observer = {.context = t, .joined = note};
    t->rect = rect_of(p, number);
    t->tried = m->tried;
    t->patience = &m->patience;
    t->kind = -1;
    for (t->render = 0; t->render < RENDERS; t->render++) {
        struct render_job job = probe_job(p->job, (uint64_t)(t->render % INDEPENDENT));
        job.enough = enough;
        job.enough_context = t;
        job.eye_seed = probe_job(p->job, INDEPENDENT + (t->render == OTHER)).seed;
        struct tile_pass pass = {&job, t->rect, (long)number, (long)number + 1, tile, &p->work[thread], &observer};
        tile_start(tile, t->rect, job.film_rect, &job.scene->filter);
        p->render(p->method, t->render == AGAIN ? &m->again : p->counts, &pass);
        end_vertex(t);
        if (t->render == OTHER)
            find_scales(t);
        if (t->render == SAME_EYE)
            t->found.splats = of_splats(t, tile);
    }
    reduce(t);
    m->found[slot] = t->found;
    free(t->weight);
    free(t);
}

static bool add_tile(void *context, int64_t number, int slot)
{
    struct measure *m = context;
    const struct noise *s = &m->found[slot];
    (void)number;
    m->sums.total += s->total + s->splats;
    m->sums.given_eye += s->given_eye + s->splats;
    m->sums.blocks += s->blocks + s->splats;
    m->sums.splats += s->splats;
    m->sums.tail += s->tail;
    for (int k = 0; k < LIGHT_PATH; k++)
        m->sums.spread[k] += s->spread[k];
    return patience_count(&m->patience, RENDERS * sqr(m->probe->size.tile));
}

struct noise noise_measure(const struct probe *p, const double *tried, double samples)
{
    const struct noise nothing = {0, 0, 0, 0, 0, {0}};
    struct measure m = {.probe = p, .tried = tried, .again = *p->counts,
                        .patience = patience_begin(p->job)};
    struct pixel_rect rect = rect_of(p, 0);
    int tile = rect_width(rect) * rect_height(rect), n_slots = 2 * p->job->n_threads;
    int n = int_within(samples * pixel_light_count(p->job) / tile + 0.75, 1, MOST_SAMPLES / tile);
    for (int end = 0; end < EYE_ENDS; end++) {
        m.again.hit[end] *= 2;
        m.again.direct[end] *= 2;
        m.again.delta[end] *= 2;
    }
    m.tile = mem_alloc((size_t)p->job->n_threads, sizeof *m.tile);
    m.found = mem_alloc((size_t)n_slots, sizeof *m.found);
    struct parallel_jobs jobs = {n, p->job->n_threads, n_slots, &m, render_tile, add_tile, NULL};
    parallel_run(&jobs);
    for (int i = 0; i < p->job->n_threads; i++)
        tile_free(&m.tile[i]);
    patience_end(&m.patience);
    free(m.tile);
    free(m.found);
    return m.patience.over ? nothing : m.sums;
}
