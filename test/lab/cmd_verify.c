/* cmd_verify.c: asbdpt-lab verify: have two methods, or two pictures, the same expectation? See verify.h. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "library/job_options.h"
#include "lab/commands.h"
#include "lab/conform.h"
#include "lab/methods.h"
#include "lab/sides.h"
#include "render/job.h"

/* Where a side comes from: pictures, or a method that renders them. */
struct source {
    const char *const *file; /* [n]; n = 0: there are none */
    int n;
    bool with_errors;        /* two files: a picture and its standard errors */
    struct measured method;  /* without a text: the default */
};

struct verify_options {
    struct render_job job;
    const char *methods;   /* A or A,B; or NULL */
    const char *reference; /* a stored picture instead of the second method, or NULL */
    const char *store;     /* write the mean of both sides as STORE.pfm ..., or NULL */
    const char *note;
    struct texts files, against; /* pictures */
    struct texts images;         /* of both sides, each picture followed by its standard errors */
    int batches, tile;
    double alpha;
    /* What follows from the above: */
    struct source source[2];
    const struct method *by[2]; /* who renders a side; NULL: it is pictures */
    const char *stored[2]; /* the reference and its errors */
    char errors_path[4096];
};

/* --- options ----------------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct verify_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), .help = "a scene file"},
    {"--methods", "A,B", OPTION_TEXT, AT(methods),
     .help = METHODS_HELP " (default: " METHOD_REFERENCE " and the scene's, or " METHOD_PARTNER ")"},
    {"--reference", "R.pfm", OPTION_TEXT, AT(reference), .help = "an image, with R.error.pfm next to it, instead of B"},
    {"--images", "FILE...", OPTION_LIST, AT(images), .help = "pictures, each followed by its standard errors"},
    {"--files", "FILE...", OPTION_LIST, AT(files), .help = "pictures that differ in nothing but their seeds"},
    {"--against", "FILE...", OPTION_LIST, AT(against), .help = "the pictures of the other side"},
    {"--store", "NAME", OPTION_TEXT, AT(store), .help = "write the mean of both sides as NAME.pfm, .error.pfm, .txt"},
    {"--note", "TEXT", OPTION_TEXT, AT(note), .help = "where a stored reference comes from"},
    {"--batches", "N", OPTION_INTEGER, AT(batches), 4, 10000, .fallback = "12", .help = "renders of each side"},
    {"--tile", "N", OPTION_INTEGER, AT(tile), 1, 10000, .help = "side of the squares of pixels that are compared"},
    {"--alpha", "P", OPTION_NUMBER, AT(alpha), 1e-12, 0.5, .fallback = "0.001", .help = "share of false alarms"},
    {.others = RUN_OPTIONS},
};

/* The pictures of both sides, as far as there are any. */
static bool choose_pictures(struct verify_options *o, struct error *err)
{
    struct source *a = &o->source[0], *b = &o->source[1];
    if (o->images.n > 0) {
        a->file = o->images.item;
        b->file = o->images.item + 2;
        a->n = b->n = 2;
        a->with_errors = b->with_errors = true;
        return o->images.n == 4;
    }
    a->file = o->files.item;
    a->n = o->files.n;
    if (o->against.n > 0) {
        b->file = o->against.item;
        b->n = o->against.n;
        return a->n > 1 && b->n > 1;
    }
    if (o->reference != NULL) {
        o->stored[0] = o->reference;
        o->stored[1] = o->errors_path;
        b->file = o->stored;
        b->n = 2;
        b->with_errors = true;
        return side_errors_path(o->reference, o->errors_path, sizeof o->errors_path, err);
    }
    return a->n == 0;
}

static bool choose_methods(struct verify_options *o, struct error *err)
{
    struct methods list = {.n = 0};
    const char *comma = o->methods != NULL ? strchr(o->methods, ',') : NULL;
    char first[METHOD_TEXT];
    if (o->methods == NULL)
        return true;
    snprintf(first, sizeof first, "%.*s", (int)strcspn(o->methods, ","), o->methods);
    if (!methods_read(first, &list, err)) /* one by one, as both may be the same */
        return false;
    o->source[0].method = list.item[0];
    if (list.n == 1 && comma != NULL && !methods_read(comma + 1, &list, err))
        return false;
    if (comma != NULL)
        o->source[1].method = list.item[0];
    return list.n == 1 || error_set(err, "%s: two methods are compared", o->methods);
}

