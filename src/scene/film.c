/* film.c: see film.h. */
#include "scene/film.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"

/* What a float cannot hold is no part of a picture; squares of the rest stay far from overflow. */
static bool fits(rgb c) { return fits_float(c.r) && fits_float(c.g) && fits_float(c.b); }

/* --- tiles ------------------------------------------------------------------------------------------- */

void tile_start(struct tile *t, struct pixel_rect rect, struct pixel_rect film_rect, const struct filter *filter,
                bool keep_records)
{
    size_t n = rect_pixels(rect) * 3;
    t->rect = rect;
    t->film_rect = film_rect;
    t->filter = filter;
    size_t sums = n * (size_t)plane_count(t->planes);
    t->sum = mem_grow(t->sum, &t->capacity, sums, sizeof *t->sum);
    t->square = mem_grow(t->square, &t->square_capacity, n, sizeof *t->square);
    memset(t->sum, 0, sums * sizeof *t->sum);
    memset(t->square, 0, n * sizeof *t->square);
    t->n_splats = t->n_records = 0;
    t->keep_records = keep_records;
    t->first_half = false;
    t->gate.begin = 0;
    t->gate.end = INFINITY;
    t->nonfinite = 0;
}

void tile_free(struct tile *t)
{
    free(t->sum);
    free(t->square);
    free(t->splat);
    free(t->record);
    memset(t, 0, sizeof *t);
}

static void make_room(struct tile *t)
{
    if (t->full != NULL && (t->n_splats >= TILE_FULL || t->n_records >= TILE_FULL))
        t->full(t->context, t);
}

static size_t place_of(const struct tile *t, int x, int y)
{
    int column = (x - t->rect.x0) / (t->rect.skip_x + 1), row = (y - t->rect.y0) / (t->rect.skip_y + 1);
    return 3 * ((size_t)row * (size_t)rect_width(t->rect) + (size_t)column);
}

/* What no float holds is left out of every sum alike. */
static rgb term(rgb c) { return fits(c) ? c : rgb_black(); }

/* Add the difference to three sums, as two terms each. */
static void add_difference(struct exact_sum *sum, rgb a, rgb b)
{
    const double plus[3] = {a.r, a.g, a.b}, minus[3] = {b.r, b.g, b.b};
    for (size_t c = 0; c < 3; c++) {
        exact_add(&sum[c], plus[c]);
        exact_add(&sum[c], -minus[c]);
    }
}

void tile_add_between(struct tile *t, int x, int y, rgb until, rgb before)
{
    make_room(t);
    t->nonfinite += !fits(until);
    until = term(until);
    before = term(before);
    size_t i = place_of(t, x, y);
    add_difference(&t->sum[i], until, before);
    t->square[i] += sqr(until.r - before.r);
    t->square[i + 1] += sqr(until.g - before.g);
    t->square[i + 2] += sqr(until.b - before.b);
}

/* Where a pixel has its place in a plane. */
static struct exact_sum *in_plane(struct tile *t, int plane, int x, int y)
{
    return &t->sum[(size_t)plane * 3 * rect_pixels(t->rect) + place_of(t, x, y)];
}

void tile_add_light(struct tile *t, int x, int y, int lights, rgb after, rgb before)
{
    add_difference(in_plane(t, 1 + lights, x, y), term(after), term(before));
}

void tile_add_alpha(struct tile *t, int x, int y, double alpha)
{
    add_difference(in_plane(t, 1 + t->planes.lights, x, y), rgb_grey(alpha), rgb_black());
}

static int32_t film_pixel(const struct tile *t, int x, int y)
{
    return (int32_t)((y - t->film_rect.y0) * rect_width(t->film_rect) + (x - t->film_rect.x0));
}

/* First pixel whose filter covers the raster coordinate p on one axis, and the one after the last. */
static void filter_span(double p, double radius, int low, int high, int *first, int *end)
{
    double a = floor(p - radius + 0.5), b = floor(p + radius - 0.5); /* |p - (i + 0.5)| <= radius */
    if (2 * radius == 1) /* half-open: a point belongs to exactly one pixel */
        a = b = floor(p);
    *first = int_within(a, low, high); /* a NaN covers nothing */
    *end = int_within(b + 1, low, high);
}

struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within)
{
    struct pixel_rect r = {0, 0, 0, 0, 0, 0};
    filter_span(s->px, filter->radius[0], within.x0, within.x1, &r.x0, &r.x1);
    filter_span(s->py, filter->radius[1], within.y0, within.y1, &r.y0, &r.y1);
    return r;
}

