/* film.c: see film.h. */
#include "scene/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"

/* Places of block.splat. */
static size_t film_splat_sums(const struct film *f)
{
    return (size_t)(1 + f->planes.lights) * rect_pixels(f->rect) * 3;
}

double film_bytes(struct pixel_rect rect, struct planes planes)
{
    size_t sums = 3 * (size_t)plane_count(planes) * sizeof(struct exact_sum);
    size_t floats = 3 * (size_t)(1 + plane_count(planes) + 2) * sizeof(float); /* splats, pictures, what is written */
    return (double)rect_pixels(rect) * (double)(sums + floats + sizeof(bool));
}

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
    free(f->more);
    free(f->half);
    free(f->eye);
    free(f->square);
    memset(f, 0, sizeof *f);
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
    f->eye = mem_alloc(rect_pixels(f->rect) * 3, sizeof *f->eye);
    f->square = mem_alloc(rect_pixels(f->rect) * 3, sizeof *f->square);
}

void film_keep_halves(struct film *f)
{
    f->half = mem_alloc(rect_pixels(f->rect) * 3, sizeof *f->half);
    for (int i = 0; i < N_NOISE_SCALES; i++)
        f->noise[i].value = f->noise[i].error = INFINITY;
}

static size_t pixel_of(const struct film *f, int x, int y)
{
    return (size_t)(y - f->rect.y0) * (size_t)rect_width(f->rect) + (size_t)(x - f->rect.x0);
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
                if (f->square != NULL)
                    f->square[at + c] += sqr((double)part[c]);
            }
        }
}

void film_take_splats(struct film *f, struct tile *t)
{
    for (size_t i = 0; i < t->n_splats; i++)
        add_splat(f, &t->splat[i], t->filter, f->half != NULL && t->first_half);
    t->n_splats = 0;
}

void film_merge_tile(struct film *f, struct tile *t)
{
    size_t from = 0, film_plane = 3 * rect_pixels(f->rect), tile_plane = 3 * (size_t)pixels_count(t->pixels);
    for (int i = 0, x, y; pixels_get(t->pixels, i, &x, &y); i++) {
        f->block.in[pixel_of(f, x, y)] = true;
        for (size_t to = 3 * pixel_of(f, x, y), c = 0; c < 3; c++, to++, from++) {
            for (size_t p = 0; p < (size_t)plane_count(f->planes); p++)
                f->nonfinite += !exact_join(&f->sum[p * film_plane + to], &t->sum[p * tile_plane + from]);
            if (f->half != NULL && t->first_half) /* part of the sum: it cannot overflow before it */
                exact_join(&f->half[to], &t->sum[from]);
            if (f->square != NULL) {
                f->eye[to] += exact_value(&t->sum[from]);
                f->square[to] += t->square[from];
            }
        }
    }
    film_take_splats(f, t);
    f->block.n_in += (size_t)pixels_count(t->pixels);
    f->nonfinite += t->nonfinite;
}

static void clear_block(struct film *f)
{
    f->passes = 0;
    f->block.n_in = 0;
    memset(f->block.in, 0, rect_pixels(f->rect) * sizeof *f->block.in);
    memset(f->block.splat, 0, film_splat_sums(f) * sizeof *f->block.splat);
}

void film_end_block(struct film *f)
{
    f->iterations += f->block.iterations;
    clear_block(f);
}

/* What must be added to the value in place i of the planes. Of a block under way pixels that are in have their own
 * samples, but every pixel has the splats of all that are in: where its samples count these are made to stand for the
 * splats of all, else taken out. */
static double block_correction(const struct film *f, size_t i)
{
    size_t n = rect_pixels(f->rect), pixel = i % (3 * n) / 3;
    if (f->block.n_in == 0 || i >= film_splat_sums(f))
        return 0;
    double all = f->block.in[pixel] ? (double)n / (double)f->block.n_in : 0;
    return (all - 1) * (double)f->block.splat[i];
}

static long samples_of(const struct film *f, size_t pixel)
{
    return f->iterations + (f->block.in[pixel] ? f->block.iterations : 0) + (f->more != NULL ? f->more[pixel] : 0);
}

void film_settle(struct film *f)
{
    size_t n = rect_pixels(f->rect);
    if (f->more == NULL)
        f->more = mem_alloc(n, sizeof *f->more);
    for (size_t i = 0; i < film_splat_sums(f); i++)
        exact_add(&f->sum[i], block_correction(f, i));
    for (size_t i = 0; i < n; i++)
        f->more[i] = samples_of(f, i) - f->iterations;
    clear_block(f);
}

double film_samples(const struct film *f)
{
    double share = (double)f->block.n_in / (double)rect_pixels(f->rect);
    return (double)f->iterations + share * (double)f->block.iterations;
}

/* --- pictures ---------------------------------------------------------------------------------------- */

long film_develop(const struct film *f, double scale, float *out) { return film_develop_plane(f, 0, scale, out); }

/* A pixel's value in a plane. */
static double mean_in_plane(const struct film *f, size_t plane, size_t i, double scale)
{
    size_t at = plane * 3 * rect_pixels(f->rect) + i;
    long samples = samples_of(f, i / 3);
    return samples > 0 ? (film_value(f, at) + block_correction(f, at)) * (scale / (double)samples) : 0;
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
        say_line("asbdpt: warning: %ld contributions were not finite, or too large, and were left out", f->nonfinite);
    if (cut > 0)
        say_line("asbdpt: warning: %ld pixel values were beyond 3.4e38 and were cut to it", cut);
}

void film_standard_error(const struct film *f, double scale, float *out)
{
    size_t n = rect_pixels(f->rect) * 3;
    for (size_t i = 0; i < n; i++) {
        double k = (double)samples_of(f, i / 3);
        double variance = (f->square[i] - sqr(f->eye[i]) / k) / (k * (k - 1));
        out[i] = k < 2 ? INFINITY : float_within(scale * sqrt(fmax(variance, 0)));
    }
}