static bool complete(struct verify_options *o)
{
    struct error err = {.text = ""};
    bool scene = o->job.scene_path != NULL, both = o->files.n + o->images.n > 0;
    if (choose_pictures(o, &err) && (both ? scene || o->store == NULL : scene && o->store == NULL)) {
        if (choose_methods(o, &err))
            return true;
        usage_error(&command_verify, "--methods: %s", err.text);
        return false;
    }
    const char *const *usage = command_verify.usage;
    if (err.text[0] != '\0')
        usage_error(&command_verify, "%s", err.text);
    else
        usage_error(&command_verify, "usage: asbdpt-lab verify %s, or %s, or %s", usage[0], usage[1], usage[2]);
    return false;
}

/* --- both sides -------------------------------------------------------------------------------------- */

/* The one or two that render: what was given; or one that renders references, and the scene's or its partner. */
static bool choose_integrators(struct verify_options *o, const struct scene *scene, const struct method *scenes,
                               struct error *err)
{
    const char *partner = strcmp(scenes->name, METHOD_REFERENCE) == 0 ? METHOD_PARTNER : scenes->name;
    for (int i = 0; i < 2; i++) {
        const struct measured *given = &o->source[i].method;
        const char *usual = i == 1 ? partner : o->source[1].n > 0 ? scenes->name : METHOD_REFERENCE;
        if (o->source[i].n > 0)
            continue;
        struct settings s = measured_settings(given, &scene->settings);
        o->by[i] = method_find(given->text[0] != '\0' ? given->integrator : usual, &s, err);
        settings_clear(&s);
        if (o->by[i] == NULL)
            return false;
    }
    return true;
}

/* Render a side, with its own settings on top of the scene's. */
static bool render_side(struct scene *scene, const struct verify_options *o, int number, struct side *out,
                        struct error *err)
{
    static const double seconds = 20; /* of rendering */
    const struct measured *given = &o->source[number].method;
    struct render_job options = {.integrator = o->by[number], .seed = o->job.seed,
                                 .n_threads = o->job.n_threads, .max_depth = o->job.max_depth};
    struct settings shared = scene->settings;
    scene->settings = measured_settings(given, &shared);
    options.end = o->job.spp > 0 ? o->job.spp : side_choose_spp(scene, &options, o->batches, seconds, err);
    bool ok = options.end > 0 && side_render(scene, &options, number, o->batches, o->job.quiet, out, err);
    out->name = given->text[0] != '\0' ? given->text : o->by[number]->name;
    if (ok)
        printf("%s: %dx%d pixels, %d batches of %ld spp, seed %llu\n", out->name, out->width, out->height, o->batches,
               options.end, (unsigned long long)o->job.seed);
    settings_clear(&scene->settings);
    scene->settings = shared;
    return ok;
}

/* Pictures are read first, as they say how large the others are to be.
 *   side  [2] */
static bool make_sides(struct scene *scene, const struct verify_options *o, struct side *side, struct error *err)
{
    const struct side *like = NULL;
    for (int i = 0; i < 2; i++) {
        const struct source *from = &o->source[i];
        if (from->n > 0 && !side_read(from->file, from->n, from->with_errors, like, &side[i], err))
            return false;
        if (from->n > 0 && !from->with_errors && conform_distinct(&side[i]) > 0)
            printf("%s: of %d pictures %d differ; the others are identical to these\n", side[i].name, from->n,
                   side[i].pixels.n_batches);
        like = from->n > 0 ? &side[i] : like;
    }
    if (o->source[0].n > 0 && o->source[1].n > 0)
        return true;
    if ((like != NULL || o->job.res[0] == 0) && !side_choose_resolution(scene, like, err))
        return false;
    for (int i = 0; i < 2; i++)
        if (o->by[i] != NULL && !render_side(scene, o, i, &side[i], err))
            return false;
    return true;
}

/* --- the verdict ------------------------------------------------------------------------------------- */

/* The p-values that are tested, and how many are expected if A = B: a bar of '#', and '|' at its expected end. */
static void print_bars(const struct verdict *v)
{
    enum { WIDTH = 50 };
    double most = 1;
    printf("p-values of A = B, %ld tiles and channels; | is what to expect if all are equal\n"
           "           found  expected\n", v->n);
    for (int i = 0; i < VERIFY_BARS; i++)
        most = fmax(most, fmax(v->bar[i], v->expected[i]));
    for (int i = 0; i < VERIFY_BARS; i++) {
        int found = int_within(v->bar[i] / most * WIDTH, 0, WIDTH);
        int expected = int_within(v->expected[i] / most * WIDTH, 0, WIDTH);
        char bar[WIDTH + 2];
        memset(bar, ' ', sizeof bar);
        memset(bar, '#', (size_t)found);
        bar[expected] = '|';
        bar[(found > expected ? found : expected + 1)] = '\0';
        printf("  %.1f-%.1f %7.0f %9.1f %s\n", i / 10.0, (i + 1) / 10.0, v->bar[i], v->expected[i], bar);
    }
}

