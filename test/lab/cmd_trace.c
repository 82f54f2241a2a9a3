/* cmd_trace.c: asbdpt-lab trace SCENE --pixel X,Y: one sample of a pixel, or those that contribute most, in full. See
 * trace_report.h. */
#include <stdio.h>

#include "lab/commands.h"
#include "cli/job_options.h"
#include "lab/trace_report.h"
#include "lab/worst.h"

struct trace_options {
    struct job_options job;
    int pixel[2], sample, worst; /* worst 0: the one of the pixel */
    bool json, all;
    const char *svg; /* NULL: no drawing */
};

#define AT(member) offsetof(struct trace_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .written = true, .help = "a scene file"},
    {"--pixel", "X,Y", OPTION_PIXEL, AT(pixel), 0, 65535, .fallback = "0,0", .help = "of the film, 0,0 top left"},
    {"--sample", "K", OPTION_INTEGER, AT(sample), 0, 1 << 30, .fallback = "0", .help = "which, from 0"},
    {"--worst", "N", OPTION_INTEGER, AT(worst), 1, WORST_MOST,
     .help = "instead, the N samples of a render that contribute most to a pixel, found by rendering"},
    {"--all", NULL, OPTION_ON, AT(all), .help = "every vertex, density and connection, and what the columns mean"},
    {"--json", NULL, OPTION_ON, AT(json), .help = "print an object of JSON"},
    {"--svg", "FILE", OPTION_TEXT, AT(svg), .written = true, .help = "also draw the paths within the scene"},
    {.others = RUN_OPTIONS},
};

static void print_worst(const struct worst *w, const struct film *film, double film_scale)
{
    double scale = film_scale / (double)film->iterations;
    printf("The samples that contribute most to a pixel, in luminance of the picture:\n\n"
           "   luminance  of pixel's      pixel   by sample\n");
    for (int i = 0; i < w->n; i++) {
        const struct brought *b = &w->item[i];
        size_t row = (size_t)(b->to_y - film->rect.y0), column = (size_t)(b->to_x - film->rect.x0);
        size_t at = 3 * (row * (size_t)rect_width(film->rect) + column);
        rgb all = rgb_make(film_value(film, at), film_value(film, at + 1), film_value(film, at + 2));
        printf("  %10.4g  %10.4g %5d,%-5d %5ld of %d,%d\n", b->luminance * scale, rgb_luminance(all) * scale, b->to_x,
               b->to_y, b->iteration, b->x, b->y);
    }
}

/* The samples to tell of: the one that is named, or those that a render finds. */
static bool find(const struct trace_options *o, const struct scene *scene, struct render_options by,
                 struct worst *out, struct error *err)
{
    const struct brought named = {1, o->pixel[0], o->pixel[1], o->sample, 0, 0};
    struct film film;
    out->most = o->worst > 0 ? o->worst : 1;
    if (o->worst == 0) {
        worst_offer(out, named);
        return true;
    }
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = worst_render(scene, &by, &film, out, err);
    if (ok && !o->json)
        print_worst(out, &film, scene->film_scale);
    film_free(&film);
    return ok;
}

/* Tell of one sample, and draw it if there is a file for that. */
static bool tell(const struct trace_options *o, const struct render_options *render, struct trace_story *story,
                 const struct brought *sample, FILE *svg, struct error *err)
{
    struct trace trace = {.x = sample->x, .y = sample->y, .iteration = sample->iteration};
    bool ok = trace_render(story->scene, render, &trace, err);
    story->trace = &trace;
    if (ok && o->json)
        trace_json(stdout, story);
    else if (ok)
        trace_tell(stdout, story, o->all);
    if (ok && svg != NULL)
        trace_svg(svg, story);
    trace_free(&trace);
    return ok;
}

/* Of several the first is drawn; as JSON they are an array. */
static bool tell_all(const struct trace_options *o, const struct render_options *render, struct trace_story *story,
                     const struct worst *all, FILE *svg, struct error *err)
{
    bool ok = true, array = o->json && o->worst > 0;
    fputs(array ? "[" : "", stdout);
    for (int i = 0; ok && i < all->n; i++) {
        fputs(i > 0 && array ? "," : o->worst > 0 && !array ? "\n" : "", stdout);
        ok = tell(o, render, story, &all->item[i], i == 0 ? svg : NULL, err);
    }
    fputs(array ? "]\n" : "", stdout);
    return ok;
}

static int run(void *options)
{
    const struct trace_options *o = options;
    struct scene scene;
    const struct method *integrator;
    struct error err;
    struct worst all = {0};
    struct file_output svg = {.stream = NULL}; /* opened before the work */
    int status = job_load(&o->job, &scene, &integrator);
    if (status != EXIT_OK)
        return status;
    struct render_options render = job_render(&o->job, &scene, integrator);
    struct trace_story story = {o->job.scene_path, &scene, integrator, o->job.seed, NULL};
    bool ok = (o->svg == NULL || file_create(o->svg, &svg, &err)) && find(o, &scene, render, &all, &err) &&
              tell_all(o, &render, &story, &all, svg.stream, &err);
    if (svg.stream != NULL && ok)
        ok = file_commit(&svg, &err);
    else if (svg.stream != NULL)
        file_abandon(&svg);
    scene_free(&scene);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_trace = {
    "trace", "one sample of a pixel, told in ten lines or in full: sub-paths, choices, connections, weights",
    {"SCENE.pbrt --pixel X,Y [--sample K] [--all] [--json] [--svg FILE] [options]",
     "SCENE.pbrt --worst N [--all] [--json] [options]"},
    OPTIONS, sizeof(struct trace_options), run, true,
    "trace scenes/bathroom.pbrt --pixel 150,120 --svg paths.svg"};
