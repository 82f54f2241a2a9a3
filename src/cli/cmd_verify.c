/* cmd_verify.c: asbdpt verify: have two methods, or two pictures, the same expectation? See verify.h for the tests. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "cli/command.h"
#include "lab/sides.h"

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
    *out = strtod(text, &end);
    if (end != text && *end == '\0' && *out >= low && *out <= high)
        return true;
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

/* --- both sides -------------------------------------------------------------------------------------- */

static void choose_methods(const struct verify_options *o, const struct method *scenes, const struct method **m)
{
    const char *partner = strcmp(scenes->name, "bdpt") == 0 ? "asbdpt" : scenes->name;
    m[0] = method_find(o->first[0] != '\0' ? o->first : o->reference != NULL ? scenes->name : "bdpt");
    m[1] = o->reference != NULL ? NULL : method_find(o->second[0] != '\0' ? o->second : partner);
}

static bool render_sides(struct scene *scene, const struct method *scenes, const struct verify_options *o,
                         struct side *a, struct side *b, struct error *err)
{
    const struct method *m[2];
    struct render_options options = {.seed = o->job.seed, .n_threads = o->job.n_threads, .max_depth = o->job.max_depth};
    bool ok = true;
    choose_methods(o, scenes, m);
    if (o->reference != NULL && !side_read_reference(o->reference, b, err))
        return false;
    if (o->reference != NULL || o->job.width == 0)
        side_choose_resolution(scene, o->reference != NULL ? b : NULL);
    options.end = o->job.spp > 0 ? o->job.spp : side_choose_spp(scene, &options, m, o->batches, err);
    if (options.end == 0)
        return false;
    printf("%dx%d pixels, %d batches of %ld spp, seed %llu\n", rect_width(render_crop(scene)),
           rect_height(render_crop(scene)), o->batches, options.end, (unsigned long long)o->job.seed);
    for (int i = 0; ok && i < 2 && m[i] != NULL; i++) {
        options.method = m[i];
        ok = side_render(scene, &options, i, o->batches, o->job.quiet, i == 0 ? a : b, err);
    }
    return ok;
}

/* --- the verdict ------------------------------------------------------------------------------------- */

static void print_verdict(const struct verdict *v, const struct side *a, const struct side *b, int tile, double alpha)
{
    static const char bars[] = "##################################################";
    double error_a, error_b;
    double mean_a = batches_mean(&a->pixels, &error_a), mean_b = batches_mean(&b->pixels, &error_b);
    long most = 1, across = (a->width + tile - 1) / tile;
    printf("A  %-24s mean %.6g +- %.2g\n", a->name, mean_a, error_a);
    printf("B  %-24s mean %.6g +- %.2g\n", b->name, mean_b, error_b);
    printf("p-values of A = B, %ld tiles and channels (uniform if all are equal)\n", v->n);
    for (int i = 0; i < VERIFY_BARS; i++)
        most = v->bar[i] > most ? v->bar[i] : most;
    for (int i = 0; i < VERIFY_BARS; i++)
        printf("  %.1f-%.1f %6ld %.*s\n", i / 10.0, (i + 1) / 10.0, v->bar[i],
               (int)((double)v->bar[i] / (double)most * (double)(sizeof bars - 1)), bars);
    printf("ratio of the means   %.5f +- %.5f\n", v->ratio, v->ratio_error);
    printf("p, means equal       %.3g\n", v->mean);
    printf("p, smallest (Sidak)  %.3g   tile of %d pixels at (%ld, %ld), channel %ld\n", v->smallest, tile,
           v->where / 3 % across * tile, v->where / 3 / across * tile, v->where % 3);
    printf("p, uniform (KS)      %.3g\n", v->uniform);
    printf("verdict: %s (p = %.3g at level %g)\n", v->p >= alpha ? "agree" : "DIFFER", v->p, alpha);
}

/* Test, print, store. */
static int judge(const struct verify_options *o, int max_depth, const struct side *a, const struct side *b,
                 struct error *err)
{
    int tile = o->tile > 0 ? o->tile : side_choose_tile(a);
    struct batches x = batches_tiles(&a->pixels, a->width, a->height, tile);
    struct batches y = batches_tiles(&b->pixels, b->width, b->height, tile);
    struct verdict v = verify_batches(&x, &y, o->job.seed);
    struct provenance from = {o->note, o->job.scene_path, max_depth, &v};
    batches_free(&x);
    batches_free(&y);
    print_verdict(&v, a, b, tile, o->alpha);
    if (!(v.p >= o->alpha))
        return EXIT_JOB;
    return o->store == NULL || sides_store(o->store, a, b, &from, err) ? EXIT_OK : fail(err);
}

static int verify(const struct verify_options *o)
{
    struct error err;
    struct scene scene;
    struct side a = {0}, b = {0};
    const struct method *method;
    int status = EXIT_OK, max_depth = 0;
    if (o->has_scene && (status = job_load(&o->job, &scene, &method)) != EXIT_OK)
        return status;
    bool ok = !o->has_scene || render_max_depth(&scene, o->job.max_depth, &max_depth, &err);
    if (ok && o->n_files > 0)
        ok = side_read(o->files, o->n_files, o->with_errors, NULL, &a, &err) &&
             side_read(o->against, o->n_against, o->with_errors, &a, &b, &err);
    else if (ok)
        ok = render_sides(&scene, method, o, &a, &b, &err);
    status = ok ? judge(o, max_depth, &a, &b, &err) : fail(&err);
    batches_free(&a.pixels);
    batches_free(&b.pixels);
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
