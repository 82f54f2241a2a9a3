/* develop.c: see develop.h. */
#include "scene/develop.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/number.h"

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
