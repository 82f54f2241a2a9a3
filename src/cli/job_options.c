/* job_options.c: the options that the subcommands which load a scene share; see command.h. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/parallel.h"
#include "cli/command.h"
#include "image/picture.h"
#include "parser/parser.h"

int fail(const struct error *err)
{
    fprintf(stderr, "asbdpt: %s\n", err->text);
    return EXIT_JOB;
}

int usage_error(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fprintf(stderr, "asbdpt: ");
    vfprintf(stderr, format, args);
    fprintf(stderr, "; try asbdpt --help\n");
    va_end(args);
    return EXIT_USAGE;
}

bool integer_option(const char *option, const char *text, long low, long high, long *out)
{
    char *end;
    long v = strtol(text, &end, 10);
    if (end == text || *end != '\0' || v < low || v > high) {
        usage_error("%s %s: expected an integer from %ld to %ld", option, text, low, high);
        return false;
    }
    *out = v;
    return true;
}

/* The whole number at the head of *text, which is moved behind it; 0 if there is none from 1 to `high`. */
static int count_at(const char **text, int high)
{
    char *end;
    if (!isdigit((unsigned char)**text))
        return 0;
    long v = strtol(*text, &end, 10); /* what a long cannot hold becomes its largest */
    *text = end;
    return v <= high ? (int)v : 0;
}

int size_option(const char *text, int high, int *width, int *height)
{
    int w = count_at(&text, high);
    if (w > 0 && *text == '\0') {
        *width = w;
        return 1;
    }
    int h = w > 0 && *text++ == 'x' ? count_at(&text, high) : 0;
    if (h == 0 || *text != '\0')
        return 0;
    *width = w;
    *height = h;
    return 2;
}

/* --- reading the arguments --------------------------------------------------------------------------- */

struct argument_list {
    int argc, at;
    char **argv;
};

/* The next argument as the value of `option`, or NULL after a message. */
static const char *value_of(struct argument_list *a, const char *option)
{
    if (a->at + 1 >= a->argc) {
        usage_error("%s needs a value", option);
        return NULL;
    }
    return a->argv[++a->at];
}

static bool integer_of(struct argument_list *a, const char *option, long low, long high, long *out)
{
    const char *text = value_of(a, option);
    return text != NULL && integer_option(option, text, low, high, out);
}

static bool seed_of(struct argument_list *a, uint64_t *out)
{
    const char *text = value_of(a, "--seed");
    if (text == NULL)
        return false;
    char *end;
    errno = 0;
    unsigned long long v = strtoull(text, &end, 10);
    *out = v;
    if (!isdigit((unsigned char)text[0]) || *end != '\0' || errno != 0 || *out != v) {
        usage_error("--seed %s: expected a whole number from 0 to 18446744073709551615", text);
        return false;
    }
    return true;
}

static bool resolution_of(struct argument_list *a, struct job_options *o)
{
    const char *text = value_of(a, "--res");
    if (text == NULL)
        return false;
    if (size_option(text, 65536, &o->width, &o->height) != 2) {
        usage_error("--res %s: expected WIDTHxHEIGHT, each from 1 to 65536", text);
        return false;
    }
    struct error why;
    if (!picture_size_ok((unsigned long)o->width, (unsigned long)o->height, &why)) {
        usage_error("--res %s: %s", text, why.text);
        return false;
    }
    return true;
}

static bool crop_of(struct argument_list *a, struct job_options *o)
{
    for (int i = 0; i < 4; i++) {
        const char *text = value_of(a, "--cropwindow");
        if (text == NULL)
            return false;
        char *end;
        o->crop[i] = strtod(text, &end);
        if (end == text || *end != '\0' || !(o->crop[i] >= 0 && o->crop[i] <= 1)) {
            usage_error("--cropwindow: %s is not a number from 0 to 1", text);
            return false;
        }
    }
    o->has_crop = true;
    if (o->crop[0] < o->crop[1] && o->crop[2] < o->crop[3])
        return true;
    usage_error("--cropwindow X0 X1 Y0 Y1: the window is empty");
    return false;
}

static bool parameter_of(struct argument_list *a, struct job_options *o)
{
    const char *text = value_of(a, "-P");
    if (text == NULL)
        return false;
    const char *equals = strchr(text, '=');
    if (equals == NULL || equals == text) {
        usage_error("-P %s: expected name=value", text);
        return false;
    }
    char *name = mem_copy_text(text);
    name[equals - text] = '\0';
    settings_set(&o->overrides, name, equals + 1, "-P");
    free(name);
    return true;
}

static bool text_of(struct argument_list *a, const char *option, const char **out)
{
    *out = value_of(a, option);
    return *out != NULL;
}

