/* cmd_verify.c: asbdpt verify: have two methods, or two pictures, the same expectation? See verify.h for the tests. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "lab/compare.h"
#include "base/file.h"
#include "image/image.h"
#include "base/mem.h"
#include "base/progress.h"
#include "base/rng.h"
#include "base/number.h"
#include "lab/verify.h"

enum {
    PIXELS = 1024,      /* of the pictures, unless --res says otherwise */
    MOST_TILES = 196,   /* of a picture, unless --tile says otherwise */
    PILOT_SPP = 4
};
static const double SECONDS = 40; /* of rendering, unless --spp says otherwise */

struct verify_options {
    struct job_options job;
    bool has_scene;
    char first[64], second[64]; /* methods; "": the default */
    const char *reference;      /* a stored picture instead of the second method, or NULL */
    const char *store;          /* write the mean of both sides as STORE.pfm ..., or NULL */
    const char *note;
    char **files, **against; /* pictures; borrowed */
    int n_files, n_against;
    bool with_errors; /* files[0..1] and against[0..1] are a picture and its standard errors */
    int batches, tile;
    double alpha;
};

/* --- arguments --------------------------------------------------------------------------------------- */

static bool number_of(const char *option, const char *text, double low, double high, double *out)
{
    char *end;
    double x = strtod(text, &end);
    if (end != text && *end == '\0' && x >= low && x <= high) {
        *out = x;
        return true;
    }
    usage_error("%s %s: expected a number from %g to %g", option, text, low, high);
    return false;
}

/* Arguments up to the next option. */
static int list_of(int argc, char **argv, int at)
{
    int n = 0;
    while (at + n < argc && argv[at + n][0] != '-')
        n++;
    return n;
}

static bool methods_of(const char *text, struct verify_options *o)
{
    sscanf(text, "%63[^,],%63s", o->first, o->second);
    for (int i = 0; i < 2; i++) {
        const char *name = i == 0 ? o->first : o->second;
        if (name[0] != '\0' && method_find(name) == NULL) {
            usage_error("--methods: there is no method %s", name);
            return false;
        }
    }
    return true;
}

/* The option at argv[i], if it is one of verify's own: how many arguments it takes up. 0: not one of them, -1: wrong. */
static int own_option(int argc, char **argv, int i, struct verify_options *o)
{
    const char *name = argv[i];
    double x = 0;
    if (strcmp(name, "--files") == 0 || strcmp(name, "--images") == 0) {
        o->files = argv + i + 1;
        o->n_files = list_of(argc, argv, i + 1);
        o->with_errors = strcmp(name, "--images") == 0;
        return 1 + o->n_files;
    }
    if (strcmp(name, "--against") == 0) {
        o->against = argv + i + 1;
        o->n_against = list_of(argc, argv, i + 1);
        return 1 + o->n_against;
    }
    static const char *const with_value[] = {"--methods", "--reference", "--store", "--note", "--batches", "--tile", "--alpha"};
    size_t k = 0;
    while (k < 7 && strcmp(name, with_value[k]) != 0)
        k++;
    if (k == 7)
        return 0;
    if (i + 1 >= argc)
        return usage_error("%s needs a value", name) == EXIT_OK ? 0 : -1;
    const char *value = argv[i + 1];
    bool ok = true;
    switch (k) {
    case 0: ok = methods_of(value, o); break;
    case 1: o->reference = value; break;
    case 2: o->store = value; break;
    case 3: o->note = value; break;
    case 4: ok = number_of(name, value, 4, 10000, &x), o->batches = (int)x; break;
    case 5: ok = number_of(name, value, 1, 10000, &x), o->tile = (int)x; break;
    case 6: ok = number_of(name, value, 1e-12, 0.5, &o->alpha); break;
    }
    return ok ? 2 : -1;
}

