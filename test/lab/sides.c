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
#include "lab/timed.h"
#include "lab/compare.h"
#include "lab/files.h"

enum {
    PIXELS = 1024,    /* of the pictures, unless somebody says otherwise */
    MOST_TILES = 196, /* of a picture */
    PILOT_SPP = 4
};

/* --- reading ----------------------------------------------------------------------------------------- */

bool side_intact(const char *path, uint64_t content, struct error *err)
{
    char text[4096], line[2048];
    bool errors = file_has_extension(path, ".error.pfm");
    int stem = (int)strlen(path) - (errors ? 10 : 4);
    uint64_t said[2] = {0, 0};
    snprintf(text, sizeof text, "%.*s.txt", stem > 0 ? stem : 0, path);
    FILE *f = os_open_input(text);
    while (f != NULL && fgets(line, sizeof line, f) != NULL)
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

static bool render_batch(const struct scene *scene, const struct render_options *options, uint64_t seed, double *out,
                         struct error *err)
{
    struct render_options o = *options;
    struct film film;
    o.seed = seed;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = render_scene(scene, &o, &film, err);
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

bool side_render(const struct scene *scene, const struct render_options *options, int number, int n_batches, bool quiet,
                 struct side *out, struct error *err)
{
    struct progress bar;
    out->name = options->integrator;
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

long side_choose_spp(const struct scene *scene, const struct render_options *options, int n_batches, double seconds,
                     struct error *err)
{
    struct render_options pilot = *options;
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
                       double weight, double noise8, double mean, struct error *err)
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
    fprintf(f.stream, "noise8 %.6g\nmean %.9g\nmean_error %.6g\n", noise8, mean,
            mean > 0 ? sqrt(sqr(weight * error_a) + sqr((1 - weight) * error_b)) / mean : NAN);
    fprintf(f.stream, "weights %.6f %.6f of the two methods, by the inverse of the sum of all pixels' variances\n",
            weight, 1 - weight);
    if (v != NULL)
        fprintf(f.stream,
                "agreement p %.3g: smallest of the tiles %.3g, means %.3g, uniform %.3g; "
                "ratio of the means %.6f +- %.6f\n",
                v->p, v->smallest, v->mean, v->uniform, v->ratio, v->ratio_error);
    return file_commit(&f, err);
}

/* One weight for the whole picture: weights that follow each pixel's own variance would favour pixels that happen to be
 * dark, for they happen to scatter less. */
bool sides_store(const char *name, const struct side *a, const struct side *b, const struct provenance *from,
                 struct error *err)
{
    long n = a->pixels.n;
    float *mean = mem_alloc((size_t)n, sizeof *mean), *error = mem_alloc((size_t)n, sizeof *error);
    float *shifted = mem_alloc((size_t)n, sizeof *shifted);
    double variance_a = total_variance(&a->pixels), variance_b = total_variance(&b->pixels);
    double both = variance_a + variance_b, weight = both > 0 ? variance_b / both : 0.5, sum = 0;
    for (long i = 0; i < n; i++) {
        struct moments x = batches_moments(&a->pixels, i), y = batches_moments(&b->pixels, i);
        mean[i] = (float)(weight * x.mean + (1 - weight) * y.mean);
        error[i] = (float)sqrt(weight * weight * x.variance / x.n + (1 - weight) * (1 - weight) * y.variance / y.n);
        shifted[i] = mean[i] + error[i];
        sum += (double)mean[i];
    }
    double noise8 = compare_pixels(shifted, mean, n).rmse8;
    char path[4096], error_path[4096];
    snprintf(path, sizeof path, "%s.pfm", name);
    snprintf(error_path, sizeof error_path, "%s.error.pfm", name);
    bool ok = image_write(path, a->width, a->height, mean, err) &&
              image_write(error_path, a->width, a->height, error, err) &&
              write_text(name, a, b, from, weight, noise8, sum / (double)n, err);
    free(mean);
    free(error);
    free(shifted);
    return ok;
}
