/* sides.c: see sides.h. */
#include "lab/sides.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/progress.h"
#include "base/rng.h"
#include "image/image.h"
#include "lab/methods.h"
#include "lab/compare.h"
#include "lab/files.h"
#include "lab/timed.h"

enum {
    PIXELS = 1024,    /* of the pictures, unless somebody says otherwise */
    MOST_TILES = 196, /* of a picture */
    PILOT_SPP = 4,
    LINE = 2048 /* of a text */
};

/* --- reading ----------------------------------------------------------------------------------------- */

FILE *side_text(const char *picture, char *path)
{
    const char *slash = os_last_separator(picture), *name = slash != NULL ? slash + 1 : picture;
    const char *dot = strrchr(name, '.');
    int n = dot != NULL ? (int)(dot - name) : (int)strlen(name), folder = (int)(name - picture);
    n -= file_has_extension(picture, ".error.pfm") ? 6 : 0;
    snprintf(path, SIDE_PATH, "%.*s%.*s.txt", folder, picture, n, name);
    FILE *f = os_open_input(path);
    if (f != NULL)
        return f;
    char line[LINE];
    snprintf(path, SIDE_PATH, "%.*smade.txt", folder, picture);
    f = os_open_input(path);
    while (f != NULL && fgets(line, LINE, f) != NULL)
        if (strncmp(line, "== ", 3) == 0 && (int)strcspn(line + 3, "\r\n") == n && strncmp(line + 3, name, (size_t)n) == 0)
            return f;
    if (f != NULL)
        fclose(f);
    return NULL;
}

bool side_line(FILE *text, char *line, int size)
{
    if (fgets(line, size, text) == NULL || strncmp(line, "== ", 3) == 0)
        return false;
    line[strcspn(line, "\r\n")] = '\0';
    return true;
}

bool side_intact(const char *path, uint64_t content, struct error *err)
{
    char text[SIDE_PATH], line[LINE];
    bool errors = file_has_extension(path, ".error.pfm");
    uint64_t said[2] = {0, 0};
    FILE *f = side_text(path, text);
    while (f != NULL && side_line(f, line, LINE))
        sscanf(line, "files %" SCNx64 " %" SCNx64, &said[0], &said[1]);
    if (f != NULL)
        fclose(f);
    return said[errors] == 0 || said[errors] == content ||
           error_set(err, "%s is damaged, or not the picture that %s was written for", path, text);
}

bool side_read(const char *const *file, int n, bool with_errors, const struct side *like, struct side *out,
               struct error *err)
{
    struct side side = {
        .name = file[0], .width = like != NULL ? like->width : 0, .height = like != NULL ? like->height : 0};
    bool ok = true;
    for (int k = 0; ok && k < n; k++) {
        int w, h;
        struct image about;
        float *pixels = image_read_linear(file[k], &w, &h, &about, err);
        ok = pixels != NULL && (!with_errors || side_intact(file[k], about.content, err));
        if (ok && side.width != 0 && (side.width != w || side.height != h))
            ok = error_set(err, "%s is %dx%d, the picture before it %dx%d; all must have the same size", file[k], w, h,
                           side.width, side.height);
        if (ok && k == 0) {
            side.width = w;
            side.height = h;
            side.pixels = batches_new(with_errors ? 1 : n, 3L * w * h, with_errors);
        }
        for (long i = 0; ok && i < side.pixels.n; i++)
            if (with_errors && k == 1)
                side.pixels.error[i] = (double)pixels[i];
            else
                side.pixels.value[side.pixels.n * k + i] = (double)pixels[i];
        free(pixels);
    }
    *out = side;
    return ok;
}

bool side_errors_path(const char *path, char *out, size_t size, struct error *err)
{
    int stem = (int)strlen(path) - 4;
    if (stem < 1 || strcmp(path + stem, ".pfm") != 0)
        return error_set(err, "%s: a reference is a .pfm file", path);
    snprintf(out, size, "%.*s.error.pfm", stem, path);
    return true;
}

/* --- rendering --------------------------------------------------------------------------------------- */

static bool render_batch(const struct scene *scene, const struct render_job *options, uint64_t seed, double *out,
                         struct error *err)
{
    struct render_job o = *options;
    struct film film;
    o.seed = seed;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = render_by(scene, &o, &film, err);
    film_warn(&film, 0);
    for (long i = 0; ok && i < 3L * rect_width(film.rect) * rect_height(film.rect); i++)
        out[i] = film_value(&film, (size_t)i) / (double)film.iterations * scene->film_scale;
    film_free(&film);
    return ok;
}

