/* noise.c: see probe.h. The probe renders tiles, each three or four times; an observer notes what the paths of a tile
 * bring to each of its pixels; the notes are reduced to variances, and those of all tiles are added up.
 */
#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"
#include "learning/patience.h"
#include "learning/probe.h"

enum { MOST_SAMPLES = 8 * 1024, BLOCK = 8 };

/* Renders of a tile, by the random numbers that each shares with the first. SHARES_ALL has other counts, and serves the
 * tail alone; of the COMPARED before it the values count. */
enum { FIRST, SHARES_NOTHING, SHARES_EYE, SHARES_ALL, RENDERS, COMPARED = SHARES_ALL };

static const double CLIP_TAIL = 1e4; /* what the path tracer would bring has more leave: nothing else warns of it */

struct measure {
    const struct probe *probe;
    const double *tried;     /* [N_KINDS], or NULL */
    struct mis_counts again; /* of SHARES_ALL: those of s <= 1 are twice as large */
    struct noise *found;     /* [n_slots], of a tile */
    struct noise sums;
    struct patience patience;
};

/* --- the observer: notes of one tile ----------------------------------------------------------------- */

struct pixel {
    double value[COMPARED];          /* luminance of what t >= 2 brings */
    double spread[LIGHT_PATH], tail; /* as in struct noise, not yet divided by: */
    double scale;                    /* probe_scale, known when two renders are */
};

/* Samples of one eye vertex and one kind, which are told of in a row; those that brought nothing are not told of. */
struct row {
    int kind, t;
    struct pixel *of;
    double x, x2; /* sums of what they brought, and of its squares */
};

