/* cmd_worth.c: asbdpt-lab worth SCENE: what light vertices are worth to one surface point, as a picture. See
 * worth.h. */
#include <string.h>

#include "lab/commands.h"
#include "library/job_options.h"
#include "cli/outputs.h"
#include "lab/worth.h"

struct worth_options {
    struct render_job job;
    struct texts output;
    int pixel[2], scale;
};

#define AT(member) offsetof(struct worth_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .help = "a scene file"},
    {"-o", "FILE.png", OPTION_TEXTS, AT(output), 1, .alias = "--outfile", .written = true,
     .help = "a picture to write"},
    {"--pixel", "X,Y", OPTION_PIXEL, AT(pixel), 0, 65535, .fallback = "0,0", .help = "where the surface is seen"},
    {"--scale", "K", OPTION_INTEGER, AT(scale), 1, 16,
     .help = "a pixel becomes KxK (default: until each picture is 320 pixels wide)"},
    {.others = RUN_OPTIONS},
};

static int run(void *options)
{
    struct worth_options *o = options;
    struct scene scene;
    struct prepared prepared;
    struct outputs out;
    struct sheet picture = {0};
    struct error err;
    if (o->job.integrator_name == NULL)
        o->job.integrator_name = "asbdpt";
    if (o->job.crop[1] > 0)
        return usage_error(&command_worth, "--cropwindow has no place here: the whole film is shown");
    if (!outputs_open(&o->output, NULL, false, &out, &err))
        return fail(&err);
    int status = load_job(&o->job, &scene, &prepared);
    if (status == EXIT_OK) {
        bool ok = job_spares(&scene, &o->output, &err) &&
                  worth_picture(&scene, &o->job, o->pixel[0], o->pixel[1], o->scale, &picture, &err) &&
                  outputs_write(&out, picture.width, picture.height, picture.pixels, o->job.quiet, &err);
        sheet_free(&picture);
        method_release(&prepared);
        scene_free(&scene);
        status = ok ? EXIT_OK : fail(&err);
    }
    outputs_abandon(&out); /* unless they are written */
    return status;
}

const struct command command_worth = {
    "worth", "what light vertices are worth to a surface point, as a picture",
    {"SCENE.pbrt --pixel X,Y -o FILE.png [options]"}, OPTIONS, sizeof(struct worth_options), run, false,
    "worth scenes/veach-ajar.pbrt --pixel 80,67 --res 160x90 --spp 64 -o out/worth.png"};