static int parse(int argc, char **argv, struct verify_options *o)
{
    memset(o, 0, sizeof *o);
    o->batches = 12;
    o->alpha = 0.001;
    o->note = "";
    char **rest = mem_alloc((size_t)argc, sizeof *rest);
    int n_rest = 0, status = EXIT_OK, step;
    for (int i = 0; i < argc && status == EXIT_OK; i += step) {
        step = i == 0 ? 0 : own_option(argc, argv, i, o);
        if (step < 0)
            status = EXIT_USAGE;
        if (step == 0) {
            rest[n_rest++] = argv[i];
            step = 1;
        }
    }
    if (o->with_errors && o->n_files == 4) { /* picture, error, picture, error */
        o->against = o->files + 2;
        o->n_files = o->n_against = 2;
    }
    o->has_scene = n_rest > 1;
    if (status == EXIT_OK && (o->has_scene || o->n_files == 0))
        status = job_options_parse(n_rest, rest, &o->job);
    free(rest);
    if (status != EXIT_OK)
        return status;
    bool pictures = o->n_files > 0;
    bool good = !pictures || (o->n_against > 0 && (o->with_errors ? o->n_files == 2 && o->n_against == 2
                                                                  : o->n_files > 1 && o->n_against > 1));
    if (good && (pictures || o->store == NULL) && (o->store == NULL || o->has_scene))
        return EXIT_OK;
    if (o->has_scene)
        job_options_free(&o->job);
    return usage_error("usage: asbdpt verify SCENE [--methods A,B | --methods A --reference R.pfm] [--batches N] [--tile N], "
                       "or verify --images A.pfm A.error.pfm B.pfm B.error.pfm, "
                       "or verify SCENE --files A.pfm... --against B.pfm... [--store NAME]");
}

/* --- samples ----------------------------------------------------------------------------------------- */

/* The pictures to compare: one side's pixels and the size, which all pictures must share. */
struct side {
    const char *name;
    struct sample pixels;
};

struct sizes {
    int width, height; /* 0: not known yet */
};

static bool read_into(const char *path, struct sizes *size, double **out, struct error *err)
{
    int w, h;
    float *pixels = load_linear(path, &w, &h, err);
    if (pixels == NULL)
        return false;
    bool fits = size->width == 0 || (size->width == w && size->height == h);
    if (!fits) {
        error_set(err, "%s is %dx%d, the picture before it %dx%d; all must have the same size", path, w, h, size->width,
                  size->height);
    } else {
        *out = mem_alloc((size_t)w * (size_t)h * 3, sizeof **out);
        for (long i = 0; i < 3L * w * h; i++)
            (*out)[i] = (double)pixels[i];
        size->width = w;
        size->height = h;
    }
    free(pixels);
    return fits;
}

static bool read_side(char **file, int n, bool with_errors, struct sizes *size, struct side *out, struct error *err)
{
    int batches = with_errors ? 1 : n;
    memset(&out->pixels, 0, sizeof out->pixels);
    for (int k = 0; k < n; k++) {
        double *pixels;
        if (!read_into(file[k], size, &pixels, err))
            return false;
        long values = 3L * size->width * size->height;
        if (k == 0)
            out->pixels = sample_new(batches, values, with_errors);
        double *to = with_errors && k == 1 ? out->pixels.error : out->pixels.value + values * k;
        memcpy(to, pixels, (size_t)values * sizeof *to);
        free(pixels);
    }
    out->name = file[0];
    return true;
}

static bool render_one(const struct scene *scene, const struct method *m, const struct job_options *o, long spp,
                       uint64_t seed, double *out, struct error *err)
{
    struct render_options options = {.method = m, .seed = seed, .end = spp, .n_threads = o->n_threads};
    options.max_depth = o->max_depth;
    struct film film;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = render_scene(scene, &options, &film, err);
    film_warn(&film, 0);
    for (long i = 0; ok && out != NULL && i < 3L * rect_width(film.rect) * rect_height(film.rect); i++)
        out[i] = (film.eye[i] + film.splat[i]) / (double)film.iterations * scene->film_scale;
    film_free(&film);
    return ok;
}

/* Seeds of the batches: hashes, so that neither the two sides nor a picture rendered with a seed that somebody typed, such
 * as a stored reference, shares random numbers with a batch. */
static uint64_t batch_seed(uint64_t seed, int side, int batch)
{
    return hash_combine(hash_combine(hash_mix(seed ^ 0xbb67ae8584caa73bu), (uint64_t)side), (uint64_t)batch);
}

