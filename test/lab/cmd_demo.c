/* cmd_demo.c: asbdpt-lab demo: methods at equal time in one labelled picture. See demo.h. */
#include <stdio.h>

#include "cli/outputs.h"
#include "lab/commands.h"
#include "lab/demo.h"

struct demo_options {
    struct demo demo;
    struct texts output;
    const char *methods;
    int spp;
    bool quiet;
};

#define AT(member) offsetof(struct demo_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(demo.scene), 1, .file = FILE_READ, .help = "a scene"},
    {"--outfile", "FILE.png", OPTION_TEXTS, AT(output), 1, .alias = "-o", .file = FILE_WRITTEN,
     .help = "a picture to write"},
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .fallback = METHODS_DEMO, .help = METHODS_HELP},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .fallback = "24",
     .help = "samples per pixel of the first; the others are given the same time"},
    {"--scale", "K", OPTION_INTEGER, AT(demo.scale), 1, 64, .fallback = "1",
     .help = "the pictures are K times as wide and high as the reference"},
    {"--reference", "PATH", OPTION_TEXT, AT(demo.reference),
     .file = FILE_READ, .help = "picture, or directory of NAME.pfm (default: ref/ beside the scene, else rendered)"},
    {"--nthreads", "N", OPTION_INTEGER, AT(demo.n_threads), 1, 1024, .alias = "-j", .help = "threads (default: all)"},
    {"--seed", "N", OPTION_SEED, AT(demo.seed), .fallback = "0", .help = "another set of random numbers"},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "no messages"},
    {.name = NULL},
};

static int run(void *options)
{
    struct demo_options *o = options;
    struct equal_render took[METHODS_MAX];
    struct error err;
    struct outputs out;
    struct sheet picture = {0};
    o->demo.spp = o->spp;
    if (!methods_read(o->methods, &o->demo.methods, &err))
        return usage_error(&command_demo, "--methods: %s", err.text);
    if (!outputs_open(&o->output, NULL, PARTS_NONE, &out, &err))
        return fail(&err);
    bool ok = demo_run(&o->demo, took, &picture, &err) &&
              outputs_write(&out, picture.width, picture.height, picture.pixels, o->quiet, &err);
    outputs_abandon(&out); /* unless they are written */
    sheet_free(&picture);
    for (int i = 0; ok && i < o->demo.methods.n; i++)
        printf("%-8s %6ld spp %8.2f s of CPU   rmse8 %.3f   of 8x8 pixels %.3f\n", o->demo.methods.item[i].text,
               took[i].spp, took[i].seconds, took[i].rmse8, took[i].shown_blocks);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_demo = {
    "demo", "methods at equal time, in one labelled picture", {"SCENE.pbrt -o FILE.png [options]"}, OPTIONS,
    sizeof(struct demo_options), run, true, "demo scenes/bathroom.pbrt --scale 5 -o out/demo.png"};
