/* job_options.c: see job_options.h. */
#include "cli/job_options.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "cli/command.h"
#include "parser/parser.h"

#define AT(member) offsetof(struct job_options, member)
const struct option RUN_OPTIONS[] = {
    {"--nthreads", "N", OPTION_INTEGER, AT(n_threads), 1, 1024, .alias = "-j",
     .help = "number of threads (default: one for each processor)"},
    {"--seed", "N", OPTION_SEED, AT(seed), .fallback = "0", .help = "choose another set of random numbers"},
    {.others = JOB_OPTIONS},
};

const struct option JOB_OPTIONS[] = {
    {"--integrator", "NAME", OPTION_TEXT, AT(integrator),
     .help = "rendering method, see asbdpt help integrators (default: the scene's, else bdpt)"},
    {"-P", "NAME=VALUE", OPTION_PAIRS, AT(overrides), .help = "set a parameter of the integrator; repeatable"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 30, .help = "samples per pixel (default: the scene's, else 16)"},
    {"--quick", NULL, OPTION_ON, AT(quick),
     .help = "a quarter of the width and height unless --res is given, one sample per pixel unless --spp is given"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(max_depth), 1, PATH_MAX_DEPTH,
     .help = "longest path, where 1 is direct light (default: the scene's, else 5)"},
    {"--res", "WIDTH[xHEIGHT]", OPTION_WIDTH, AT(res), 1, 65536,
     .help = "size of the film in pixels; a width alone keeps its shape (default: the scene's)"},
    {"--filter", "NAME", OPTION_TEXT, AT(filter),
     .help = "pixel filter: box, triangle, gaussian, mitchell or sinc (default: the scene's)"},
    {"--cropwindow", "X0 X1 Y0 Y1", OPTION_WINDOW, AT(crop), 0, 1,
     .help = "render only this part of the film, in fractions from 0 to 1 (default: the scene's)"},
    {"--max-memory", "GB", OPTION_NUMBER, AT(max_memory), 1e-3, 1e9,
     .help = "gigabytes that the scene and its film may take (default: three quarters of the machine's memory)"},
    {"--strict", NULL, OPTION_ON, AT(strict), .help = "treat warnings about the scene as errors"},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "print errors and warnings alone"}, {.name = NULL}};

static void print_message(void *context, bool is_error, const char *text)
{
    struct job_loading *to = context;
    to->n_warnings += !is_error;
    say_line("asbdpt: %s%s", is_error || to->options->strict ? "" : "warning: ", text);
}

bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err)
{
    for (int i = 0; i < outputs->n; i++)
        for (int k = 0; k < scene->n_files; k++)
            if (strcmp(outputs->item[i], "-") != 0 && os_same_file(outputs->item[i], scene->file[k]))
                return error_usage(err, "%s: the scene is read from this file; an output needs another name",
                                   outputs->item[i]);
    return true;
}

static void override(const char *pair, struct settings *settings)
{
    char *name = mem_copy_text(pair), *equals = strchr(name, '=');
    *equals = '\0';
    settings_set(settings, name, equals + 1, "-P");
    free(name);
}

static bool apply(const struct job_options *o, struct scene *scene, struct error *err)
{
    if (o->res[0] > 0) {
        struct error why;
        scene_resize(scene, o->res[0], o->res[1]);
        if (!picture_size_ok((uint64_t)scene->width, (uint64_t)scene->height, &why))
            return error_usage(err, "--res: %s", why.text);
    } else if (o->quick) {
        scene->width = scene->width > 4 ? scene->width / 4 : 1;
        scene->height = scene->height > 4 ? scene->height / 4 : 1;
    }
    if (o->filter != NULL && !filter_default(o->filter, &scene->filter))
        return error_usage(err, "--filter %s: known are box, triangle, gaussian, mitchell, sinc", o->filter);
    if (o->crop[1] > 0)
        memcpy(scene->crop, o->crop, sizeof o->crop);
    for (int i = 0; i < o->overrides.n; i++)
        override(o->overrides.item[i], &scene->settings);
    char depth[16];
    snprintf(depth, sizeof depth, "maxdepth=%d", o->max_depth);
    if (o->max_depth > 0)
        override(depth, &scene->settings);
    struct pixel_rect crop = render_crop(scene);
    if (rect_width(crop) < 1 || rect_height(crop) < 1)
        return o->crop[1] > 0 ? error_usage(err, "--cropwindow holds no pixel")
                              : error_set(err, "the crop window holds no pixel");
    return true;
}