/* The samples per pixel that `renders` renders by each of the two methods need to take about `SECONDS`. */
static long choose_spp(const struct scene *scene, const struct method *const *m, const struct verify_options *o,
                       struct error *err)
{
    double start = clock_seconds();
    int sides = m[1] != NULL ? 2 : 1;
    for (int i = 0; i < sides; i++)
        if (!render_one(scene, m[i], &o->job, PILOT_SPP, 1, NULL, err))
            return 0;
    double per_spp = (clock_seconds() - start) / PILOT_SPP;
    double spp = SECONDS / (per_spp * o->batches);
    return spp < PILOT_SPP ? PILOT_SPP : spp > 1e6 ? 1000000 : (long)spp;
}

static bool render_side(const struct scene *scene, const struct method *m, const struct verify_options *o, long spp,
                        int side, struct side *out, struct error *err)
{
    long n = 3L * rect_width(render_crop(scene)) * rect_height(render_crop(scene));
    out->name = m->name;
    out->pixels = sample_new(o->batches, n, false);
    struct progress bar;
    progress_start(&bar, o->job.quiet);
    bool ok = true;
    for (int k = 0; ok && k < o->batches; k++) {
        ok = render_one(scene, m, &o->job, spp, batch_seed(o->job.seed, side, k), out->pixels.value + n * k, err);
        progress_update(&bar, (k + 1.0) / o->batches);
    }
    progress_end(&bar);
    return ok;
}

/* Without --res: the scene's shape with about PIXELS pixels. */
static void choose_resolution(struct scene *scene, const struct verify_options *o, const struct sizes *size)
{
    double aspect = sqrt((double)scene->width / scene->height);
    if (o->reference != NULL) {
        scene->width = size->width;
        scene->height = size->height;
    } else if (o->job.width == 0) {
        /* A film has at most 65536 pixels a side, so aspect is 1/256 to 256. */
        scene->width = (int)fmax(1, sqrt(PIXELS) * aspect + 0.5);
        scene->height = (int)fmax(1, sqrt(PIXELS) / aspect + 0.5);
    }
}

/* --- rendering both sides ---------------------------------------------------------------------------- */

static void choose_methods(const struct verify_options *o, const struct method *scenes, const struct method **m)
{
    const char *partner = strcmp(scenes->name, "bdpt") == 0 ? "asbdpt" : scenes->name;
    m[0] = method_find(o->first[0] != '\0' ? o->first : o->reference != NULL ? scenes->name : "bdpt");
    m[1] = o->reference != NULL ? NULL : method_find(o->second[0] != '\0' ? o->second : partner);
}

/* A stored reference NAME.pfm comes with NAME.error.pfm. */
static bool read_reference(const char *path, struct sizes *size, struct side *out, struct error *err)
{
    char picture[4096], error[4096], *both[2] = {picture, error};
    int stem = (int)strlen(path) - 4;
    if (stem < 1 || strcmp(path + stem, ".pfm") != 0)
        return error_set(err, "%s: a reference is a .pfm file", path);
    snprintf(picture, sizeof picture, "%s", path);
    snprintf(error, sizeof error, "%.*s.error.pfm", stem, path);
    bool ok = read_side(both, 2, true, size, out, err);
    out->name = path;
    return ok;
}

static bool render_sides(struct scene *scene, const struct method *scenes, const struct verify_options *o,
                         struct sizes *size, struct side *a, struct side *b, struct error *err)
{
    const struct method *m[2];
    choose_methods(o, scenes, m);
    if (o->reference != NULL && !read_reference(o->reference, size, b, err))
        return false;
    if (o->reference != NULL || o->job.width == 0) {
        int width = scene->width, height = scene->height;
        choose_resolution(scene, o, size);
        if (width != scene->width || height != scene->height)
            camera_prepare(&scene->camera, scene->width, scene->height);
    }
    long spp = o->job.spp > 0 ? o->job.spp : choose_spp(scene, m, o, err);
    if (spp == 0)
        return false;
    size->width = rect_width(render_crop(scene));
    size->height = rect_height(render_crop(scene));
    printf("%dx%d pixels, %d batches of %ld spp, seed %llu\n", size->width, size->height, o->batches, spp,
           (unsigned long long)o->job.seed);
    return render_side(scene, m[0], o, spp, 0, a, err) && (m[1] == NULL || render_side(scene, m[1], o, spp, 1, b, err));
}

