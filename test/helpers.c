/* helpers.c: see helpers.h. */
#include "helpers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/parallel.h"
#include "parser/parser.h"
#include "render/render.h"
#include "base/stats.h"

bool file_exists(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (f != NULL)
        fclose(f);
    return f != NULL;
}

bool scene_from_file(struct test *t, const char *path, int width, int height, struct scene *out)
{
    struct error err;
    if (!CHECK(t, parse_scene(path, out, NULL, &err), "%s: %s", path, err.text))
        return false;
    if (width > 0) {
        out->width = width;
        out->height = height;
        filter_default("box", &out->filter);
    }
    scene_prepare(out);
    return true;
}

bool scene_from_text(struct test *t, const char *text, struct scene *out)
{
    char path[256];
    snprintf(path, sizeof path, "%s/scene.pbrt", test_tmp(t));
    FILE *f = fopen(path, "w");
    if (!CHECK(t, f != NULL, "cannot write %s", path))
        return false;
    fputs(text, f);
    fclose(f);
    return scene_from_file(t, path, 0, 0, out);
}

/* Average a film over square tiles. */
static void tile_means(const struct film *film, int tile, double *out)
{
    int w = rect_width(film->rect), h = rect_height(film->rect);
    long n = 0;
    for (int y = 0; y < h; y += tile)
        for (int x = 0; x < w; x += tile)
            for (int c = 0; c < 3; c++, n++) {
                double sum = 0;
                int count = 0;
                for (int j = y; j < y + tile && j < h; j++)
                    for (int i = x; i < x + tile && i < w; i++, count++)
                        sum += film->eye[3 * (j * w + i) + c] + film->splat[3 * (j * w + i) + c];
                out[n] = sum / ((double)count * (double)film->iterations);
            }
}

struct batches render_batches(struct test *t, const struct scene *scene, const char *method, int max_depth, int spp,
                              int n_batches, int tile, uint64_t seed)
{
    struct pixel_rect crop = render_crop(scene);
    long tiles_x = (rect_width(crop) + tile - 1) / tile, tiles_y = (rect_height(crop) + tile - 1) / tile;
    struct batches b = {n_batches, tiles_x * tiles_y * 3, NULL};
    b.value = mem_alloc((size_t)(b.n * n_batches), sizeof *b.value);
    struct render_options o = {.method = method_find(method), .end = spp, .max_depth = max_depth};
    o.n_threads = parallel_cores();
    for (int i = 0; i < n_batches; i++) {
        struct film film;
        struct error err;
        o.seed = (test_seed(t) * 1000003 + seed) * 1009 + (uint64_t)i;
        film_init(&film, crop, scene->width, scene->height);
        CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
        CHECK(t, film.nonfinite == 0, "%s: %ld contributions are not finite", method, film.nonfinite);
        tile_means(&film, tile, b.value + b.n * i);
        film_free(&film);
    }
    return b;
}

void batches_free(struct batches *b) { free(b->value); }

static void moments(const struct batches *b, long i, double *mean, double *variance)
{
    double sum = 0, square = 0;
    for (int k = 0; k < b->n_batches; k++)
        sum += b->value[b->n * k + i];
    *mean = sum / b->n_batches;
    for (int k = 0; k < b->n_batches; k++)
        square += (b->value[b->n * k + i] - *mean) * (b->value[b->n * k + i] - *mean);
    *variance = square / (b->n_batches - 1);
}

double batches_p(const struct batches *a, const struct batches *b, double *ratio)
{
    double smallest = 1, sum_a = 0, sum_b = 0;
    for (long i = 0; i < a->n; i++) {
        double mean_a, var_a, mean_b, var_b;
        moments(a, i, &mean_a, &var_a);
        moments(b, i, &mean_b, &var_b);
        smallest = fmin(smallest, stats_welch_p(mean_a, var_a, a->n_batches, mean_b, var_b, b->n_batches));
        sum_a += mean_a;
        sum_b += mean_b;
    }
    if (ratio != NULL)
        *ratio = sum_a / sum_b;
    return 1 - pow(1 - smallest, (double)a->n);
}

/* Overall mean of each batch. */
static void batch_totals(const struct batches *b, double *mean, double *variance)
{
    double sum = 0, square = 0;
    for (int k = 0; k < b->n_batches; k++) {
        double total = 0;
        for (long i = 0; i < b->n; i++)
            total += b->value[b->n * k + i];
        total /= (double)b->n;
        sum += total;
        square += total * total;
    }
    *mean = sum / b->n_batches;
    *variance = fmax(0, (square - sum * *mean) / (b->n_batches - 1));
}

double batches_mean(const struct batches *b, double *standard_error)
{
    double mean, variance;
    batch_totals(b, &mean, &variance);
    *standard_error = sqrt(variance / b->n_batches);
    return mean;
}

double mean_p(const struct batches *b, double expected)
{
    double error, mean = batches_mean(b, &error);
    if (error <= 1e-12 * fabs(expected))
        return fabs(mean - expected) <= 1e-9 * fabs(expected) ? 1 : 0;
    return stats_student_p((mean - expected) / error, b->n_batches - 1);
}