/* Seeds of the batches: hashes, so that no other side, and no picture rendered with a seed that somebody typed,
 * such as a stored reference, shares random numbers with a batch. */
static uint64_t batch_seed(uint64_t seed, int side, int batch)
{
    return hash_combine(hash_combine(hash_mix(seed ^ 0xbb67ae8584caa73bu), (uint64_t)side), (uint64_t)batch);
}

bool side_render(const struct scene *scene, const struct render_job *options, int number, int n_batches, bool quiet,
                 struct side *out, struct error *err)
{
    struct progress bar;
    out->name = options->integrator->name;
    out->width = rect_width(render_crop(scene));
    out->height = rect_height(render_crop(scene));
    out->pixels = batches_new(n_batches, 3L * out->width * out->height, false);
    progress_start(&bar, quiet);
    bool ok = true;
    for (int k = 0; ok && k < n_batches; k++) {
        ok = render_batch(scene, options, batch_seed(options->seed, number, k), out->pixels.value + out->pixels.n * k,
                          err);
        progress_update(&bar, (k + 1.0) / n_batches);
    }
    progress_end(&bar);
    return ok;
}

bool side_choose_resolution(struct scene *scene, const struct side *like, struct error *err)
{
    int width = scene->width, height = scene->height;
    double aspect = sqrt((double)width / height);
    scene->width = like != NULL ? like->width : (int)fmax(1, sqrt(PIXELS) * aspect + 0.5);
    scene->height = like != NULL ? like->height : (int)fmax(1, sqrt(PIXELS) / aspect + 0.5);
    if (width != scene->width || height != scene->height)
        camera_prepare(&scene->camera, scene->width, scene->height);
    int left[2] = {rect_width(render_crop(scene)), rect_height(render_crop(scene))};
    if (like == NULL || (left[0] == like->width && left[1] == like->height))
        return true;
    return error_set(err, "%s is %dx%d, of which the crop window leaves %dx%d; add --cropwindow 0 1 0 1", like->name,
                     like->width, like->height, left[0], left[1]);
}

long side_choose_spp(const struct scene *scene, const struct render_job *options, int n_batches, double seconds,
                     struct error *err)
{
    struct render_job pilot = *options;
    struct timed took;
    pilot.end = PILOT_SPP;
    if (!timed_render(scene, &pilot, &took, err))
        return 0;
    free(took.pixels);
    double spp = seconds * PILOT_SPP / (took.wall * n_batches);
    return spp < PILOT_SPP ? PILOT_SPP : spp > 1e6 ? 1000000 : (long)spp;
}

int side_choose_tile(const struct side *s)
{
    int tile = 4;
    while (((s->width + tile - 1) / tile) * ((s->height + tile - 1) / tile) > MOST_TILES)
        tile++;
    return tile;
}

/* --- storing a reference ----------------------------------------------------------------------------- */

/* The sum of the variances of all values' means. */
static double total_variance(const struct batches *b)
{
    double total = 0;
    for (long i = 0; i < b->n; i++) {
        struct moments m = batches_moments(b, i);
        total += m.variance / m.n;
    }
    return total;
}

static bool write_text(const char *name, const struct side *a, const struct side *b, const struct provenance *from,
                       double weight, const double noise[N_SQUARES], double mean, struct error *err)
{
    char path[4096];
    struct file_output f;
    const struct verdict *v = from->verdict;
    double error_a, error_b;
    uint64_t content[2];
    batches_mean(&a->pixels, &error_a);
    batches_mean(&b->pixels, &error_b);
    for (int i = 0; i < 2; i++) {
        struct image picture;
        snprintf(path, sizeof path, "%s%s.pfm", name, i == 0 ? "" : ".error");
        if (!image_read(path, NULL, &picture, err))
            return false;
        content[i] = picture.content;
        image_free(&picture);
    }
    snprintf(path, sizeof path, "%s.txt", name);
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "origin %s\nscene %s\ncontent %016" PRIx64 "\nresolution %dx%d\nmaxdepth %d\n", from->note,
            from->scene_path, from->content, a->width, a->height, from->max_depth);
    fprintf(f.stream, "files %016" PRIx64 " %016" PRIx64 "\n", content[0], content[1]);
    fprintf(f.stream, "noise8 %.6g\nnoise_relmse %.6g\nnoise_8x8 %.6g\n", sqrt(noise[SQUARE_MSE8]),
            noise[SQUARE_RELMSE], noise[SQUARE_BLOCKS]);
    fprintf(f.stream, "mean %.9g\nmean_error %.6g\n", mean,
            mean > 0 ? sqrt(sqr(weight * error_a) + sqr((1 - weight) * error_b)) / mean : NAN);
    if (v != NULL)
        fprintf(f.stream,
                "weights %.6f %.6f of the two methods, by the inverse of the sum of all pixels' variances\n"
                "agreement p %.3g: smallest of the tiles %.3g, means %.3g, uniform %.3g; "
                "ratio of the means %.6f +- %.6f\n",
                weight, 1 - weight, v->p, v->smallest, v->mean, v->uniform, v->ratio, v->ratio_error);
    return file_commit(&f, err);
}