static bool one_option(struct argument_list *a, struct job_options *o)
{
    const char *name = a->argv[a->at];
    long n;
    if (strcmp(name, "-o") == 0)
        return text_of(a, name, &o->output[o->n_outputs]) && ++o->n_outputs;
    if (strcmp(name, "-P") == 0)
        return parameter_of(a, o);
    if (strcmp(name, "--integrator") == 0)
        return text_of(a, name, &o->integrator);
    if (strcmp(name, "--filter") == 0)
        return text_of(a, name, &o->filter);
    if (strcmp(name, "--strategies") == 0)
        return text_of(a, name, &o->strategies);
    if (strcmp(name, "--res") == 0)
        return resolution_of(a, o);
    if (strcmp(name, "--cropwindow") == 0)
        return crop_of(a, o);
    if (strcmp(name, "--seed") == 0)
        return seed_of(a, &o->seed);
    if (strcmp(name, "--quiet") == 0)
        return o->quiet = true;
    if (strcmp(name, "--spp") == 0)
        return integer_of(a, name, 1, 1L << 30, &o->spp);
    if (strcmp(name, "--maxdepth") == 0) {
        if (!integer_of(a, name, 1, PATH_MAX_DEPTH, &n))
            return false;
        o->max_depth = (int)n;
        return true;
    }
    if (strcmp(name, "--nthreads") == 0 || strncmp(name, "-j", 2) == 0) {
        if (strncmp(name, "-j", 2) == 0 && name[2] != '\0') { /* -j4 */
            char *end;
            n = strtol(name + 2, &end, 10);
            if (*end != '\0' || n < 1 || n > 1024)
                return usage_error("%s: expected a number of threads from 1 to 1024", name) == EXIT_OK;
        } else if (!integer_of(a, name, 1, 1024, &n)) {
            return false;
        }
        o->n_threads = (int)n;
        return true;
    }
    return usage_error("unknown option %s", name) == EXIT_OK;
}

int job_options_parse(int argc, char **argv, struct job_options *out)
{
    memset(out, 0, sizeof *out);
    out->output = mem_alloc((size_t)argc, sizeof *out->output);
    out->n_threads = parallel_cores();
    struct argument_list a = {argc, 1, argv};
    for (; a.at < argc; a.at++) {
        bool is_option = argv[a.at][0] == '-' && argv[a.at][1] != '\0';
        bool ok = true;
        if (is_option)
            ok = one_option(&a, out);
        else if (out->scene_path == NULL)
            out->scene_path = argv[a.at];
        else
            ok = usage_error("one scene at a time: %s and %s", out->scene_path, argv[a.at]) == EXIT_OK;
        if (!ok) {
            job_options_free(out);
            return EXIT_USAGE;
        }
    }
    if (out->scene_path != NULL)
        return EXIT_OK;
    job_options_free(out);
    return usage_error("%s needs a scene file", argv[0]);
}

void job_options_free(struct job_options *o)
{
    free(o->output);
    settings_clear(&o->overrides);
}

/* --- loading the scene ------------------------------------------------------------------------------- */

static void print_warning(void *context, const char *text)
{
    (void)context;
    fprintf(stderr, "asbdpt: warning: %s\n", text);
}

static bool apply(const struct job_options *o, struct scene *scene, struct error *err)
{
    if (o->width > 0) {
        scene->width = o->width;
        scene->height = o->height;
    }
    if (o->filter != NULL && !filter_default(o->filter, &scene->filter))
        return error_set(err, "--filter %s: known are box, triangle, gaussian, mitchell, sinc", o->filter);
    if (o->has_crop)
        memcpy(scene->crop, o->crop, sizeof o->crop);
    for (int i = 0; i < o->overrides.n; i++)
        settings_set(&scene->settings, o->overrides.item[i].name, o->overrides.item[i].value, "-P");
    struct pixel_rect crop = render_crop(scene);
    if (rect_width(crop) < 1 || rect_height(crop) < 1)
        return error_set(err, "the crop window holds no pixel");
    return true;
}

/* The method asked for; pbrt's integrators that do not exist here are replaced by the default. */
static const struct method *choose_method(const struct job_options *o, const struct scene *scene, struct error *err)
{
    const char *name = o->integrator != NULL ? o->integrator : scene->integrator;
    const struct method *m = method_find(name != NULL ? name : "bdpt");
    if (m != NULL)
        return m;
    if (o->integrator == NULL) {
        error_set(err, "integrator \"%s\" does not exist here; using bdpt", name);
        print_warning(NULL, err->text);
        return method_find("bdpt");
    }
    char known[256] = "";
    for (const struct method *const *k = method_list(); *k != NULL; k++)
        snprintf(known + strlen(known), sizeof known - strlen(known), " %s", (*k)->name);
    error_set(err, "--integrator %s does not exist; known are:%s", name, known);
    return NULL;
}

/* pbrt has three strategies, and scenes name all of them; picking lights uniformly only adds noise. */
static void warn_of_uniform(const struct scene *scene)
{
    const struct setting *item = settings_find(&scene->settings, "lightsamplestrategy");
    struct error text;
    if (item == NULL || strcmp(item->value, "uniform") != 0)
        return;
    error_set(&text, "%s: lights are not picked uniformly here; \"power\" is used instead", item->origin);
    print_warning(NULL, text.text);
}

int job_load(const struct job_options *o, struct scene *scene, const struct method **method)
{
    struct error err;
    struct warning_sink sink = {print_warning, NULL};
    if (!parse_scene(o->scene_path, scene, o->quiet ? NULL : &sink, &err))
        return fail(&err);
    *method = NULL;
    if (!apply(o, scene, &err) || (*method = choose_method(o, scene, &err)) == NULL) {
        scene_free(scene);
        return fail(&err);
    }
    if (!o->quiet)
        warn_of_uniform(scene);
    scene_prepare(scene);
    return EXIT_OK;
}

long job_spp(const struct job_options *o, const struct scene *scene)
{
    return o->spp > 0 ? o->spp : scene->spp > 0 ? scene->spp : 16;
}
