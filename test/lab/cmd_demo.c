/* cmd_demo.c: asbdpt demo: two integrators at equal time in one labelled picture. See demo.h. */
#include <stdio.h>

#include "lab/commands.h"
#include "cli/job_options.h"
#include "cli/outputs.h"
#include "lab/demo.h"

struct demo_options {
    struct demo demo;
    struct texts output;
    const char *first, *second; /* integrators */
    int spp;
};

#define AT(member) offsetof(struct demo_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(demo.scene), 1, .file = FILE_READ, .help = "a scene with a stored reference"},
    {"-o", "FILE.png", OPTION_TEXTS, AT(output), 1, .alias = "--outfile", .file = FILE_WRITTEN,
     .help = "a picture to write"},
    {"--integrator", "NAME", OPTION_TEXT, AT(second), .fallback = "asbdpt", .help = "what is compared"},
    {"--with", "NAME", OPTION_TEXT, AT(first), .fallback = "bdpt", .help = "what it is compared with"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .fallback = "24",
     .help = "samples per pixel of the latter; the other is given the same time"},
    {"--scale", "K", OPTION_INTEGER, AT(demo.scale), 1, 64, .fallback = "1",
     .help = "the pictures are K times as wide and high as the reference"},
    {"--reference", "PATH", OPTION_TEXT, AT(demo.reference),
     .file = FILE_READ, .help = "picture, or directory of NAME.pfm (default: ref/ beside the scene)"},
    {"--nthreads", "N", OPTION_INTEGER, AT(demo.n_threads), 1, 1024, .alias = "-j", .help = "threads (default: all)"},
    {"--seed", "N", OPTION_SEED, AT(demo.seed), .fallback = "0", .help = "another set of random numbers"},
    {"--quiet", NULL, OPTION_ON, AT(demo.quiet), .help = "no progress"},
    {.name = NULL},
};

static bool find_integrators(struct demo_options *o, struct error *err)
{
    const char *const names[DEMO_SIDES] = {o->first, o->second};
    for (int i = 0; i < DEMO_SIDES; i++) {
        o->demo.integrator[i] = names[i];
        if (!method_exists(names[i])) {
            struct error known;
            integrator_unknown(names[i], &known);
            return error_set(err, "there is no integrator %s; %s", names[i], known.text);
        }
    }
    return true;
}

static int run(void *options)
{
    struct demo_options *o = options;
    struct demo_side side[DEMO_SIDES];
    struct error err;
    struct outputs out;
    struct sheet picture;
    o->demo.spp = o->spp;
    if (!find_integrators(o, &err) || !outputs_open(&o->output, NULL, PARTS_NONE, &out, &err))
        return fail(&err);
    if (!demo_run(&o->demo, side, &picture, &err)) {
        outputs_abandon(&out);
        return fail(&err);
    }
    bool ok = outputs_write(&out, picture.width, picture.height, picture.pixels, o->demo.quiet, &err);
    sheet_free(&picture);
    if (!ok)
        return fail(&err);
    for (int i = 0; i < DEMO_SIDES; i++)
        printf("%-8s %6ld spp %8.2f s of CPU   rmse8 %.3f\n", o->demo.integrator[i], side[i].spp,
               side[i].seconds, side[i].rmse8);
    return EXIT_OK;
}

const struct command command_demo = {
    "demo", "two integrators at equal time, in one labelled picture", {"SCENE.pbrt -o FILE.png [options]"}, OPTIONS,
    sizeof(struct demo_options), run, true,
    "demo scenes/bathroom.pbrt --scale 5 -o out/demo.png"};