static void print_verdict(const struct verdict *v, const struct side *a, const struct side *b, int tile, double alpha)
{
    double error_a, error_b;
    double mean_a = batches_mean(&a->pixels, &error_a), mean_b = batches_mean(&b->pixels, &error_b);
    long across = (a->width + tile - 1) / tile;
    printf("A  %-24s mean %.6g +- %.2g\n", a->name, mean_a, error_a);
    printf("B  %-24s mean %.6g +- %.2g\n", b->name, mean_b, error_b);
    print_bars(v);
    printf("ratio of the means   %.5f +- %.5f\n", v->ratio, v->ratio_error);
    printf("p, means equal       %.3g\n", v->mean);
    printf("p, smallest (Sidak)  %.3g   tile of %d pixels at (%ld, %ld), channel %ld\n", v->smallest, tile,
           v->where / 3 % across * tile, v->where / 3 / across * tile, v->where % 3);
    printf("p, uniform (KS)      %.3g\n", v->uniform);
    printf("verdict: %s (p = %.3g at level %g)\n", v->p >= alpha ? "agree" : "DIFFER", v->p, alpha);
}

/* The same values and errors: no test can tell them apart, or from pictures made with the same random numbers. What is
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
    if (o->source[0].with_errors && o->source[1].with_errors && identical(&a->pixels, &b->pixels)) {
        printf("verdict: identical (pixel by pixel the same values and errors; there is nothing to test)\n");
        return EXIT_OK;
    }
    int tile = o->tile > 0 ? o->tile : side_choose_tile(a);
    struct batches x = b->pixels.error != NULL ? conform_tiles(a, b, tile) :
                                                 batches_tiles(&a->pixels, a->width, a->height, tile);
    if (x.n_batches > a->pixels.n_batches)
        printf("%d pictures alone: their variance is taken from blocks of pixels, as if these were independent\n",
               a->pixels.n_batches);
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

static int load(struct verify_options *o, struct scene *scene, int *max_depth)
{
    struct render_job job = o->job;
    struct prepared prepared;
    const struct method *readers[3] = {NULL, NULL, NULL};
    struct error err;
    if (!job_open(&job, scene, &err))
        return job_failed(&err);
    bool ok = choose_integrators(o, scene, job.integrator, &err);
    readers[0] = job.integrator; /* of files alone nothing is rendered: the scene's reads what it says */
    for (int i = 0, n = 0; i < 2; i++)
        if (o->by[i] != NULL)
            readers[n++] = o->by[i];
    if (!ok) {
        scene_free(scene);
        return fail(&err);
    }
    if (!job_ready(&job, readers, scene, &prepared, &err))
        return job_failed(&err);
    *max_depth = job.max_depth;
    method_release(&prepared);
    return EXIT_OK;
}

static int verify(struct verify_options *o)
{
    struct error err;
    struct scene scene;
    struct side side[2] = {{.name = ""}, {.name = ""}};
    bool has_scene = o->job.scene_path != NULL;
    int status = EXIT_OK, max_depth = 0;
    if (has_scene && (status = load(o, &scene, &max_depth)) != EXIT_OK)
        return status;
    bool ok = make_sides(&scene, o, side, &err);
    status = ok ? judge(o, has_scene ? scene.content : 0, max_depth, &side[0], &side[1], &err) : fail(&err);
    batches_free(&side[0].pixels);
    batches_free(&side[1].pixels);
    if (has_scene)
        scene_free(&scene);
    return status;
}

static int run(void *options) { return complete(options) ? verify(options) : EXIT_USAGE; }

const struct command command_verify = {
    "verify", "test that two methods, or two pictures, agree",
    {"SCENE.pbrt [--methods A,B | --methods A --reference R.pfm] [options]",
     "--images A.pfm A.error.pfm B.pfm B.error.pfm",
     "[SCENE.pbrt] --files A.pfm... [--against B.pfm... [--store NAME] | --reference R.pfm]"},
    OPTIONS, sizeof(struct verify_options), run, true,
    "verify scenes/cornell-box.pbrt --methods pt,bdpt --res 24x24 --spp 16"};