static double filter_at(const struct filter *f, const struct splat *s, int x, int y)
{
    return filter_eval(f, s->px - (x + 0.5), s->py - (y + 0.5));
}

bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3])
{
    rgb part = rgb_scale(s->value, filter_at(filter, s, x, y));
    if (!fits(part))
        return false;
    out[0] = (float)part.r;
    out[1] = (float)part.g;
    out[2] = (float)part.b;
    return true;
}

bool tile_add_splat(struct tile *t, double px, double py, rgb value, double length, int lights)
{
    if (!fits(value)) {
        t->nonfinite++;
        return false;
    }
    struct splat s = {px, py, value, length, lights};
    t->splat = mem_grow(t->splat, &t->splat_capacity, t->n_splats + 1, sizeof *t->splat);
    t->splat[t->n_splats++] = s;
    return true;
}

static void record(struct tile *tile, int32_t at, int s, int t, rgb unweighted, double weight, double length)
{
    if (!tile->keep_records || !fits(unweighted) || !fits_float(weight))
        return;
    tile->record = mem_grow(tile->record, &tile->record_capacity, tile->n_records + 1, sizeof *tile->record);
    struct strategy_record *r = &tile->record[tile->n_records++];
    r->at = at;
    r->s = (int16_t)s;
    r->t = (int16_t)t;
    r->unweighted[0] = (float)unweighted.r;
    r->unweighted[1] = (float)unweighted.g;
    r->unweighted[2] = (float)unweighted.b;
    r->weight = (float)weight;
    r->length = length;
}

void tile_record_eye(struct tile *tile, int x, int y, int s, int t, rgb unweighted, double weight, double length)
{
    record(tile, film_pixel(tile, x, y), s, t, unweighted, weight, length);
}

void tile_record_splat(struct tile *tile, int s, rgb unweighted, double weight, double length)
{
    record(tile, (int32_t)tile->n_splats - 1, s, 1, unweighted, weight, length);
}

/* --- the film ---------------------------------------------------------------------------------------- */

void film_init(struct film *f, struct pixel_rect rect, int full_width, int full_height)
{
    memset(f, 0, sizeof *f);
    f->rect = rect;
    f->full_width = full_width;
    f->full_height = full_height;
    f->block.in = mem_alloc(rect_pixels(rect), sizeof *f->block.in);
    film_keep_planes(f, f->planes);
}

void film_free(struct film *f)
{
    free(f->sum);
    free(f->block.in);
    free(f->block.splat);
    free(f->half);
    if (f->errors != NULL) {
        free(f->errors->eye);
        free(f->errors->square);
        free(f->errors);
    }
    if (f->strategies != NULL) {
        free(f->strategies->unweighted);
        free(f->strategies->weighted);
        free(f->strategies);
    }
    if (f->gates != NULL) {
        free(f->gates->sum);
        free(f->gates);
    }
    memset(f, 0, sizeof *f);
}

int strategy_count(int max_depth) { return strategy_index(0, max_depth + 3); }

/* Paths of n = s + t vertices have n strategies (t = 1 .. n) and come after the 2 + ... + (n-1) of shorter ones. */
int strategy_index(int s, int t)
{
    int n = s + t;
    return n * (n - 1) / 2 - 1 + s;
}

void film_keep_planes(struct film *f, struct planes planes)
{
    free(f->sum);
    free(f->block.splat);
    f->planes = planes;
    f->sum = mem_alloc(rect_pixels(f->rect) * 3, (size_t)plane_count(planes) * sizeof *f->sum);
    f->block.splat = mem_alloc(film_splat_sums(f), sizeof *f->block.splat);
}

void film_keep_errors(struct film *f)
{
    f->errors = mem_alloc(1, sizeof *f->errors);
    f->errors->eye = mem_alloc(rect_pixels(f->rect) * 3, sizeof(double));
    f->errors->square = mem_alloc(rect_pixels(f->rect) * 3, sizeof(double));
}

void film_keep_halves(struct film *f)
{
    f->half = mem_alloc(rect_pixels(f->rect) * 3, sizeof *f->half);
    for (int i = 0; i < N_NOISE_SCALES; i++)
        f->noise[i].value = f->noise[i].error = INFINITY;
}

