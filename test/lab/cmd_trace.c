/* cmd_trace.c: asbdpt-lab trace SCENE --pixel X,Y: one sample of a pixel, told in full. See trace_report.h. */
#include <stdio.h>

#include "lab/commands.h"
#include "cli/job_options.h"
#include "lab/trace_report.h"

struct trace_options {
    struct job_options job;
    int pixel[2], sample;
    bool json;
    const char *svg; /* NULL: no drawing */
};

#define AT(member) offsetof(struct trace_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .file = FILE_READ, .help = "a scene file"},
    {"--pixel", "X,Y", OPTION_INTEGER, AT(pixel), 0, 65535, .fallback = "0,0", .help = "of the film, 0,0 top left"},
    {"--sample", "K", OPTION_INTEGER, AT(sample), 0, 1 << 30, .fallback = "0", .help = "which, from 0"},
    {"--json", NULL, OPTION_ON, AT(json), .help = "print an object of JSON"},
    {"--svg", "FILE", OPTION_TEXT, AT(svg), .file = FILE_WRITTEN, .help = "also draw the paths within the scene"},
    {.others = RUN_OPTIONS},
};

/* The drawing's file is opened before the work. */
static bool tell(const struct trace_options *o, const struct render_options *render, const struct trace_story *story,
                 struct trace *trace, struct error *err)
{
    struct file_output svg = {.stream = NULL};
    if (o->svg != NULL && !file_create(o->svg, &svg, err))
        return false;
    bool ok = render_trace(story->scene, render, trace, err);
    if (ok && o->json)
        trace_json(stdout, story);
    else if (ok)
        trace_text(stdout, story);
    if (svg.stream == NULL)
        return ok;
    if (ok)
        trace_svg(svg.stream, story);
    else
        file_abandon(&svg);
    return ok && file_commit(&svg, err);
}

static int run(void *options)
{
    const struct trace_options *o = options;
    struct scene scene;
    const struct method *integrator;
    struct error err;
    int status = job_load(&o->job, &scene, &integrator);
    if (status != EXIT_OK)
        return status;
    struct render_options render = job_render(&o->job, &scene, integrator);
    struct trace trace = {.x = o->pixel[0], .y = o->pixel[1], .iteration = o->sample};
    struct trace_story story = {o->job.scene_path, &scene, integrator, o->job.seed, &trace};
    bool ok = tell(o, &render, &story, &trace, &err);
    trace_free(&trace);
    scene_free(&scene);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_trace = {
    "trace", "one sample of a pixel, told in full: sub-paths, choices, connections, weights",
    {"SCENE.pbrt --pixel X,Y [--sample K] [--json] [--svg FILE] [options]"}, OPTIONS, sizeof(struct trace_options),
    run, true,
    "trace scenes/bathroom.pbrt --pixel 150,120 --svg paths.svg"};
