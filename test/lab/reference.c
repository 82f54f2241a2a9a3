/* reference.c: see reference.h. */
#include "lab/reference.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/rng.h"
#include "caustics/caustic.h"
#include "image/image.h"
#include "lab/files.h"
#include "lab/methods.h"
#include "lab/sheet.h"
#include "lab/sides.h"

enum { PATH_SIZE = 4096 };
static const char STORED[] = "stored picture", MADE[] = "rendered here";

void reference_free(struct reference *r)
{
    free(r->pixels);
    free(r->variance);
    memset(r, 0, sizeof *r);
}

/* --- the text of a picture --------------------------------------------------------------------- */

static void read_line(char *line, struct reference *r)
{
    sscanf(line, "maxdepth %ld", &r->max_depth);
    sscanf(line, "content %" SCNx64, &r->content);
    sscanf(line, "noise8 %lf", &r->noise8);
    sscanf(line, "noise_relmse %lf", &r->noise[SQUARE_RELMSE]);
    sscanf(line, "noise_8x8 %lf", &r->noise[SQUARE_BLOCKS]);
    sscanf(line, "mean_error %lf", &r->mean_error);
    if (strncmp(line, "origin ", 7) == 0)
        snprintf(r->origin, sizeof r->origin, "%.1199s", line + 7);
}

/* Reads the text of a picture; a missing one is empty. */
static void read_text(const char *picture, struct reference *r)
{
    char path[SIDE_PATH], line[2048];
    *r = (struct reference){.noise8 = NAN, .mean_error = NAN, .noise = {NAN, NAN, NAN}};
    FILE *f = side_text(picture, path);
    while (f != NULL && side_line(f, line, sizeof line))
        read_line(line, r);
    if (f != NULL)
        fclose(f);
}

/* --- stored references ------------------------------------------------------------------------------- */

/* The reference's own part of squared errors against it, where its text does not tell: by its picture of errors, if
 * there is one. It is shifted by as much, up or down as chance has it. */
static bool read_noise(const char *path, struct reference *r, struct error *err)
{
    struct image about;
    char stem[PATH_SIZE], errors[PATH_SIZE + 16];
    int width, height;
    snprintf(stem, sizeof stem, "%.*s", (int)(strrchr(path, '.') != NULL ? strrchr(path, '.') - path : 0), path);
    snprintf(errors, sizeof errors, "%s.error.pfm", stem);
    float *shifted = image_read_linear(errors, &width, &height, &about, NULL);
    bool ok = shifted == NULL || side_intact(errors, about.content, err);
    double noise[N_SQUARES] = {NAN, NAN, NAN};
    if (shifted != NULL && width == r->width && height == r->height) {
        r->variance = mem_alloc(3 * (size_t)width * (size_t)height, sizeof *r->variance);
        for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++) {
            r->variance[i] = shifted[i] * shifted[i];
            shifted[i] = r->pixels[i] + (hash_mix(i) % 2 == 0 ? shifted[i] : -shifted[i]);
        }
        compare_squares(shifted, r->pixels, r->pixels, width, height, noise);
    }
    r->noise[SQUARE_MSE8] = sqr(r->noise8);
    for (int k = 0; k < N_SQUARES; k++)
        r->noise[k] = isfinite(r->noise[k]) ? r->noise[k] : noise[k];
    r->noise8 = sqrt(r->noise[SQUARE_MSE8]);
    free(shifted);
    return ok;
}

/* Read one picture, and its text. False with a message if it is damaged. */
static bool load(const char *path, const char *kind, struct reference *out, struct error *err)
{
    struct image about;
    read_text(path, out);
    out->pixels = image_read_linear(path, &out->width, &out->height, &about, err);
    bool ok = out->pixels != NULL && side_intact(path, about.content, err);
    for (size_t i = 0; ok && i < 3 * (size_t)out->width * (size_t)out->height; i++)
        ok = isfinite(out->pixels[i]) || error_set(err, "%s: NaN or infinite values are no reference", path);
    if (!ok || !read_noise(path, out, err)) {
        reference_free(out);
        return false;
    }
    out->kind = kind;
    snprintf(out->origin, sizeof out->origin, "%s: %.1000s of %dx%d pixels", kind, path, out->width, out->height);
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
    float *small = sheet_shrink(r->pixels, r->width, r->height, k), *variance = r->variance;
    if (variance != NULL) {
        r->variance = sheet_shrink(variance, r->width, r->height, k);
        for (size_t i = 0; i < 3 * (size_t)width * (size_t)height; i++)
            r->variance[i] /= (float)(k * k);
        free(variance);
    }
    size_t n = strlen(r->origin);
    snprintf(r->origin + n, sizeof r->origin - n, ", averaged to this size");
    free(r->pixels);
    r->pixels = small;
    r->width = width;
    r->height = height;
    r->noise8 /= k;
    for (int i = 0; i < N_SQUARES; i++)
        r->noise[i] /= (double)k * k;
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

/* Where a reference may be without being given: next to the scene, or one directory up. */
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
    if (given != NULL) {
        given_path(given, name, path);
        return load(path, STORED, out, err);
    }
    *out = (struct reference){.noise8 = NAN, .mean_error = NAN, .noise = {NAN, NAN, NAN}};
    for (int i = 0; i < N_PLACES; i++) {
        place_path(i, scene_path, name, path);
        if (file_exists(path))
            return load(path, STORED, out, err);
    }
    return true;
}

/* --- references made here ---------------------------------------------------------------------------- */

enum { BATCHES = 4 }; /* of each side */

const char *reference_method(const struct scene *scene, bool *all)
{
    struct one_more *chains = caustics_new(scene, 1);
    bool delta = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta = delta || light_is_delta(&scene->lights.light[i]);
    *all = !delta || chains == NULL;
    caustics_free(chains);
    return *all || scene->space != NULL ? METHOD_REFERENCE : METHOD_CAUSTICS;
}

bool reference_make(const struct scene *scene, const struct render_job *options, long spp, const char *directory,
                    const char *name, const char *key, struct reference *out, struct error *err)
{
    char stem[PATH_SIZE - 4], path[PATH_SIZE];
    struct render_job o = *options;
    struct side a = {0}, b = {0};
    snprintf(stem, sizeof stem, "%s/%s", directory, name);
    snprintf(path, sizeof path, "%s.pfm", stem);
    read_text(path, out);
    if (strcmp(out->origin, key) == 0 && load(path, MADE, out, NULL))
        return true;
    o.end = spp / (2 * BATCHES) > 1 ? spp / (2 * BATCHES) : 1;
    bool ok = file_make_directory(directory, err) && side_render(scene, &o, 0, BATCHES, true, &a, err) &&
              side_render(scene, &o, 1, BATCHES, true, &b, err);
    if (ok) {
        struct provenance from = {key, "here", scene->content, options->max_depth, NULL};
        ok = sides_store(stem, &a, &b, &from, err) && load(path, MADE, out, err);
    }
    batches_free(&a.pixels);
    batches_free(&b.pixels);
    return ok;
}
