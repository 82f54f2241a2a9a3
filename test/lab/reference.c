/* reference.c: see reference.h. */
#include "lab/reference.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"
#include "image/sheet.h"
#include "look/compare.h"

enum { PATH_SIZE = 4096 };

void reference_free(struct reference *r)
{
    free(r->pixels);
    r->pixels = NULL;
}

/* --- the text beside the picture --------------------------------------------------------------------- */

struct reference_text {
    char key[512];
    long max_depth;   /* 0: not said */
    uint64_t content; /* 0: not said */
    double noise8, mean_error;
    char origin[1200];
};

static void read_line(char *line, struct reference_text *s)
{
    sscanf(line, "maxdepth %ld", &s->max_depth);
    sscanf(line, "content %" SCNx64, &s->content);
    sscanf(line, "noise8 %lf", &s->noise8);
    sscanf(line, "mean_error %lf", &s->mean_error);
    if (strncmp(line, "key ", 4) == 0)
        snprintf(s->key, sizeof s->key, "%.511s", line + 4);
    if (strncmp(line, "origin ", 7) == 0)
        snprintf(s->origin, sizeof s->origin, "%.1199s", line + 7);
}

/* Read NAME.txt beside NAME.pfm; a missing file says nothing. */
static void read_text(const char *picture, struct reference_text *s)
{
    char path[PATH_SIZE], line[2048];
    memset(s, 0, sizeof *s);
    s->noise8 = s->mean_error = NAN;
    const char *dot = strrchr(picture, '.');
    snprintf(path, sizeof path, "%.*s.txt", (int)(dot != NULL ? dot - picture : (long)strlen(picture)), picture);
    FILE *f = os_open_input(path);
    if (f == NULL)
        return;
    while (fgets(line, sizeof line, f) != NULL) {
        line[strcspn(line, "\r\n")] = '\0';
        read_line(line, s);
    }
    fclose(f);
}

/* --- stored references ------------------------------------------------------------------------------- */

/* Read one picture, and *text beside it. */
static bool load(const char *path, struct reference *out, struct reference_text *text, struct error *err)
{
    out->pixels = load_linear(path, &out->width, &out->height, NULL, err);
    if (out->pixels == NULL)
        return false;
    read_text(path, text);
    out->max_depth = text->max_depth;
    out->content = text->content;
    out->noise8 = text->noise8;
    out->mean_error = text->mean_error;
    snprintf(out->origin, sizeof out->origin, "stored picture %.1000s of %dx%d pixels", path, out->width, out->height);
    return true;
}

bool reference_fit(struct reference *r, int width, int height, int max_depth, struct error *err)
{
    int k = r->width / width;
    if (k < 1 || r->width != k * width || r->height != k * height)
        return error_set(err, "%s is no whole multiple of %dx%d", r->origin, width, height);
    if (r->max_depth != 0 && r->max_depth != max_depth)
        return error_set(err, "%s holds paths up to maxdepth %ld, not %d", r->origin, r->max_depth, max_depth);
    if (k == 1)
        return true;
    float *small = sheet_shrink(r->pixels, r->width, r->height, k);
    size_t n = strlen(r->origin);
    snprintf(r->origin + n, sizeof r->origin - n, ", averaged to this size");
    free(r->pixels);
    r->pixels = small;
    r->width = width;
    r->height = height;
    r->noise8 /= k;
    return true;
}

bool reference_is_of(const struct reference *r, const struct scene *scene, bool given, struct error *err)
{
    if (r->content == scene->content || (given && r->content == 0))
        return true;
    const char *why = r->content == 0 ? "does not say what scene it is of" : "is of another scene";
    return error_set(err, "%s %s", r->origin, why);
}

enum { N_PLACES = 2 };

/* Where a reference may be without being given: beside the scene, or one directory up. */
static void place_path(int i, const char *scene_path, const char *name, char path[PATH_SIZE])
{
    static const char *const places[N_PLACES] = {"ref", "../ref"};
    const char *slash = os_last_separator(scene_path);
    int n = slash != NULL ? (int)(slash - scene_path) + 1 : 0;
    snprintf(path, PATH_SIZE, "%.*s%s/%s.pfm", n, scene_path, places[i], name);
}

/* What was given: a directory that holds NAME.pfm, or else the picture itself. */
static void given_path(const char *given, const char *name, char path[PATH_SIZE])
{
    snprintf(path, PATH_SIZE, "%s/%s.pfm", given, name);
    if (!file_exists(path))
        snprintf(path, PATH_SIZE, "%s", given);
}

