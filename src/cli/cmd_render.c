/* cmd_render.c: asbdpt render: a scene to pictures. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "cli/command.h"
#include "cli/job_options.h"
#include "cli/keep.h"
#include "cli/render_files.h"
#include "image/image.h"
#include "render/parameters.h"

#define AT(member) offsetof(struct job_options, member)
const struct option RENDER_OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(scene_path), 1, .help = "a scene file"},
    {"-o", "FILE", OPTION_TEXTS, AT(output), .alias = "--outfile", .written = true,
     .help = "image to write: linear .pfm or .exr, sRGB .png or .ppm; repeatable (default: the scene's Film name)"},
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", .help = EXPOSURE_HELP},
    {"--tonemap", "NAME", OPTION_TEXT, AT(tone.curve), .help = TONEMAP_HELP},
    {"--aov", "LIST", OPTION_TEXT, AT(aov),
     .help = "also write NAME.albedo.pfm and so on: some of albedo,normal,depth,position,variance"},
    {"--layers", NULL, OPTION_ON, AT(layers),
     .help = "write the images of --aov as layers of the .exr"},
    {"--seen", NULL, OPTION_ON, AT(seen),
     .help = "albedo and normal show what is seen in mirrors and through glass, for denoisers"},
    {"--lights", "DIR", OPTION_TEXT, AT(lights),
     .help = "write into DIR an image for each light, or each \"string group\" of lights; convert --weights adds them"},
    {"--alpha", NULL, OPTION_ON, AT(alpha),
     .help = "write alpha into .exr and .png: 0 where the lens sees nothing, or a light of \"bool visible\" \"false\""},
    {"--time", "TIME", OPTION_TIME, AT(keep.time), 1e-9, 1e9,
     .help = "render for at most TIME, in seconds or as 90s, 5m, 1h, and write the image so far (default: no limit)"},
    {"--noise", "X", OPTION_NUMBER, AT(keep.noise[NOISE_RELATIVE]), 1e-9, 1e9,
     .help = "stop when the noise is below X relative to the local brightness, e.g. 0.05; checked every 64 samples"},
    {"--noise8", "X", OPTION_NUMBER, AT(keep.noise[NOISE_8_BIT]), 1e-9, 1e9,
     .help = "stop when the noise is below X of the 255 levels of 8-bit images; with --noise, when both hold"},
    {"--preview", "TIME", OPTION_TIME, AT(keep.preview), 1e-9, 1e9,
     .help = "write the image so far to the first -o file after 1, 2, 4 ... seconds, then every TIME"},
    {"--checkpoint", "FILE", OPTION_TEXT, AT(keep.checkpoint), .written = true,
     .help = "save the render in FILE at intervals, and when a signal stops it"},
    {"--interval", "TIME", OPTION_TIME, AT(keep.interval), 0, 1e9, .fallback = "60",
     .help = "time between checkpoints in seconds"},
    {"--resume", "FILE", OPTION_TEXT, AT(keep.resume), .help = "continue the render that a checkpoint holds"},
    {"--samples", "FIRST:END", OPTION_RANGE, AT(keep.samples), 0, 1 << 30,
     .help = "render only the samples FIRST to END-1 of each pixel, for merge: -o NAME.part"},
    {"--stats", "FILE", OPTION_TEXT, AT(stats), .written = true,
     .help = "write parameters, times and memory as JSON"},
    {.others = RUN_OPTIONS},
};

/* The scene's Film filename, with .png in place of an extension this program does not write; never standard output. */
static char *default_output(const struct scene *scene)
{
    const char *name = scene->film_filename != NULL ? scene->film_filename : "asbdpt.png";
    size_t size = strlen(name) + 5;
    char *out = mem_alloc(size, 1);
    strcpy(out, name);
    if (!image_writable(out) || strcmp(out, "-") == 0) {
        const char *slash = os_last_separator(out);
        char *dot = strrchr(out, '.');
        if (dot != NULL && (slash == NULL || dot > slash))
            *dot = '\0';
        strcat(out, ".png");
    }
    return out;
}

/* All files that a render writes, opened before the work begins. */
struct files {
    struct outputs pictures;
    struct aov_files aov;
    struct file_output stats; /* its stream NULL: none; it is complete when all others are */
};

static void abandon(struct files *f)
{
    outputs_abandon(&f->pictures);
    outputs_abandon(&f->aov.out);
    if (f->stats.stream != NULL)
        file_abandon(&f->stats);
}

/* What can be said before the scene is loaded. What has no place in a part (render/part.h) is not there after
 * --resume. */