/* --- results ----------------------------------------------------------------------------------------- */

static void print_verdict(const struct verdict *v, const struct side *a, const struct side *b, int width, int tile,
                          double alpha)
{
    double error_a, error_b;
    double mean_a = sample_mean(&a->pixels, &error_a), mean_b = sample_mean(&b->pixels, &error_b);
    long most = 1, across = (width + tile - 1) / tile;
    printf("A  %-24s mean %.6g +- %.2g\nB  %-24s mean %.6g +- %.2g\n", a->name, mean_a, error_a, b->name, mean_b, error_b);
    printf("p-values of A = B, %ld tiles and channels (uniform if all are equal)\n", v->n);
    for (int i = 0; i < VERIFY_BARS; i++)
        most = v->bar[i] > most ? v->bar[i] : most;
    for (int i = 0; i < VERIFY_BARS; i++) {
        static const char bars[] = "##################################################";
        printf("  %.1f-%.1f %6ld %.*s\n", i / 10.0, (i + 1) / 10.0, v->bar[i],
               (int)((double)v->bar[i] / (double)most * (double)(sizeof bars - 1)), bars);
    }
    printf("ratio of the means   %.5f +- %.5f\n", v->ratio, v->ratio_error);
    printf("p, means equal       %.3g\n", v->mean);
    printf("p, smallest (Sidak)  %.3g   tile of %d pixels at (%ld, %ld), channel %ld\n", v->smallest, tile,
           v->where / 3 % across * tile, v->where / 3 / across * tile, v->where % 3);
    printf("p, uniform (KS)      %.3g\n", v->uniform);
    printf("verdict: %s (p = %.3g at level %g)\n", v->p >= alpha ? "agree" : "DIFFER", v->p, alpha);
}

static int choose_tile(const struct verify_options *o, const struct sizes *size)
{
    int tile = o->tile > 0 ? o->tile : 4;
    while (o->tile == 0 && ((size->width + tile - 1) / tile) * ((size->height + tile - 1) / tile) > MOST_TILES)
        tile++;
    return tile;
}

/* --- storing a reference ----------------------------------------------------------------------------- */

/* Per pixel: mean over the batches, and the variance of that mean. Returns the sum of the variances. */
static double mean_image(const struct sample *s, double *mean, double *variance)
{
    double total = 0;
    for (long i = 0; i < s->n; i++) {
        mean[i] = variance[i] = 0;
        for (int k = 0; k < s->n_batches; k++)
            mean[i] += s->value[s->n * k + i] / s->n_batches;
        for (int k = 0; k < s->n_batches; k++) {
            double d = s->value[s->n * k + i] - mean[i];
            variance[i] += d * d / ((s->n_batches - 1.0) * s->n_batches);
        }
        total += variance[i];
    }
    return total;
}

static bool write_text(const struct verify_options *o, const struct verdict *v, const struct sizes *size, int max_depth,
                       double weight, const float *mean, const float *error, const struct side *a, const struct side *b,
                       struct error *err)
{
    char path[4096];
    struct file_output f;
    long n = 3L * size->width * size->height;
    double sum = 0, error_a, error_b;
    float *shifted = mem_alloc((size_t)n, sizeof *shifted);
    for (long i = 0; i < n; i++) {
        shifted[i] = mean[i] + error[i];
        sum += (double)mean[i];
    }
    double noise8 = compare_pixels(shifted, mean, n).rmse8;
    free(shifted);
    sample_mean(&a->pixels, &error_a);
    sample_mean(&b->pixels, &error_b);
    double mean_error = hypot(weight * error_a, (1 - weight) * error_b);
    snprintf(path, sizeof path, "%s.txt", o->store);
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "origin %s\nscene %s\nresolution %dx%d\nmaxdepth %d\nnoise8 %.6g\nmean %.9g\nmean_error %.6g\n",
            o->note, o->job.scene_path, size->width, size->height, max_depth, noise8, sum / (double)n,
            mean_error / (sum / (double)n));
    fprintf(f.stream, "weights %.6f %.6f of the two methods, by the inverse of the sum of all pixels' variances\n",
            weight, 1 - weight);
    fprintf(f.stream, "agreement p %.3g: smallest of the tiles %.3g, means %.3g, uniform %.3g; ratio of the means %.6f +- %.6f\n",
            v->p, v->smallest, v->mean, v->uniform, v->ratio, v->ratio_error);
    return file_commit(&f, err);
}