/* On the 8-bit scale, but not rounded: rounding would make a step of 1 of the least of changes. */
static double level(double linear) { return 255 * srgb_encode(clamp(linear, 0, 1)); }

/* Variance of the level of a mean that consists of `weight` times this side's and of `rest`. Where noise is large the
 * curve from linear values to levels is far from straight, so each batch is left out once [Efron & Stein 1981]; of a
 * picture whose errors are known the value is moved both ways. */
static double shown_variance(const struct batches *b, long i, double weight, double rest)
{
    int n = b->n_batches;
    double mean = batches_moments(b, i).mean, sum = 0, squares = 0;
    if (b->error != NULL) {
        double off = weight * b->error[i], value = weight * mean + rest;
        return sqr((level(value + off) - level(value - off)) / 2);
    }
    for (int k = 0; k < n; k++) {
        double without = mean + (mean - b->value[b->n * k + i]) / (n - 1);
        double value = level(weight * without + rest);
        sum += value;
        squares += sqr(value);
    }
    return fmax(squares - sum * sum / n, 0) * (n - 1) / n;
}

/* The noise of the weighted mean of both sides in each way to measure squared errors. Relative ones divide by values of
 * the reference itself, so they are measured as those of a render will be: of each side against the other. */
static void own_noise(const struct side *a, const struct side *b, double weight, double noise[N_SQUARES])
{
    long n = a->pixels.n;
    float *x = mem_alloc((size_t)n, sizeof *x), *y = mem_alloc((size_t)n, sizeof *y);
    double ways[2][N_SQUARES], shown = 0;
    for (long i = 0; i < n; i++) {
        double mean_a = batches_moments(&a->pixels, i).mean, mean_b = batches_moments(&b->pixels, i).mean;
        shown += shown_variance(&a->pixels, i, weight, (1 - weight) * mean_b) +
                 shown_variance(&b->pixels, i, 1 - weight, weight * mean_a);
        x[i] = (float)mean_a;
        y[i] = (float)mean_b;
    }
    compare_squares(x, y, x, a->width, a->height, ways[0]);
    compare_squares(x, y, y, a->width, a->height, ways[1]);
    for (int k = 0; k < N_SQUARES; k++)
        noise[k] = weight * (1 - weight) * (ways[0][k] + ways[1][k]) / 2;
    noise[SQUARE_MSE8] = shown / (double)n;
    free(x);
    free(y);
}

/* One weight for the whole picture: weights that follow each pixel's own variance would favour pixels that happen to be
 * dark, for they happen to scatter less. So would any weight where both sides are by the same method. */
bool sides_store(const char *name, const struct side *a, const struct side *b, const struct provenance *from,
                 struct error *err)
{
    long n = a->pixels.n;
    float *mean = mem_alloc((size_t)n, sizeof *mean), *error = mem_alloc((size_t)n, sizeof *error);
    double variance_a = total_variance(&a->pixels), both = variance_a + total_variance(&b->pixels), sum = 0;
    double weight = from->verdict != NULL && both > 0 ? 1 - variance_a / both : 0.5, noise[N_SQUARES];
    for (long i = 0; i < n; i++) {
        struct moments x = batches_moments(&a->pixels, i), y = batches_moments(&b->pixels, i);
        mean[i] = (float)(weight * x.mean + (1 - weight) * y.mean);
        error[i] = (float)sqrt(weight * weight * x.variance / x.n + (1 - weight) * (1 - weight) * y.variance / y.n);
        sum += (double)mean[i];
    }
    own_noise(a, b, weight, noise);
    char path[4096], error_path[4096];
    snprintf(path, sizeof path, "%s.pfm", name);
    snprintf(error_path, sizeof error_path, "%s.error.pfm", name);
    bool ok = image_write(path, a->width, a->height, mean, err) &&
              image_write(error_path, a->width, a->height, error, err) &&
              write_text(name, a, b, from, weight, noise, sum / (double)n, err);
    free(mean);
    free(error);
    return ok;
}