void film_keep_strategies(struct film *f, int max_depth)
{
    size_t n = rect_pixels(f->rect) * 3 * (size_t)strategy_count(max_depth);
    f->strategies = mem_alloc(1, sizeof *f->strategies);
    f->strategies->max_depth = max_depth;
    f->strategies->unweighted = mem_alloc(n, sizeof(double));
    f->strategies->weighted = mem_alloc(n, sizeof(double));
}

void film_keep_gates(struct film *f, struct gates gates)
{
    f->gates = mem_alloc(1, sizeof *f->gates);
    f->gates->gates = gates;
    f->gates->sum = mem_alloc(rect_pixels(f->rect) * 3 * (size_t)gates.n, sizeof(double));
}

static size_t pixel_of(const struct film *f, int x, int y)
{
    return (size_t)(y - f->rect.y0) * (size_t)rect_width(f->rect) + (size_t)(x - f->rect.x0);
}

static void add_to_strategy(struct film *f, const struct strategy_record *r, size_t pixel, double h)
{
    size_t at = 3 * ((size_t)strategy_index(r->s, r->t) * rect_pixels(f->rect) + pixel);
    for (size_t c = 0; c < 3; c++) {
        double unweighted = (double)r->unweighted[c] * h;
        f->strategies->unweighted[at + c] += unweighted;
        f->strategies->weighted[at + c] += unweighted * (double)r->weight;
    }
}

static void add_to_gate(struct film *f, const struct strategy_record *r, size_t pixel, double h)
{
    const struct gates *g = &f->gates->gates;
    double number = floor((r->length - g->begin) / g->width);
    if (!(number >= 0 && number < g->n))
        return;
    size_t at = 3 * ((size_t)number * rect_pixels(f->rect) + pixel);
    for (size_t c = 0; c < 3; c++)
        f->gates->sum[at + c] += (double)r->unweighted[c] * (double)r->weight * h;
}

static void add_record(struct film *f, const struct strategy_record *r, size_t pixel, double h)
{
    if (f->strategies != NULL)
        add_to_strategy(f, r, pixel, h);
    if (f->gates != NULL)
        add_to_gate(f, r, pixel, h);
}

static void add_records(struct film *f, const struct tile *t)
{
    for (size_t i = 0; i < t->n_records; i++) {
        const struct strategy_record *r = &t->record[i];
        if (r->t > 1) {
            add_record(f, r, (size_t)r->at, 1);
            continue;
        }
        const struct splat *s = &t->splat[r->at];
        struct pixel_rect range = splat_pixels(s, t->filter, f->rect);
        for (int y = range.y0; y < range.y1; y++)
            for (int x = range.x0; x < range.x1; x++)
                add_record(f, r, pixel_of(f, x, y), filter_at(t->filter, s, x, y));
    }
}

static void add_to_plane(struct film *f, size_t i, float part)
{
    exact_add(&f->sum[i], (double)part);
    f->block.splat[i] += part;
}

static void add_splat(struct film *f, const struct splat *s, const struct filter *filter, bool first_half)
{
    struct pixel_rect range = splat_pixels(s, filter, f->rect);
    size_t plane = (size_t)(1 + s->lights) * 3 * rect_pixels(f->rect);
    for (int y = range.y0; y < range.y1; y++)
        for (int x = range.x0; x < range.x1; x++) {
            float part[3];
            size_t at = 3 * pixel_of(f, x, y);
            bool ok = splat_part(s, filter, x, y, part);
            f->nonfinite += !ok;
            for (size_t c = 0; ok && c < 3; c++) {
                add_to_plane(f, at + c, part[c]);
                if (first_half)
                    exact_add(&f->half[at + c], (double)part[c]);
                if (f->planes.lights > 0)
                    add_to_plane(f, plane + at + c, part[c]);
                if (f->errors != NULL)
                    f->errors->square[at + c] += sqr((double)part[c]);
            }
        }
}

void film_take_splats(struct film *f, struct tile *t)
{
    for (size_t i = 0; i < t->n_splats; i++)
        add_splat(f, &t->splat[i], t->filter, f->half != NULL && t->first_half);
    if (film_keeps_records(f))
        add_records(f, t);
    t->n_splats = t->n_records = 0;
}