/* One weight for the whole picture: weights that follow each pixel's own variance would favour pixels that happen to be
 * dark, for they happen to scatter less. */
static bool store(const struct verify_options *o, const struct verdict *v, const struct sizes *size, int max_depth,
                  const struct side *a, const struct side *b, struct error *err)
{
    size_t n = 3 * (size_t)size->width * (size_t)size->height;
    double *part[4];
    float *mean = mem_alloc(n, sizeof *mean), *error = mem_alloc(n, sizeof *error);
    for (int i = 0; i < 4; i++)
        part[i] = mem_alloc(n, sizeof *part[i]);
    double variance_a = mean_image(&a->pixels, part[0], part[1]), variance_b = mean_image(&b->pixels, part[2], part[3]);
    double both = variance_a + variance_b, weight = both > 0 ? variance_b / both : 0.5;
    for (size_t i = 0; i < n; i++) {
        mean[i] = float_within(weight * part[0][i] + (1 - weight) * part[2][i]);
        error[i] = float_within(sqrt(weight * weight * part[1][i] + (1 - weight) * (1 - weight) * part[3][i]));
    }
    char path[4096];
    snprintf(path, sizeof path, "%s.pfm", o->store);
    bool ok = image_write(path, size->width, size->height, mean, err);
    snprintf(path, sizeof path, "%s.error.pfm", o->store);
    ok = ok && image_write(path, size->width, size->height, error, err) &&
         write_text(o, v, size, max_depth, weight, mean, error, a, b, err);
    for (int i = 0; i < 4; i++)
        free(part[i]);
    free(mean);
    free(error);
    return ok;
}

/* --- the command ------------------------------------------------------------------------------------- */

/* Test, print, store. */
static int judge(const struct verify_options *o, const struct sizes *size, int max_depth, const struct side *a,
                 const struct side *b, struct error *err)
{
    int tile = choose_tile(o, size);
    struct sample x = sample_tiles(&a->pixels, size->width, size->height, tile);
    struct sample y = sample_tiles(&b->pixels, size->width, size->height, tile);
    struct verdict v = verify_samples(&x, &y, o->job.seed, NULL);
    sample_free(&x);
    sample_free(&y);
    print_verdict(&v, a, b, size->width, tile, o->alpha);
    if (!(v.p >= o->alpha))
        return EXIT_JOB;
    return o->store == NULL || store(o, &v, size, max_depth, a, b, err) ? EXIT_OK : fail(err);
}

static int verify(const struct verify_options *o)
{
    struct error err;
    struct scene scene;
    struct sizes size = {0, 0};
    struct side a = {0}, b = {0};
    const struct method *method;
    int status = EXIT_OK, max_depth = 0;
    if (o->has_scene && (status = job_load(&o->job, &scene, &method)) != EXIT_OK)
        return status;
    bool ok = !o->has_scene || render_max_depth(&scene, o->job.max_depth, &max_depth, &err);
    if (ok && o->n_files > 0)
        ok = read_side(o->files, o->n_files, o->with_errors, &size, &a, &err) &&
             read_side(o->against, o->n_against, o->with_errors, &size, &b, &err);
    else if (ok)
        ok = render_sides(&scene, method, o, &size, &a, &b, &err);
    status = ok ? judge(o, &size, max_depth, &a, &b, &err) : fail(&err);
    sample_free(&a.pixels);
    sample_free(&b.pixels);
    if (o->has_scene)
        scene_free(&scene);
    return status;
}

int command_verify(int argc, char **argv)
{
    struct verify_options o;
    int status = parse(argc, argv, &o);
    if (status != EXIT_OK)
        return status;
    status = verify(&o);
    if (o.has_scene)
        job_options_free(&o.job);
    return status;
}
