/* cmd_trace.c: asbdpt-lab trace SCENE --pixel X,Y: one sample of a pixel in full. See trace.h. */
#include <stdio.h>

#include "lab/commands.h"
#include "library/job_options.h"
#include "lab/trace.h"

struct trace_options {
    struct render_job job;
    int pixel[2], sample;
    bool brightest, all, values;
    const char *svg; /* NULL: no drawing */
};

#define AT(member) offsetof(struct trace_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .help = "a scene file"},
    {"--pixel", "X,Y", OPTION_PIXEL, AT(pixel), 0, 65535, .fallback = "0,0", .help = "of the film, 0,0 top left"},
    {"--sample", "K", OPTION_INTEGER, AT(sample), 0, 1 << 30, .fallback = "0", .help = "which, from 0"},
    {"--brightest", NULL, OPTION_ON, AT(brightest), .help = "instead, the sample that contributes most to the pixel"},
    {"--all", NULL, OPTION_ON, AT(all), .help = "every vertex, density and connection, and what the columns mean"},
    {"--values", NULL, OPTION_ON, AT(values), .help = "instead, a line for each number, NAME VALUE, for scripts"},
    {"--svg", "FILE", OPTION_TEXT, AT(svg), .written = true, .help = "also draw the paths within the scene"},
    {.others = RUN_OPTIONS},
};

static int run(void *options)
{
    struct trace_options *o = options;
    struct scene scene;
    struct prepared prepared;
    struct error err;
    struct trace trace = {.x = o->pixel[0], .y = o->pixel[1], .iteration = o->brightest ? TRACE_BRIGHTEST : o->sample,
                          .wants_splats = o->values};
    struct file_output svg = {.stream = NULL}; /* opened before the work */
    int status = load_job(&o->job, &scene, &prepared);
    if (status != EXIT_OK)
        return status;
    const struct trace_story story = {o->job.scene_path, &scene, o->job.integrator, o->job.seed, &trace};
    struct texts outputs = {(const char **)&o->svg, o->svg != NULL};
    bool ok = job_spares(&scene, &outputs, &err) && (o->svg == NULL || file_create(o->svg, &svg, &err)) &&
              trace_render(&scene, &o->job, &trace, &err);
    if (ok && o->values)
        trace_values(stdout, &story);
    else if (ok)
        trace_tell(stdout, &story, o->all);
    if (ok && svg.stream != NULL)
        trace_svg(svg.stream, &story);
    if (svg.stream != NULL && ok)
        ok = file_commit(&svg, &err);
    else if (svg.stream != NULL)
        file_abandon(&svg);
    trace_free(&trace);
    method_release(&prepared);
    scene_free(&scene);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_trace = {
    "trace", "one sample of a pixel, told in ten lines or in full: sub-paths, choices, connections, weights",
    {"SCENE.pbrt --pixel X,Y [--sample K | --brightest] [--all | --values] [--svg FILE] [options]"},
    OPTIONS, sizeof(struct trace_options), run, true,
    "trace scenes/bathroom.pbrt --pixel 150,120 --svg out/paths.svg"};