static bool check_options(const struct job_options *o, struct files *f, struct error *err)
{
    memset(f, 0, sizeof *f);
    if (o->keep.samples[1] > 0 && o->output.n == 0)
        return error_usage(err, "--samples needs -o NAME.part");
    if (!aov_read(o->aov, &f->aov, err))
        return false;
    if (o->keep.resume != NULL && f->aov.wanted[AOV_VARIANCE])
        return error_set(err, "%s: variance is not saved and cannot be resumed", o->keep.resume);
    return keep_check(&o->keep, err);
}

/* What needs no scene to be opened. */
static bool open_named(const struct job_options *o, struct files *f, struct error *err)
{
    return (o->output.n == 0 || outputs_open(&o->output, &o->tone, true, &f->pictures, err)) &&
           (o->stats == NULL || file_create(o->stats, &f->stats, err));
}

static bool open_default_output(const struct job_options *o, const struct scene *scene, struct outputs *out,
                                struct error *err)
{
    struct texts names = {0};
    char *name = default_output(scene);
    texts_add(&names, name);
    bool ok = outputs_open(&names, &o->tone, false, out, err);
    free(names.item);
    free(name);
    return ok;
}

/* Does every file have a name of its own? Layers are in a file that is written first without them. */
static bool names_differ(struct job_options *o, const struct scene *scene, const struct files *f, struct error *err)
{
    struct texts names = {0};
    options_written(RENDER_OPTIONS, o, &names);
    for (int i = o->output.n; i < f->pictures.n; i++)
        texts_add(&names, f->pictures.item[i].file.path);
    for (int i = 0; i < f->aov.out.n && !o->layers; i++)
        texts_add(&names, f->aov.out.item[i].file.path);
    bool ok = texts_differ(&names, err) && job_spares(scene, &names, err);
    free(names.item);
    return ok;
}

/* What the scene names, or what is written next to that, once the scene is loaded. */
static bool open_others(struct job_options *o, const struct scene *scene, struct files *f, struct error *err)
{
    return (f->pictures.n > 0 || open_default_output(o, scene, &f->pictures, err)) &&
           (o->keep.preview == 0 || outputs_previews(&f->pictures, err)) &&
           aov_open(&f->aov, o->layers, &f->pictures, err) && lights_open(o->lights, scene, &f->pictures, err) &&
           names_differ(o, scene, f, err);
}

/* The last line. Who has not chosen a method may not know which the scene has. */
static void report(const struct job_options *o, const char *integrator, long n_warnings, const struct film *film,
                   const struct render_times *times)
{
    bool other = o->integrator == NULL && strcmp(integrator, "asbdpt") != 0;
    char warnings[48] = "";
    if (n_warnings > 0)
        snprintf(warnings, sizeof warnings, "; %ld warning%s about the scene", n_warnings, n_warnings > 1 ? "s" : "");
    if (!o->quiet)
        say_line("%s: %dx%d, %ld spp, %s%s; %.2f s, %.2f s of CPU, %.2f us per sample path%s", o->scene_path,
                 rect_width(film->rect), rect_height(film->rect), film->iterations, integrator,
                 other ? " (for asbdpt: --integrator asbdpt)" : "", times->wall, times->cpu,
                 render_us_per_path(film, times), warnings);
}

/* What the camera sees in front of all else, as far as a few rays tell. */
static void describe_view(const struct scene *scene, struct pixel_rect r, char *text, size_t size)
{
    enum { RAYS = 32 }; /* on each axis */
    double nearest = INFINITY;
    snprintf(text, size, "it sees no surface");
    for (int i = 0; i < RAYS * RAYS; i++) {
        double x = (i % RAYS + 0.5) / RAYS, y = (i / RAYS + 0.5) / RAYS;
        struct ray ray = camera_ray(&scene->camera, r.x0 + x * rect_width(r), r.y0 + y * rect_height(r), 0.5, 0.5);
        struct surface at;
        double d = scene_intersect(scene, &ray, &at) ? length(sub(at.p, ray.o)) : INFINITY;
        vec3 p = add(at.p, scene->origin);
        if (d < nearest)
            snprintf(text, size, "the nearest surface that it sees is at (%g %g %g), %.3g away%s", p.x, p.y, p.z, d,
                     dot(at.ng, ray.d) > 0 ? ", and faces away" : "");
        nearest = fmin(d, nearest);
    }
}

/* A picture without any light is rarely what was wanted. Less than FAINT is not light: rounding lets connections along
 * a surface through. */
static void warn_of_black(const struct scene *scene, const struct film *film, const char *integrator,
                          const float *pixels)
{
    const float FAINT = 1e-20f;
    char why[300] = "the scene has no light", view[200];
    for (size_t i = 0; i < rect_pixels(film->rect) * 3; i++)
        if (!(fabsf(pixels[i]) < FAINT))
            return;
    describe_view(scene, film->rect, view, sizeof view);
    if (film_samples(film) == 0)
        snprintf(why, sizeof why, "no sample is complete");
    else if (scene->lights.n > 0)
        snprintf(why, sizeof why, "no light has reached the camera by %s; %s", integrator, view);
    say_line("asbdpt: warning: the image is black: %s", why);
}

