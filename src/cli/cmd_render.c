/* cmd_render.c: asbdpt render: a scene to pictures. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "cli/aov_files.h"
#include "cli/command.h"
#include "cli/job_options.h"
#include "cli/keep.h"
#include "cli/names.h"
#include "cli/outputs.h"
#include "cli/stats_file.h"
#include "cli/strategy_files.h"
#include "image/image.h"
#include "render/parameters.h"

#define AT(member) offsetof(struct job_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(scene_path), 1, .file = FILE_READ, .help = "a scene file"},
    {"-o", "FILE", OPTION_TEXTS, AT(output), .alias = "--outfile",
     .file = FILE_WRITTEN, .help = "linear .pfm .exr, sRGB .png .ppm; repeatable"},
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", .help = EXPOSURE_HELP},
    {"--tonemap", "NAME", OPTION_TEXT, AT(tone.curve), .help = TONEMAP_HELP},
    {"--aov", "LIST", OPTION_TEXT, AT(aov), .help = "also NAME.albedo.pfm ...: albedo,normal,depth,position,variance"},
    {"--strategies", "DIR", OPTION_TEXT, AT(strategies),
     .help = "write every strategy (s,t), and all as DIR/pyramid.png"},
    {"--time", "TIME", OPTION_NUMBER, AT(keep.time), 1e-9, 1e9,
     .help = "stop after so long, and write what there is"},
    {"--checkpoint", "FILE", OPTION_TEXT, AT(keep.checkpoint), .file = FILE_KEPT,
     .help = "save the render now and then, and at signals"},
    {"--interval", "TIME", OPTION_NUMBER, AT(keep.interval), 0, 1e9, .with = "--checkpoint", .fallback = "60",
     .help = "between checkpoints"},
    {"--resume", "FILE", OPTION_TEXT, AT(keep.resume), .file = FILE_KEPT, .help = "go on from a checkpoint"},
    {"--learnt", "FILE", OPTION_TEXT, AT(keep.learnt), .file = FILE_WRITTEN,
     .help = "what the method learns: read, if there is such a file, else written; for the parts of a picture"},
    {"--samples", "FIRST:END", OPTION_INTEGER, AT(keep.samples), 0, 1 << 30, .with = "-o",
     .help = "only the samples FIRST to END-1, for merge: -o NAME.part"},
    {"--stats", "FILE", OPTION_TEXT, AT(stats), .file = FILE_WRITTEN, .help = "JSON: parameters, times, memory"},
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

/* Those that are named are open already. */
static bool open_default_output(const struct job_options *o, const struct scene *scene, struct names *all,
                                struct outputs *out, struct error *err)
{
    if (out->n > 0)
        return true;
    struct texts names = {0};
    char *name = default_output(scene);
    texts_add(&names, name);
    bool ok = names_add(all, FILE_WRITTEN, "the film's", name, err) &&
              outputs_open(&names, &o->tone, PARTS_NONE, out, err);
    free(names.item);
    free(name);
    return ok;
}

static bool write_outputs(const struct job_options *o, const struct scene *scene, const struct film *film,
                          struct outputs *out, struct error *err)
{
    int width = rect_width(film->rect), height = rect_height(film->rect);
    float *pixels = mem_alloc((size_t)width * (size_t)height * 3, sizeof *pixels);
    film_warn(film, film_develop(film, scene->film_scale, pixels));
    bool ok = outputs_write(out, width, height, pixels, o->quiet, err);
    free(pixels);
    return ok;
}

static bool wants_variance(const struct job_options *o)
{
    return o->aov != NULL && strstr(o->aov, aov_name(AOV_VARIANCE)) != NULL;
}

/* Beside the first picture. */
static bool open_aovs(const struct job_options *o, const struct scene *scene, const struct outputs *pictures,
                      struct names *all, struct aov_files *out, struct error *err)
{
    if (wants_variance(o) && job_spp(o, scene) < 2)
        return error_set(err, "--aov variance needs two samples per pixel at least, see --spp");
    return aov_open(o->aov, pictures->file[0].path, all, out, err);
}

static void report(const struct job_options *o, const char *integrator, const struct film *film,
                   const struct render_times *times)
{
    if (!o->quiet)
        fprintf(stderr, "%s: %dx%d, %ld spp, %s; %.2f s, %.2f s of CPU, %.2f us per sample path\n", o->scene_path,
                rect_width(film->rect), rect_height(film->rect), film->iterations, integrator,
                times->wall, times->cpu, render_us_per_path(film, times));
    if (!o->quiet && film->note[0] != '\0')
        fprintf(stderr, "%s: %s\n", integrator, film->note);
}

/* What has no place in a part (render/part.h) is not there after --resume. */
static bool check_options(const struct job_options *o, struct error *err)
{
    if (o->keep.resume != NULL && (o->strategies != NULL || wants_variance(o)))
        return error_set(err, "%s: strategies and variance are not saved and cannot be resumed", o->keep.resume);
    return strategies_possible(o->strategies, err) && keep_check(&o->keep, err) &&
           (o->aov == NULL || aov_check(o->aov, err));
}

