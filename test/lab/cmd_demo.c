/* cmd_demo.c: asbdpt-lab demo: methods at equal time in one labelled picture. See pictures.h. */
#include <stdio.h>

#include "cli/outputs.h"
#include "lab/commands.h"
#include "lab/measure.h"
#include "lab/pictures.h"

struct demo_options {
    struct plan plan;
    const char *scene;
    struct texts output;
    const char *methods;
    int spp;
};

enum { REFERENCE_TIMES = 32 }; /* as many samples as the first picture has */

#define AT(member) offsetof(struct demo_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(scene), 1, .written = true, .help = "a scene"},
    {"--outfile", "FILE.png", OPTION_TEXTS, AT(output), 1, .alias = "-o", .written = true,
     .help = "a picture to write"},
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .fallback = METHODS_DEMO, .help = METHODS_HELP},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .fallback = "24",
     .help = "samples per pixel of the first; the others are given the same time"},
    {"--res", "WIDTH", OPTION_INTEGER, AT(plan.width), 1, 8192,
     .help = "width in pixels (default: that of a stored reference, or 160)"},
    {"--reference", "PATH", OPTION_TEXT, AT(plan.reference),
     .help = "picture, or directory of NAME.pfm (default: ref/ next to the scene, else rendered)"},
    {"--nthreads", "N", OPTION_INTEGER, AT(plan.n_threads), 1, 1024, .alias = "-j", .help = "threads (default: all)"},
    {"--seed", "N", OPTION_SEED, AT(plan.seed), .fallback = "0", .help = "another set of random numbers"},
    {"--quiet", NULL, OPTION_ON, AT(plan.quiet), .help = "no messages"},
    {.name = NULL},
};

/* A line for each method. */
static void print(const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    for (int i = 0; i < r->plan->methods.n; i++) {
        const struct run *run = s->run[i][0];
        printf("%-8s %6ld spp %8.2f s of CPU   rmse8 %.3f   of 8x8 pixels %.3f\n", r->plan->methods.item[i].text,
               run->spp, run->value[Q_SECONDS], run->value[Q_RMSE8], pictures_blocks(s, i));
    }
}

static int run(void *options)
{
    struct demo_options *o = options;
    struct plan *p = &o->plan;
    struct results results = {0};
    struct error err;
    struct outputs out;
    struct sheet picture = {0};
    p->scene = &o->scene;
    p->n_scenes = p->n_seeds = 1;
    p->equal = true;
    p->reference_spp = REFERENCE_TIMES * o->spp;
    if (!plan_set_methods(p, o->methods, &err) || !plan_set_spp(p, o->spp, o->spp, &err))
        return usage_error(&command_demo, "--methods: %s", err.text);
    if (!outputs_open(&o->output, NULL, false, &out, &err))
        return fail(&err);
    bool ok = measure(p, &results, &err);
    if (ok) {
        picture = pictures_sheet(&results.scene[0]);
        ok = outputs_write(&out, picture.width, picture.height, picture.pixels, p->quiet, &err);
    }
    outputs_abandon(&out); /* unless they are written */
    sheet_free(&picture);
    if (ok)
        print(&results);
    results_free(&results);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_demo = {
    "demo", "methods at equal time, in one labelled picture", {"SCENE.pbrt -o FILE.png [options]"}, OPTIONS,
    sizeof(struct demo_options), run, true, "demo scenes/bathroom.pbrt --res 160 -o out/demo.png"};
