/* cmd_verify.c: asbdpt verify: have two integrators, or two pictures, the same expectation? See verify.h. */
#include <stdio.h>
#include <string.h>

#include "lab/commands.h"
#include "cli/job_options.h"
#include "lab/sides.h"
#include "render/parameters.h"

struct verify_options {
    struct job_options job;
    const char *methods;   /* A or A,B; or NULL */
    const char *reference; /* a stored picture instead of the second integrator, or NULL */
    const char *store;     /* write the mean of both sides as STORE.pfm ..., or NULL */
    const char *note;
    struct texts files, against; /* pictures */
    struct texts images;         /* of both sides, each picture followed by its standard errors */
    int batches, tile;
    double alpha;
    /* What follows from the above: */
    bool has_scene, with_errors; /* with errors, files[0..1] and against[0..1] are a picture and its standard errors */
    char first[64], second[64];  /* integrators; "": the default */
};

/* --- options ----------------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct verify_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), .help = "a scene file"},
    {"--methods", "A,B", OPTION_TEXT, AT(methods), .help = "integrators (default: bdpt and the scene's, or asbdpt)"},
    {"--reference", "R.pfm", OPTION_TEXT, AT(reference), .help = "a picture, beside R.error.pfm, instead of B"},
    {"--images", "FILE...", OPTION_TEXTS, AT(images), .help = "pictures, each followed by its standard errors"},
    {"--files", "FILE...", OPTION_TEXTS, AT(files), .help = "pictures that differ in nothing but their seeds"},
    {"--against", "FILE...", OPTION_TEXTS, AT(against), .help = "the pictures of the other side"},
    {"--store", "NAME", OPTION_TEXT, AT(store), .help = "write the mean of both sides as NAME.pfm, .error.pfm, .txt"},
    {"--note", "TEXT", OPTION_TEXT, AT(note), .help = "where a stored reference comes from"},
    {"--batches", "N", OPTION_INTEGER, AT(batches), 4, 10000, .fallback = "12", .help = "renders of each side"},
    {"--tile", "N", OPTION_INTEGER, AT(tile), 1, 10000, .help = "side of the squares of pixels that are compared"},
    {"--alpha", "P", OPTION_NUMBER, AT(alpha), 1e-12, 0.5, .fallback = "0.001", .help = "share of false alarms"},
    {.others = RUN_OPTIONS},
};

static bool choose_sides(struct verify_options *o)
{
    struct error known;
    if (o->methods != NULL)
        sscanf(o->methods, "%63[^,],%63s", o->first, o->second);
    const char *wrong = o->first[0] != '\0' && !method_exists(o->first) ? o->first : o->second;
    if (wrong[0] == '\0' || method_exists(wrong))
        return true;
    integrator_unknown(wrong, &known);
    return usage_error(&command_verify, "--methods: there is no method %s; %s", wrong, known.text) == EXIT_OK;
}

/* One side is --files, the other --against; --images has both, or one, each with its errors. */
static bool choose_pictures(struct verify_options *o)
{
    o->with_errors = o->images.n > 0;
    for (int i = 0; i < o->images.n; i++)
        texts_add(i < 2 ? &o->files : &o->against, o->images.item[i]);
    return o->with_errors ? o->files.n == 2 && o->against.n == 2 : o->files.n > 1 && o->against.n > 1;
}

static bool complete(struct verify_options *o)
{
    bool pictures = o->files.n + o->images.n > 0;
    o->has_scene = o->job.scene_path != NULL;
    bool good = pictures ? choose_pictures(o) && (o->store == NULL || o->has_scene) : o->has_scene && o->store == NULL;
    if (good)
        return choose_sides(o);
    const char *const *usage = command_verify.usage;
    usage_error(&command_verify, "usage: asbdpt verify %s, or %s, or %s", usage[0], usage[1], usage[2]);
    return false;
}

/* --- both sides -------------------------------------------------------------------------------------- */