/* Samples of a chain are neither a pixel's own nor independent. */
static bool suits(const struct job_options *o, const struct method *m, struct error *err)
{
    const char *wanted = wants_variance(o) ? "--aov variance" : o->strategies != NULL ? "--strategies" : NULL;
    return !m->chain || wanted == NULL ||
           error_set(err, "%s: the samples of %s are a chain, and do not show that; render several --seed", wanted,
                     m->name);
}

/* All that a render writes, opened before the work begins. */
struct files {
    struct outputs pictures;
    struct aov_files aov;
    struct stats_file stats;
};

static void abandon(struct files *f)
{
    outputs_abandon(&f->pictures);
    aov_abandon(&f->aov);
    stats_abandon(&f->stats);
}

/* From a film with nothing or something in it to all files. */
static bool run_and_write(const struct job_options *o, const struct scene *scene, struct render_options *options,
                          struct film *film, struct keep *keep, struct files *files, struct error *err)
{
    struct render_times times = {.cpu = os_cpu_seconds(), .samples = film->iterations};
    bool ok = render_scene(scene, options, film, err);
    times.cpu = os_cpu_seconds() - times.cpu;
    times.wall = os_wall_seconds() - keep->bar.start;
    times.samples = film->iterations - times.samples;
    bool kept = keep_end(keep, ok, err);
    keep->part.carries = false; /* an output that is a part has what was learnt by its hash alone */
    if (!ok) {
        abandon(files);
        return false;
    }
    report(o, options->integrator, film, &times);
    stats_list(&files->stats, o, &files->pictures, &files->aov);
    ok = kept;
    ok = aov_write(&files->aov, scene, options, film, o->quiet, ok ? err : NULL) && ok;
    ok = write_outputs(o, scene, film, &files->pictures, ok ? err : NULL) && ok;
    ok = strategies_write(o->strategies, film, scene->film_scale, ok ? err : NULL) && ok;
    if (!ok)
        stats_abandon(&files->stats);
    return ok && stats_write(&files->stats, o, scene, options, film, &times, err);
}

/* Whatever comes of it, the outputs are written or abandoned. */
static bool render_and_write(const struct job_options *o, const struct scene *scene, const struct method *m,
                             struct files *files, struct error *err)
{
    struct render_options options = job_render(o, scene, m);
    struct film film;
    struct keep keep;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = parameters_max_depth(scene, o->max_depth, &options.max_depth, err) &&
              keep_begin(&keep, &o->keep, o->quiet, scene, &options, &film, err);
    if (ok) {
        if (o->strategies != NULL)
            film_keep_strategies(&film, options.max_depth);
        if (files->aov.file[AOV_VARIANCE].n > 0)
            film_keep_errors(&film);
        files->pictures.place = keep.part.place;
        files->pictures.part = &keep.part;
        files->pictures.film = &film;
        ok = run_and_write(o, scene, &options, &film, &keep, files, err);
        part_free(&keep.part);
    } else {
        abandon(files);
    }
    film_free(&film);
    return ok;
}

/* What the scene names, or what lies beside that, once the scene is loaded; all are different files. */
static bool open_others(struct job_options *o, const struct scene *scene, struct files *f, struct error *err)
{
    struct names all = {0};
    bool ok = names_add_options(&all, OPTIONS, o, err) &&
              open_default_output(o, scene, &all, &f->pictures, err) &&
              open_aovs(o, scene, &f->pictures, &all, &f->aov, err) &&
              strategies_check(o->strategies, scene, o->max_depth, &all, err);
    names_free(&all);
    return ok;
}

/* What needs no scene to be opened. False with a message; nothing is open then. */
static bool open_named(const struct job_options *o, struct files *f, struct error *err)
{
    enum outputs_parts parts = o->keep.samples[1] > 0 ? PARTS_OTHERS : PARTS_NAMED;
    memset(f, 0, sizeof *f);
    if (o->output.n > 0 && !outputs_open(&o->output, &o->tone, parts, &f->pictures, err))
        return false;
    bool ok = stats_open(o->stats, &f->stats, err);
    if (!ok)
        outputs_abandon(&f->pictures);
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
    if (!check_options(o, &err) || !open_named(o, &files, &err))
        return fail(&err);
    int status = job_load(o, &scene, &integrator);
    if (status != EXIT_OK) {
        abandon(&files);
        return status;
    }
    files.stats.load_seconds = os_wall_seconds() - start;
    bool ok = suits(o, integrator, &err) && open_others(o, &scene, &files, &err);
    if (ok)
        ok = render_and_write(o, &scene, integrator, &files, &err);
    else
        abandon(&files);
    scene_free(&scene);
    if (!ok)
        return fail(&err);
    return interrupt_caught() != 0 ? 128 + interrupt_caught() : EXIT_OK;
}

const struct command command_render = {
    "render", "render a scene", {"SCENE.pbrt [-o FILE.{pfm,exr,png,ppm}]... [options]"}, OPTIONS,
    sizeof(struct job_options), run, false,
    "render scenes/veach-ajar.pbrt --quick --spp 16 -o ajar.png"};
