/* cmd_experiment.c: asbdpt experiment: the dissertation's measurements, repeated; and integrators given equal time. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "base/parallel.h"
#include "lab/commands.h"
#include "lab/equal_run.h"
#include "lab/experiment.h"
#include "lab/report.h"
#include "transport/path.h"

/* The scenes measured when none is named, the first five of them unless times are equal; the program is run from the
 * top of its tree. */
static const char *const SCENES[] = {
    "scenes/cornell-box.pbrt", "scenes/cornell-box-modified.pbrt", "scenes/veach-ajar.pbrt", "scenes/bathroom.pbrt",
    "scenes/living-room.pbrt", "scenes/caustic-glass.pbrt",        "scenes/sky.pbrt",        "scenes/spot.pbrt",
    "scenes/corridor.pbrt",    "scenes/many-lights.pbrt",          "scenes/forest.pbrt"};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0], N_PUBLISHED = 5 };
enum { EQUAL_SPP = 32, EQUAL_SEEDS = 5 }; /* unless said otherwise */

/* What the options say; 0 and NULL: what the preset says. */
struct experiment_options {
    struct texts scenes;
    const char *directory, *reference;
    bool quick, full, equal_time, quiet;
    double seconds; /* 0: as bdpt takes */
    int spp, reference_spp, seeds, max_depth, n_threads, res[2];
};

#define AT(member) offsetof(struct experiment_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXTS, AT(scenes),
     .help = "scene files (default: five of scenes/, with --equal-time all)"},
    {"-o", "DIR", OPTION_TEXT, AT(directory), 1,
     .help = "a directory for its results; started again with the same, it goes on (--equal-time: anew)"},
    {"--quick", NULL, OPTION_ON, AT(quick), .help = "at the sizes of the references, 8 to 64 spp (default)"},
    {"--full", NULL, OPTION_ON, AT(full), .help = "320 pixels wide, 32 to 512 spp, and all parameter sweeps"},
    {"--equal-time", NULL, OPTION_ON, AT(equal_time),
     .help = "give each the CPU time of bdpt's --spp 32, or --time; at the references' sizes"},
    {"--time", "TIME", OPTION_NUMBER, AT(seconds), 0.001, 1e6, .with = "--equal-time", .help = "of CPU for each"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .help = "most samples per pixel"},
    {"--seeds", "N", OPTION_INTEGER, AT(seeds), 1, PLAN_MAX_SEEDS,
     .help = "renders per method (default 3, --equal-time: 5)"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(max_depth), 1, PATH_MAX_DEPTH, .help = "longest path, 1 = direct light"},
    {"--nthreads", "N", OPTION_INTEGER, AT(n_threads), 1, 1024, .alias = "-j", .help = "threads (default: all)"},
    {"--res", "WIDTH[xHEIGHT]", OPTION_INTEGER, AT(res), 1, 8192, .help = "size, or width alone"},
    {"--reference", "PATH", OPTION_TEXT, AT(reference),
     .help = "picture, or directory of NAME.pfm (default: ref/ beside the scene if of it, else rendered)"},
    {"--reference-spp", "N", OPTION_INTEGER, AT(reference_spp), 4, 1 << 24, .help = "samples of one rendered here"},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "no progress, no warnings"},
    {.name = NULL},
};

/* One step, and sizes left to the references, where nothing else is said. */
static void make_equal(const struct experiment_options *o, struct plan *p)
{
    plan_set_spp(p, o->spp > 0 ? o->spp : EQUAL_SPP, o->spp > 0 ? o->spp : EQUAL_SPP, NULL);
    p->width = o->res[0];
    p->n_seeds = o->seeds > 0 ? o->seeds : EQUAL_SEEDS;
    p->n_threads = 1;
}

/* The steps of the samples stay doublings of the preset's first, up to --spp. */
static bool make_plan(const struct experiment_options *o, struct plan *p, struct error *err)
{
    memset(p, 0, sizeof *p);
    plan_preset(p, !o->full);
    p->scene = o->scenes.item;
    p->n_scenes = o->scenes.n;
    p->directory = o->directory;
    p->reference = o->reference;
    p->quiet = o->quiet;
    p->max_depth = o->max_depth;
    p->n_threads = o->n_threads;
    if (o->res[0] > 0) {
        p->width = o->res[0];
        p->height = o->res[1];
    }
    if (o->seeds > 0)
        p->n_seeds = o->seeds;
    if (o->reference_spp > 0)
        p->reference_spp = o->reference_spp;
    if (o->equal_time)
        make_equal(o, p);
    return o->spp == 0 || plan_set_spp(p, o->spp < p->spp[0] ? o->spp : p->spp[0], o->spp, err);
}

static int carry_out(const struct plan *plan)
{
    struct error err;
    struct results results = {0};
    bool ok = experiment_run(plan, &results, &err) && report_write(&results, &err);
    if (ok && !plan->quiet)
        printf("%s/report.html\n", plan->directory);
    results_free(&results);
    return ok ? EXIT_OK : fail(&err);
}

static int give_equal_time(const struct plan *plan, double seconds)
{
    struct error err;
    struct equal_time results = {.plan = plan, .seconds = seconds};
    bool ok = equal_run(&results, &err);
    if (ok)
        equal_table(stdout, &results);
    equal_free(&results);
    return ok ? EXIT_OK : fail(&err);
}

static int run(void *options)
{
    struct experiment_options *o = options;
    struct plan plan;
    struct error err;
    bool named = o->scenes.n > 0, equal = o->equal_time;
    for (int i = 0; !named && i < (equal ? N_SCENES : N_PUBLISHED); i++)
        texts_add(&o->scenes, SCENES[i]);
    if (!make_plan(o, &plan, &err))
        return usage_error(&command_experiment, "--spp %d: %s", o->spp, err.text);
    if (o->quick && o->full)
        return usage_error(&command_experiment, "--quick and --full exclude each other");
    if (equal && o->n_threads > 1)
        return usage_error(&command_experiment, "--nthreads %d: equal times are those of one thread", o->n_threads);
    return equal ? give_equal_time(&plan, o->seconds) : carry_out(&plan);
}

const struct command command_experiment = {
    "experiment",
    "measure methods as the dissertation does",
    {"[--quick | --full] [SCENE.pbrt...] -o DIR [options]", "--equal-time [SCENE.pbrt...] -o DIR [options]"},
    OPTIONS,
    sizeof(struct experiment_options),
    run,
    true,
    "experiment --equal-time scenes/spot.pbrt -o out/equal"};