struct notes {
    struct measure *m;
    struct pixel_rect rect;
    struct tile tile;
    int width, height, render;
    struct pixel pixel[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* [width * height], row by row */
    double mean_scale, tail; /* tail: of t = 1, which is of no pixel */
    struct row row;
    float *weight; /* [n_weights] of the FIRST's paths, in their order; SHARES_ALL has come to number `next`; owned */
    size_t n_weights, next;
    double asked; /* see patience_lasts */
};

static struct pixel *pixel_at(struct notes *n, int x, int y)
{
    return &n->pixel[(y - n->rect.y0) / (n->rect.skip_y + 1) * n->width + (x - n->rect.x0) / (n->rect.skip_x + 1)];
}

/* -1: a strategy whose number of samples is not free, or whose samples are not those of one eye vertex. */
static int kind_of(const struct joined *p)
{
    if (p->s == 1)
        return p->t == 2 ? LIGHT_FIRST : -1;
    return p->s < 2 ? -1 : p->t == 2 ? DRAW_FIRST : DRAW_LATER;
}

/* The row is complete. Of n samples it has the variance of the sum: n/(n-1) (sum of x^2 - (sum of x)^2 / n). */
static void end_row(struct notes *notes)
{
    struct row *r = &notes->row;
    double n = r->kind >= 0 && notes->m->tried != NULL ? notes->m->tried[r->kind] : 1;
    if (n > 1)
        r->of->spread[r->kind] += (r->x2 - r->x * r->x / n) * n / (n - 1) / COMPARED;
    *r = (struct row){.kind = -1};
}

static void add_to_row(struct notes *n, struct pixel *of, const struct joined *path, double x)
{
    struct row *r = &n->row;
    int kind = kind_of(path);
    if (kind != r->kind || path->t != r->t || of != r->of) {
        end_row(n);
        *r = (struct row){kind, path->t, of, 0, 0};
    }
    r->x += x;
    r->x2 += x * x;
}

/* X^2 (1/P - 1) of probe.h. With counts of s <= 1 twice as large the weights of a path grow by 2 / (1 + P) if it is of
 * those itself, else by 1 / (1 + P): `before` and now give P. */
static void add_tail(struct notes *n, struct pixel *of, const struct joined *path, double x)
{
    double before = n->next < n->n_weights ? (double)n->weight[n->next++] : 0, now = path->c->weight;
    if (path->s + path->t < 4 || !(before > 0) || !(now > 0))
        return; /* light that comes straight to the first hit has credits of its own */
    double P = clamp((path->s <= 1 ? 2 : 1) * before / now - 1, 1e-6, 1);
    *(path->t == 1 ? &n->tail : &of->tail) += sqr(x * before / now) * (1 / P - 1);
}

static void note(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    struct notes *n = context;
    struct pixel *of = pixel_at(n, sample->x, sample->y);
    double C = rgb_luminance(path->c->value) * path->scale, x = C * path->c->weight;
    if (!(C > 0) || !fits_float(C))
        return;
    if (n->render == SHARES_ALL) {
        add_tail(n, of, path, x);
        return;
    }
    if (n->render == FIRST) {
        n->weight = mem_append(n->weight, n->n_weights, sizeof *n->weight);
        n->weight[n->n_weights++] = (float)path->c->weight;
    }
    if (path->t > 1) {
        of->value[n->render] += x;
        add_to_row(n, of, path, x);
    }
}

/* --- the reducer: from notes to variances ------------------------------------------------------------ */

/* Mean light of pixels x0 .. x1-1 of rows y0 .. y1-1. */
static double mean_light(const struct notes *n, int x0, int y0, int x1, int y1)
{
    double sum = 0;
    for (int y = y0; y < y1; y++)
        for (const struct pixel *p = &n->pixel[y * n->width + x0]; p < &n->pixel[y * n->width + x1]; p++)
            sum += p->value[FIRST] + p->value[SHARES_NOTHING];
    return sum / (2.0 * (x1 - x0) * (y1 - y0));
}

/* The light around a pixel is that of a square of 4x4 that it lies in. */
static void find_scales(struct notes *n)
{
    enum { AROUND = 4 };
    double all = mean_light(n, 0, 0, n->width, n->height);
    for (int y = 0; y < n->height; y++)
        for (int x = 0; x < n->width; x++) {
            int x0 = x / AROUND * AROUND, x1 = x0 + AROUND < n->width ? x0 + AROUND : n->width;
            int y0 = y / AROUND * AROUND, y1 = y0 + AROUND < n->height ? y0 + AROUND : n->height;
            double scale = probe_scale(mean_light(n, x0, y0, x1, y1), all);
            n->pixel[y * n->width + x].scale = scale;
            n->mean_scale += scale / (n->width * n->height);
        }
}

/* Half the squared differences of means over blocks of the film, times their pixels; a block holds w x h of the
 * tile's. */
static double variance_of_blocks(const struct notes *n)
{
    int w = (BLOCK + n->rect.skip_x) / (n->rect.skip_x + 1), h = (BLOCK + n->rect.skip_y) / (n->rect.skip_y + 1);
    double all = 0;
    for (int y = 0; y + h <= n->height; y += h)
        for (int x = 0; x + w <= n->width; x += w) {
            double difference = 0, scale = 0;
            for (int i = 0; i < w * h; i++) {
                const struct pixel *p = &n->pixel[(y + i / w) * n->width + x + i % w];
                difference += p->value[FIRST] - p->value[SHARES_EYE];
                scale += p->scale;
            }
            all += fmin(sqr(difference) / 2 * (w * h) / scale, PROBE_CLIP * w * h);
        }
    return all;
}

static double clip(double square, double scale) { return fmin(square / scale, PROBE_CLIP); }

/* Squares of what splats bring: to the tile's pixels, between them, or elsewhere. */
static double squares_of_splats(struct notes *n)
{
    const struct tile *tile = &n->tile;
    struct pixel_rect r = n->rect;
    double sum = 0;
    for (const struct splat *s = tile->splat; s < tile->splat + tile->n_splats; s++) {
        struct pixel_rect range = splat_pixels(s, tile->filter, tile->film_rect);
        float part[3];
        for (int y = range.y0; y < range.y1; y++)
            for (int x = range.x0; x < range.x1; x++) {
                bool inside = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
                if (splat_part(s, tile->filter, x, y, part))
                    sum += clip(sqr(rgb_luminance(rgb_of_floats(part))),
                                inside ? pixel_at(n, x, y)->scale : n->mean_scale);
            }
    }
    return sum;
}

static struct noise reduce(const struct notes *n, double splats)
{
    struct noise found = {.blocks = variance_of_blocks(n) + splats, .tail = fmin(n->tail / n->mean_scale, CLIP_TAIL)};
    for (const struct pixel *p = n->pixel; p < n->pixel + n->width * n->height; p++) {
        found.total += clip(sqr(p->value[FIRST] - p->value[SHARES_NOTHING]) / 2, p->scale);
        found.given_eye += clip(sqr(p->value[FIRST] - p->value[SHARES_EYE]) / 2, p->scale);
        found.tail += fmin(p->tail / p->scale, CLIP_TAIL);
        for (int k = 0; k < LIGHT_PATH; k++)
            found.spread[k] += clip(p->spread[k], p->scale);
    }
    found.total += splats;
    found.given_eye += splats;
    return found;
}

/* --- the probe: tiles over the film ------------------------------------------------------------------ */

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

static bool enough(void *context)
{
    struct notes *n = context;
    return !patience_lasts(&n->m->patience, &n->asked);
}

static void render_tile(void *context, int64_t number, int slot, int thread)
{
    struct measure *m = context;
    const struct probe *p = m->probe;
    struct notes *n = mem_alloc(1, sizeof *n);
    const struct observer observer = {.context = n, .joined = note};
    double splats = 0;
    n->m = m;
    n->rect = rect_of(p, number);
    n->width = rect_width(n->rect);
    n->height = rect_height(n->rect);
    n->row.kind = -1;
    for (n->render = FIRST; n->render < RENDERS; n->render++) {
        if (n->render == SHARES_EYE && m->tried == NULL)
            continue;
        struct render_job job = probe_job(p->job, (uint64_t)(n->render % COMPARED));
        job.eye_seed = probe_job(p->job, COMPARED + (n->render == SHARES_NOTHING)).seed;
        job.enough = enough;
        job.enough_context = n;
        struct tile_pass pass = {&job, n->rect, (long)number, (long)number + 1, &n->tile, &p->work[thread], &observer};
        tile_start(&n->tile, n->rect, job.film_rect, &job.scene->filter);
        p->render(p->method, n->render == SHARES_ALL ? &m->again : p->counts, &pass);
        end_row(n);
        if (n->render == SHARES_NOTHING) {
            find_scales(n);
            splats = squares_of_splats(n);
        }
    }
    m->found[slot] = reduce(n, splats);
    tile_free(&n->tile);
    free(n->weight);
    free(n);
}

static bool add_tile(void *context, int64_t number, int slot)
{
    struct measure *m = context;
    const struct noise *s = &m->found[slot];
    (void)number;
    m->sums.total += s->total;
    m->sums.given_eye += s->given_eye;
    m->sums.blocks += s->blocks;
    m->sums.tail += s->tail;
    for (int k = 0; k < LIGHT_PATH; k++)
        m->sums.spread[k] += s->spread[k];
    return patience_count(&m->patience, RENDERS * sqr(m->probe->size.tile));
}

struct noise noise_measure(const struct probe *p, const double *tried, double samples)
{
    const struct noise nothing = {.total = 0};
    struct measure m = {.probe = p, .tried = tried, .again = *p->counts, .patience = patience_begin(p->job)};
    int tile = (int)rect_pixels(rect_of(p, 0)), n_slots = 2 * p->job->n_threads;
    int n = int_within(samples * pixel_light_count(p->job) / tile + 0.75, 1, MOST_SAMPLES / tile);
    for (int end = 0; end < EYE_ENDS; end++) {
        m.again.hit[end] *= 2;
        m.again.direct[end] *= 2;
        m.again.delta[end] *= 2;
    }
    m.found = mem_alloc((size_t)n_slots, sizeof *m.found);
    struct parallel_jobs jobs = {n, p->job->n_threads, n_slots, &m, render_tile, add_tile, NULL};
    parallel_run(&jobs);
    patience_end(&m.patience);
    free(m.found);
    return m.patience.over ? nothing : m.sums;
}