/* A warning about the scene as a whole. */
static void warn(struct job_loading *to, const char *format, ...)
{
    char text[ERROR_TEXT_SIZE / 2];
    struct error line;
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    error_set(&line, "%s: %s", to->options->scene_path, text);
    print_message(to, false, line.text);
}

/* The method asked for; pbrt's integrators that do not exist here are replaced by the default. */
static const struct method *choose_method(const struct scene *scene, struct job_loading *to, struct error *err)
{
    const struct job_options *o = to->options;
    const char *name = o->integrator != NULL ? o->integrator : scene->integrator != NULL ? scene->integrator : "bdpt";
    if (o->integrator != NULL || method_exists(name))
        return method_find(name, &scene->settings, err);
    warn(to, "integrator \"%s\" does not exist here; bdpt is used, which computes all light up to maxdepth", name);
    return method_find("bdpt", &scene->settings, err);
}

int job_open(struct job_loading *l, struct scene *scene, const struct method **method)
{
    const struct job_options *o = l->options;
    struct error err;
    struct message_sink sink = {print_message, l};
    const struct parse_options options = {o->integrator, 1e9 * o->max_memory};
    if (!parse_scene(o->scene_path, &options, scene, &sink, NULL))
        return EXIT_JOB;
    l->n_warnings = scene->n_warnings;
    if (apply(o, scene, &err) && (*method = choose_method(scene, l, &err)) != NULL)
        return EXIT_OK;
    scene_free(scene);
    return fail(&err);
}

static long wanted_spp(const struct job_options *o, const struct scene *scene)
{
    return o->spp > 0 ? o->spp : o->quick ? 1 : scene->spp > 0 ? scene->spp : 16;
}

/* Vertices are floats, and shadow rays begin a step of theirs away from surfaces: see doc/design-notes.md. */
enum { FAR_AWAY = 1000 };

static void warn_of_size(struct job_loading *l, const struct scene *scene)
{
    vec3 center = add(scene->lights.center, scene->origin);
    if (scene->media.ends)
        warn(l, "a medium without a bound ends on a sphere of radius %g about (%g %g %g), beyond which the infinite "
             "and distant lights are", scene->lights.radius, center.x, center.y, center.z);
    double distance = length(scene->lights.center) / scene->lights.radius; /* from the camera, in radii */
    if (distance > FAR_AWAY)
        warn(l, "the scene is %.3g times its own radius away from the camera; above %d light passes through edges, "
             "by rounding: move the camera nearer", distance, FAR_AWAY);
}

/* The filter must be prepared. */
static void set_samples(const struct job_options *o, const struct scene *scene, struct job *job)
{
    long wanted = wanted_spp(o, scene), cycle = filter_cycle(&scene->filter);
    job->options.end = job->options.planned = (wanted + cycle - 1) / cycle * cycle;
    if (!o->quiet && job->options.end > wanted)
        say_line("asbdpt: a pixel filter with negative lobes takes samples in fours: %ld, not %ld", job->options.end,
                 wanted);
}

int job_ready(struct job_loading *l, const struct method *const *readers, struct scene *scene, struct job *job)
{
    const struct job_options *o = l->options;
    const struct render_options options = {.integrator = readers[0], .seed = o->seed, .n_threads = o->n_threads,
                                           .max_depth = o->max_depth};
    struct error err;
    struct message_sink sink = {print_message, l};
    if (!job_adapt(scene, readers, &sink, &err) || !job_settle(scene, &options, job, &err)) {
        scene_free(scene);
        return fail(&err);
    }
    scene_prepare(scene);
    warn_of_size(l, scene);
    set_samples(o, scene, job);
    scene->n_warnings = l->n_warnings;
    if (!o->strict || l->n_warnings == 0)
        return EXIT_OK;
    error_set(&err, "%s: refused for what is said above, by --strict", o->scene_path);
    job_free(job);
    scene_free(scene);
    return fail(&err);
}

int job_load(const struct job_options *o, struct scene *scene, struct job *job)
{
    struct job_loading l = {.options = o};
    const struct method *readers[2] = {NULL, NULL};
    int status = job_open(&l, scene, &readers[0]);
    return status == EXIT_OK ? job_ready(&l, readers, scene, job) : status;
}