/* Pictures, then what can only be made now, and when all are complete the statistics. `ok`: nothing has failed yet. */
static bool write_files(const struct job_options *o, const struct scene *scene, struct render_options *options,
                        const struct film *film, struct keep *keep, struct files *f, bool ok, struct error *err)
{
    float *pixels = mem_alloc(rect_pixels(film->rect) * 3, sizeof *pixels), *alpha = film_alpha(film);
    film_warn(film, film_develop(film, scene->film_scale, pixels));
    warn_of_black(scene, film, options->integrator, pixels);
    f->pictures.alpha = f->aov.out.alpha = alpha;
    ok = outputs_write(&f->pictures, rect_width(film->rect), rect_height(film->rect), pixels, o->quiet,
                       ok ? err : NULL) && ok;
    keep_after(keep, options);
    ok = aov_write(&f->aov, scene, options, film, o->seen, pixels, o->quiet, ok ? err : NULL) && ok;
    progress_end(&keep->bar);
    free(alpha);
    free(pixels);
    if (ok && f->stats.stream != NULL)
        return file_commit(&f->stats, err);
    abandon(f);
    return ok;
}

/* From a film with nothing or something in it to all files. */
static bool run_and_write(const struct job_options *o, const struct scene *scene, struct render_options *options,
                          double load_seconds, struct film *film, struct keep *keep, struct files *files,
                          struct error *err)
{
    struct render_times times = {.load = load_seconds, .cpu = os_cpu_seconds(), .samples = film_samples(film)};
    bool ok = render_scene(scene, options, film, err);
    times.cpu = os_cpu_seconds() - times.cpu;
    times.wall = os_wall_seconds() - keep->bar.start;
    times.samples = film_samples(film) - times.samples;
    bool kept = keep_end(keep, ok, err);
    if (!ok)
        return false;
    if (files->stats.stream != NULL)
        stats_write(files->stats.stream, o, scene, options, film, &files->pictures, &files->aov.out, &times);
    ok = write_files(o, scene, options, film, keep, files, kept, err);
    report(o, options->integrator, scene->n_warnings, film, &times);
    return ok;
}

static bool render(const struct job_options *o, const struct scene *scene, const struct method *m, double load_seconds,
                   struct files *files, struct error *err)
{
    struct render_options options = job_render(o, scene, m);
    struct film film;
    struct keep keep;
    const struct planes planes = {o->lights != NULL ? scene->lights.n_groups : 0, o->alpha};
    struct error why;
    if (!budget_has(&scene->memory, film_bytes(render_crop(scene), planes), &why))
        return error_set(err, "%s: its film of %dx%d pixels: %s; --res makes it smaller", o->scene_path, scene->width,
                         scene->height, why.text);
    film_init(&film, render_crop(scene), scene->width, scene->height);
    film_keep_planes(&film, planes);
    bool ok = parameters_max_depth(scene, o->max_depth, &options.max_depth, err) &&
              keep_begin(&keep, &o->keep, o->quiet, scene, &options, &film, &files->pictures, err);
    if (ok) {
        if (files->aov.wanted[AOV_VARIANCE])
            film_keep_errors(&film);
        files->pictures.place = files->aov.out.place = keep.part.place;
        files->pictures.part = &keep.part;
        files->pictures.film = &film;
        ok = run_and_write(o, scene, &options, load_seconds, &film, &keep, files, err);
        part_free(&keep.part);
    }
    film_free(&film);
    return ok;
}

static int run(void *options)
{
    struct job_options *o = options;
    struct error err;
    struct scene scene;
    const struct method *integrator;
    struct files files;
    double start = os_wall_seconds();
    bool ok = check_options(o, &files, &err) && open_named(o, &files, &err);
    int status = ok ? job_load(o, &scene, &integrator) : fail(&err);
    if (status == EXIT_OK) {
        double load_seconds = os_wall_seconds() - start;
        ok = open_others(o, &scene, &files, &err) &&
             render(o, &scene, integrator, load_seconds, &files, &err);
        scene_free(&scene);
        status = ok ? EXIT_OK : fail(&err);
    }
    abandon(&files); /* what is not written yet */
    return ok && interrupt_caught() != 0 ? 128 + interrupt_caught() : status;
}

const struct command command_render = {
    "render", "render a scene to images", {"SCENE.pbrt [-o FILE.{pfm,exr,png,ppm}]... [options]"}, RENDER_OPTIONS,
    sizeof(struct job_options), run, false,
    "render scenes/veach-ajar.pbrt --quick --spp 16 -o out/ajar.png"};