void film_merge_tile(struct film *f, struct tile *t)
{
    size_t from = 0, film_plane = 3 * rect_pixels(f->rect), tile_plane = 3 * rect_pixels(t->rect);
    for (int y = t->rect.y0; y < t->rect.y1; y += t->rect.skip_y + 1)
        for (int x = t->rect.x0; x < t->rect.x1; x += t->rect.skip_x + 1)
            for (size_t to = 3 * pixel_of(f, x, y), c = 0; c < 3; c++, to++, from++) {
                for (size_t p = 0; p < (size_t)plane_count(f->planes); p++)
                    f->nonfinite += !exact_join(&f->sum[p * film_plane + to], &t->sum[p * tile_plane + from]);
                if (f->half != NULL && t->first_half) /* part of the sum: it cannot overflow before it */
                    exact_join(&f->half[to], &t->sum[from]);
                if (f->errors != NULL) {
                    f->errors->eye[to] += exact_value(&t->sum[from]);
                    f->errors->square[to] += t->square[from];
                }
            }
    film_take_splats(f, t);
    film_mark(f, t->rect);
    f->nonfinite += t->nonfinite;
}

void film_mark(struct film *f, struct pixel_rect tile)
{
    for (int y = tile.y0; y < tile.y1; y += tile.skip_y + 1)
        for (int x = tile.x0; x < tile.x1; x += tile.skip_x + 1)
            f->block.in[pixel_of(f, x, y)] = true;
    f->block.n_in += rect_pixels(tile);
}

void film_end_block(struct film *f)
{
    f->iterations += f->block.iterations;
    f->passes = 0;
    f->block.n_in = 0;
    memset(f->block.in, 0, rect_pixels(f->rect) * sizeof *f->block.in);
    memset(f->block.splat, 0, film_splat_sums(f) * sizeof *f->block.splat);
}

double film_samples(const struct film *f)
{
    double share = (double)f->block.n_in / (double)rect_pixels(f->rect);
    return (double)f->iterations + share * (double)f->block.iterations;
}

double film_value(const struct film *f, size_t i) { return exact_value(&f->sum[i]); }

long film_develop(const struct film *f, double scale, float *out) { return film_develop_plane(f, 0, scale, out); }

static long samples_of(const struct film *f, size_t pixel)
{
    return f->iterations + (f->block.in[pixel] ? f->block.iterations : 0);
}

/* A pixel's value in a plane. Of a block under way pixels that are in have their own samples, but every pixel has the
 * splats of all that are in: where its samples count these are made to stand for the splats of all, else taken out. */
static double mean_in_plane(const struct film *f, size_t plane, size_t i, double scale)
{
    size_t n = rect_pixels(f->rect);
    long iterations = samples_of(f, i / 3);
    double sum = film_value(f, plane * 3 * n + i), all = f->block.in[i / 3] ? (double)n / (double)f->block.n_in : 0;
    if (f->block.n_in > 0 && plane <= (size_t)f->planes.lights)
        sum += (all - 1) * (double)f->block.splat[plane * 3 * n + i];
    return iterations > 0 ? sum * (scale / (double)iterations) : 0;
}

long film_develop_plane(const struct film *f, int plane, double scale, float *out)
{
    long cut = 0;
    for (size_t i = 0; i < rect_pixels(f->rect) * 3; i++) {
        double value = mean_in_plane(f, (size_t)plane, i, scale);
        cut += !fits_float(value);
        out[i] = float_within(value);
    }
    return cut;
}

float *film_alpha(const struct film *f)
{
    if (!f->planes.alpha)
        return NULL;
    float *out = mem_alloc(rect_pixels(f->rect) * 3, sizeof *out);
    film_develop_plane(f, 1 + f->planes.lights, 1, out);
    return out;
}

void film_warn(const struct film *f, long cut)
{
    if (f->nonfinite > 0)
        fprintf(stderr, "asbdpt: warning: %ld contributions were not finite, or too large, and were left out\n",
                f->nonfinite);
    if (cut > 0)
        fprintf(stderr, "asbdpt: warning: %ld pixel values were beyond 3.4e38 and were cut to it\n", cut);
}

void film_standard_error(const struct film *f, double scale, float *out)
{
    size_t n = rect_pixels(f->rect) * 3;
    for (size_t i = 0; i < n; i++) {
        double k = (double)samples_of(f, i / 3);
        double variance = (f->errors->square[i] - sqr(f->errors->eye[i]) / k) / (k * (k - 1));
        out[i] = k < 2 ? INFINITY : float_within(scale * sqrt(fmax(variance, 0)));
    }
}