static bool choose_integrators(const struct job_options *job, const struct scene *scene, const struct method *scenes,
                               const struct method **m, struct error *err)
{
    const struct verify_options *o = (const struct verify_options *)job; /* its first member */
    const char *partner = strcmp(scenes->name, "bdpt") == 0 ? "asbdpt" : scenes->name;
    const char *first = o->first[0] != '\0' ? o->first : o->reference != NULL ? scenes->name : "bdpt";
    const char *second = o->second[0] != '\0' ? o->second : partner;
    m[0] = method_find(first, &scene->settings, err);
    m[1] = o->reference != NULL ? NULL : method_find(second, &scene->settings, err);
    return m[0] != NULL && (o->reference != NULL || m[1] != NULL);
}

static bool render_sides(struct scene *scene, const struct method *scenes, const struct verify_options *o,
                         struct side *a, struct side *b, struct error *err)
{
    const struct method *m[2];
    struct render_options options = {.seed = o->job.seed, .n_threads = o->job.n_threads, .max_depth = o->job.max_depth};
    bool ok = true;
    if (!choose_integrators(&o->job, scene, scenes, m, err))
        return false;
    if (o->reference != NULL && !side_read_reference(o->reference, b, err))
        return false;
    if ((o->reference != NULL || o->job.res[0] == 0) &&
        !side_choose_resolution(scene, o->reference != NULL ? b : NULL, err))
        return false;
    options.end = o->job.spp > 0 ? o->job.spp : side_choose_spp(scene, &options, m, o->batches, err);
    if (options.end == 0)
        return false;
    printf("%dx%d pixels, %d batches of %ld spp, seed %llu\n", rect_width(render_crop(scene)),
           rect_height(render_crop(scene)), o->batches, options.end, (unsigned long long)o->job.seed);
    for (int i = 0; ok && i < 2 && m[i] != NULL; i++) {
        options.integrator = m[i]->name;
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

/* The same values and errors: no test can tell them apart, nor from pictures made with the same random numbers. What is
 * not finite is the same as nothing. */
static bool identical(const struct batches *a, const struct batches *b)
{
    bool same = a->n == b->n && a->n > 0;
    for (long i = 0; same && i < a->n; i++)
        same = a->value[i] - b->value[i] == 0 && a->error[i] - b->error[i] == 0;
    return same;
}

/* Test, print, store. */
static int judge(const struct verify_options *o, uint64_t content, int max_depth, const struct side *a,
                 const struct side *b, struct error *err)
{
    if (o->with_errors && identical(&a->pixels, &b->pixels)) {
        printf("verdict: identical (pixel by pixel the same values and errors; there is nothing to test)\n");
        return EXIT_OK;
    }
    int tile = o->tile > 0 ? o->tile : side_choose_tile(a);
    struct batches x = batches_tiles(&a->pixels, a->width, a->height, tile);
    struct batches y = batches_tiles(&b->pixels, b->width, b->height, tile);
    struct verdict v = verify_batches(&x, &y, o->job.seed);
    struct provenance from = {o->note != NULL ? o->note : "", o->job.scene_path, content, max_depth, &v};
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
    const struct method *integrator;
    int status = EXIT_OK, max_depth = 0;
    if (o->has_scene && (status = job_load_for(&o->job, choose_integrators, &scene, &integrator)) != EXIT_OK)
        return status;
    bool ok = !o->has_scene || parameters_max_depth(&scene, o->job.max_depth, &max_depth, &err);
    if (ok && o->files.n > 0)
        ok = side_read(o->files.item, o->files.n, o->with_errors, NULL, &a, &err) &&
             side_read(o->against.item, o->against.n, o->with_errors, &a, &b, &err);
    else if (ok)
        ok = render_sides(&scene, integrator, o, &a, &b, &err);
    status = ok ? judge(o, o->has_scene ? scene.content : 0, max_depth, &a, &b, &err) : fail(&err);
    batches_free(&a.pixels);
    batches_free(&b.pixels);
    if (o->has_scene)
        scene_free(&scene);
    return status;
}

static int run(void *options) { return complete(options) ? verify(options) : EXIT_USAGE; }

const struct command command_verify = {
    "verify", "test that two methods, or two pictures, agree",
    {"SCENE.pbrt [--methods A,B | --methods A --reference R.pfm] [options]",
     "--images A.pfm A.error.pfm B.pfm B.error.pfm",
     "SCENE.pbrt --files A.pfm... --against B.pfm... [--store NAME]"},
    OPTIONS, sizeof(struct verify_options), run, true,
    "verify scenes/cornell-box.pbrt --methods pt,bdpt --res 24x24 --spp 16"};