bool reference_find(const char *given, const char *scene_path, const char *name, struct reference *out,
                    struct error *err)
{
    char path[PATH_SIZE];
    struct reference_text text;
    bool found = false;
    if (given != NULL) {
        given_path(given, name, path);
        return load(path, out, &text, err);
    }
    for (int i = 0; !found && i < N_PLACES; i++) {
        place_path(i, scene_path, name, path);
        found = load(path, out, &text, NULL);
    }
    return true;
}

/* --- references made here ---------------------------------------------------------------------------- */

/* The share of both halves that is done. */
struct halves {
    const struct render_options *options;
    int number;
};

static bool half_progress(void *context, double done)
{
    const struct halves *h = context;
    return h->options->progress == NULL || h->options->progress(h->options->progress_context, 0.5 * (h->number + done));
}

/* Relative standard error of the mean of a film's picture, were its pixels independent; too large rather than too
 * small, as samples are spread evenly. NaN for a black one. */
static double picture_mean_error(const struct film *film)
{
    size_t n = (size_t)rect_width(film->rect) * (size_t)rect_height(film->rect) * 3;
    float *error = mem_alloc(n, sizeof *error);
    double square[3] = {0, 0, 0}, total = 0;
    film_standard_error(film, 1, error);
    for (size_t i = 0; i < n; i++) {
        square[i % 3] += (double)error[i] * (double)error[i];
        total += film_value(film, i) / (double)film->iterations;
    }
    free(error);
    /* The channels of a pixel are not independent: take them as fully dependent, the worst case. */
    return total > 0 ? (sqrt(square[0]) + sqrt(square[1]) + sqrt(square[2])) / total : NAN;
}

/* Render half number i into `out`; `mean_error` as picture_mean_error has it. */
static bool render_half(const struct scene *scene, const struct render_options *options, long spp, int i, float *out,
                        double *mean_error, struct error *err)
{
    struct halves context = {options, i};
    struct render_options o = *options;
    struct film film;
    o.seed = options->seed + (unsigned)i;
    o.first = 0;
    o.end = spp;
    o.progress = half_progress;
    o.progress_context = &context;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    film_keep_errors(&film);
    bool ok = render_scene(scene, &o, &film, err);
    if (ok) {
        film_warn(&film, film_develop(&film, scene->film_scale, out));
        *mean_error = picture_mean_error(&film);
    }
    film_free(&film);
    return ok;
}

bool reference_render(const struct scene *scene, const struct render_options *options, long spp, struct reference *out,
                      struct error *err)
{
    size_t n = (size_t)scene->width * (size_t)scene->height * 3;
    long half = spp / 2 > 1 ? spp / 2 : 2;
    float *a = mem_alloc(n, sizeof *a), *b = mem_alloc(n, sizeof *b);
    double error[2] = {NAN, NAN};
    bool ok = render_half(scene, options, half, 0, a, &error[0], err) &&
              render_half(scene, options, half, 1, b, &error[1], err);
    if (ok) {
        out->noise8 = compare_pixels(a, b, (long)n).rmse8 / 2;
        out->mean_error = 0.5 * sqrt(error[0] * error[0] + error[1] * error[1]);
        for (size_t i = 0; i < n; i++)
            a[i] = 0.5f * (a[i] + b[i]);
        snprintf(out->origin, sizeof out->origin,
                 "rendered by this program: %s, two halves of %ld spp, seeds %lu and %lu", options->integrator,
                 half, (unsigned long)options->seed, (unsigned long)options->seed + 1);
        out->pixels = a;
        out->width = scene->width;
        out->height = scene->height;
        out->max_depth = options->max_depth;
    } else {
        free(a);
    }
    free(b);
    return ok;
}

bool reference_write(const struct reference *r, const char *directory, const char *name, const char *key,
                     struct error *err)
{
    char path[PATH_SIZE];
    struct file_output f;
    snprintf(path, sizeof path, "%s/%s.pfm", directory, name);
    if (!image_write(path, r->width, r->height, r->pixels, err))
        return false;
    snprintf(path, sizeof path, "%s/%s.txt", directory, name);
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "key %s\nresolution %dx%d\nmaxdepth %ld\nnoise8 %.17g\nmean_error %.17g\norigin %s\n", key,
            r->width, r->height, r->max_depth, r->noise8, r->mean_error, r->origin);
    return file_commit(&f, err);
}

bool reference_read(const char *directory, const char *name, const char *key, struct reference *out)
{
    char path[PATH_SIZE];
    struct reference_text text;
    snprintf(path, sizeof path, "%s/%s.pfm", directory, name);
    read_text(path, &text);
    if (strcmp(text.key, key) != 0 || !load(path, out, &text, NULL))
        return false;
    snprintf(out->origin, sizeof out->origin, "%s", text.origin);
    return true;
}
