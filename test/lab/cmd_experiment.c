/* cmd_experiment.c: asbdpt-lab experiment: the dissertation's measurements, repeated; and asbdpt-lab equal-time:
 * methods given the same time; and asbdpt-lab family: all of them. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "base/parallel.h"
#include "lab/commands.h"
#include "lab/equal.h"
#include "lab/family.h"
#include "lab/measure.h"
#include "lab/report.h"
#include "lab/text.h"

/* The scenes measured when none is named, the first five of them by `experiment`; the program is run from the top of
 * its tree. */
static const char *const SCENES[] = {
    "scenes/cornell-box.pbrt", "scenes/cornell-box-modified.pbrt", "scenes/veach-ajar.pbrt", "scenes/bathroom.pbrt",
    "scenes/living-room.pbrt", "scenes/caustic-glass.pbrt",        "scenes/sky.pbrt",        "scenes/spot.pbrt",
    "scenes/corridor.pbrt",    "scenes/many-lights.pbrt",          "scenes/forest.pbrt"};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0], N_PUBLISHED = 5, COMMAND = 4096 };

/* What the options say; 0 and NULL: what the preset says. */
struct plan_options {
    struct plan plan;
    struct texts scenes, sweeps;
    const char *methods, *half;
    bool quick, full;
    int spp, res[2];
};

/* What a command measures unless the options say otherwise. */
struct preset {
    const char *name;
    int spp, seeds, width; /* width 0: see plan_scene_load */
    int reference_spp;     /* 0: as many as the first method has of all seeds */
};

/* --- options ----------------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct plan_options, member)
static const struct option SHARED[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXTS, AT(scenes),
     .help = "scene files (default: eleven of scenes/, of which experiment measures five)"},
    {"-o", "DIR", OPTION_TEXT, AT(plan.directory), 1,
     .help = "a directory for its results, of which report.html is the one to open; started again with the same, it "
             "goes on"},
    {"--seeds", "N", OPTION_INTEGER, AT(plan.n_seeds), 1, PLAN_MAX_SEEDS,
     .help = "renders per method (default: 3; equal-time, family: 5, of which 1 and 2 need a stored reference)"},
    {"--seed", "N", OPTION_SEED, AT(plan.seed), .help = "choose another set of random numbers (default: 0)"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(plan.max_depth), 1, PATH_MAX_DEPTH,
     .help = "longest path, 1 = direct light"},
    {"--res", "WIDTH[xHEIGHT]", OPTION_WIDTH, AT(res), 1, 8192,
     .help = "size, or width alone (default: 160 pixels wide; 96, or as a larger stored reference, if there is one)"},
    {"--reference", "PATH", OPTION_TEXT, AT(plan.reference),
     .help = "picture, or directory of NAME.pfm (default: ref/ next to the scene if of it, else rendered)"},
    {"--reference-spp", "N", OPTION_INTEGER, AT(plan.reference_spp), 4, 1 << 24,
     .help = "samples of one rendered here (default: at equal time as many as the first method's, of all seeds; "
             "four times that where perhaps no method finds all light)"},
    {"--nthreads", "N", OPTION_INTEGER, AT(plan.n_threads), 1, 1024, .alias = "-j", .help = "threads (default: all)"},
    {"--quiet", NULL, OPTION_ON, AT(plan.quiet), .help = "no progress, no warnings"},
    {.name = NULL},
};

static const struct option EXPERIMENT[] = {
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .help = METHODS_HELP " (default: " METHODS_EXPERIMENT ")"},
    {"--sweep", "LIST", OPTION_TEXTS, AT(sweeps),
     .help = "such a list, rendered with one seed (default: two, unless there are --methods)"},
    {"--quick", NULL, OPTION_ON, AT(quick), .help = "96 pixels wide, or as the reference, 8 to 64 spp (default)"},
    {"--full", NULL, OPTION_ON, AT(full), .help = "320 pixels wide, 32 to 512 spp, and longer sweeps"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .help = "most samples per pixel"},
    {.others = SHARED},
};

static const struct option EQUAL_TIME[] = {
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .help = METHODS_HELP " (default: " METHODS_OWN_SCENE
     "; of eleven scenes more)"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20,
     .help = "samples per pixel of the first method (default: 32); the others are given its CPU time"},
    {"--seconds", "T", OPTION_NUMBER, AT(plan.seconds), 0.001, 1e6, .help = "instead: the CPU time that all are given"},
    {.others = SHARED},
};

static const struct option FAMILY[] = {
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .help = METHODS_HELP " (default: all there are)"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20,
     .help = "samples per pixel of the first method (default: 64; --quick: 16); the others are given its CPU time"},
    {"--half", "HALF", OPTION_TEXT, AT(half), .fallback = "both",
     .help = "choice: all services off; services: each method with all it can have; or both"},
    {"--quick", NULL, OPTION_ON, AT(quick), .help = "3 seeds, 96 pixels wide, not 160"},
    {.others = SHARED},
};

/* --- the plan ---------------------------------------------------------------------------------------- */

/* What is 0 becomes the preset's. */
static void choose(int *value, int otherwise) { *value = *value > 0 ? *value : otherwise; }

/* What all commands have in common. `command` becomes the command that carries the plan out again. */
static bool begin_plan(struct plan_options *o, const struct preset *preset, int n_scenes, char command[COMMAND],
                       struct error *err)
{
    struct plan *p = &o->plan;
    for (int i = 0; o->scenes.n < n_scenes && (i > 0 || o->scenes.n == 0); i++)
        texts_add(&o->scenes, SCENES[i]);
    choose(&o->spp, preset->spp);
    choose(&p->n_seeds, preset->seeds);
    choose(&o->res[0], preset->width);
    choose(&p->reference_spp, preset->reference_spp > 0 ? preset->reference_spp : o->spp * p->n_seeds);
    p->scene = o->scenes.item;
    p->n_scenes = o->scenes.n;
    p->width = o->res[0];
    p->height = o->res[1];
    p->command = command;
    snprintf(command, COMMAND, p->seconds > 0 ? "%s --seconds %g" : "%s --spp %.0f", preset->name,
             p->seconds > 0 ? p->seconds : o->spp);
    bool fits = text_add(command, COMMAND, " --methods %s --seeds %d --reference-spp %d", o->methods, p->n_seeds,
                         p->reference_spp);
    if (p->seed != 0)
        fits &= text_add(command, COMMAND, " --seed %" PRIu64, p->seed);
    if (p->width > 0)
        fits &= text_add(command, COMMAND, p->height > 0 ? " --res %dx%d" : " --res %d", p->width, p->height);
    if (p->max_depth > 0)
        fits &= text_add(command, COMMAND, " --maxdepth %d", p->max_depth);
    if (p->reference != NULL)
        fits &= text_add(command, COMMAND, " --reference %s", p->reference);
    for (int i = 0; i < o->sweeps.n; i++)
        fits &= text_add(command, COMMAND, " --sweep %s", o->sweeps.item[i]);
    if (!plan_set_methods(p, o->methods, err))
        return false;
    return fits || error_usage(err, "these options are longer than a report can repeat, %d characters", COMMAND - 1);
}

/* The steps of the samples are doublings of the preset's first, up to --spp. */
static bool plan_experiment(struct plan_options *o, char command[COMMAND], struct error *err)
{
    static const struct preset presets[2] = {{"experiment --quick", 64, 3, 0, 256},
                                             {"experiment --full", 512, 3, 320, 4096}};
    static const char *const sweeps[2][2] = {{SWEEPS_QUICK}, {SWEEPS_FULL}};
    int first = o->full ? 32 : 8;
    if (o->quick && o->full)
        return error_usage(err, "--quick and --full exclude each other");
    for (int i = 0, usual = o->methods == NULL && o->sweeps.n == 0; i < 2 && usual; i++)
        texts_add(&o->sweeps, sweeps[o->full][i]);
    if (o->methods == NULL)
        o->methods = METHODS_EXPERIMENT;
    bool ok = begin_plan(o, &presets[o->full], N_PUBLISHED, command, err) &&
              plan_set_spp(&o->plan, o->spp < first ? o->spp : first, o->spp, err);
    o->plan.no_roulette = true;
    for (int i = 0; ok && i < o->sweeps.n; i++)
        ok = plan_add_sweep(&o->plan, o->sweeps.item[i], err);
    return ok;
}

static bool plan_equal_time(struct plan_options *o, char command[COMMAND], struct error *err)
{
    static const struct preset preset = {"equal-time", 32, 5, 0, 0};
    if (o->methods == NULL) /* of one's own scene one asks which of the two to use */
        o->methods = o->scenes.n > 0 ? METHODS_OWN_SCENE : METHODS_EQUAL_TIME;
    o->plan.equal = true;
    return begin_plan(o, &preset, N_SCENES, command, err) && plan_set_spp(&o->plan, o->spp, o->spp, err);
}

static bool plan_family(struct plan_options *o, char command[COMMAND], struct error *err)
{
    static const struct preset presets[2] = {{"family", 64, 5, 160, 0}, {"family --quick", 16, 3, 0, 0}};
    char all[METHODS_TEXT];
    struct plan *p = &o->plan;
    p->equal = true;
    methods_all(all);
    strcat(all, METHODS_ALSO);
    o->methods = o->methods != NULL ? o->methods : all;
    unsigned halves = o->half[0] == 'c' ? 1 : o->half[0] == 's' ? 2 : 3;
    bool ok = begin_plan(o, &presets[o->quick], N_SCENES, command, err) && plan_set_spp(p, o->spp, o->spp, err) &&
              methods_add_halves(o->methods, halves, &p->methods, err);
    p->n_compared = p->methods.n;
    return ok;
}

/* --- the commands ------------------------------------------------------------------------------------ */

/* The answer first. */
static void equal_page(FILE *f, const struct results *r)
{
    equal_verdict(f, r);
    fputs("\n", f);
    family_tables(f, r);
}

static bool write_equal(const struct results *r, struct error *err)
{
    bool ok = family_write(r, "equal-time.md", equal_page, err);
    if (ok) {
        family_tables(stdout, r);
        printf("%s/report.html\n", r->plan->directory);
        equal_verdict(stdout, r);
    }
    return ok;
}

static bool write_family(const struct results *r, struct error *err)
{
    bool ok = family_write(r, "family.md", family_tables, err);
    if (ok && !r->plan->quiet)
        printf("%s/report.html\n", r->plan->directory);
    return ok;
}

static bool write_experiment(const struct results *r, struct error *err)
{
    bool ok = report_write(r, err);
    if (ok && !r->plan->quiet)
        printf("%s/report.html\n", r->plan->directory);
    return ok;
}

/* Plan, measure, write. */
static int run(struct plan_options *o, const struct command *c,
               bool (*make_plan)(struct plan_options *, char command[COMMAND], struct error *),
               bool (*write)(const struct results *, struct error *))
{
    struct results results = {0};
    struct error err;
    char command[COMMAND];
    if (!make_plan(o, command, &err))
        return usage_error(c, "%s", err.text);
    int n_scenes = o->plan.n_scenes;
    bool ok = measure(&o->plan, &results, &err) && write(&results, &err);
    results_free(&results);
    return !ok ? fail(&err) : o->plan.n_scenes == n_scenes ? EXIT_OK : EXIT_JOB;
}

static int run_experiment(void *o) { return run(o, &command_experiment, plan_experiment, write_experiment); }
static int run_equal_time(void *o) { return run(o, &command_equal_time, plan_equal_time, write_equal); }
static int run_family(void *o) { return run(o, &command_family, plan_family, write_family); }

const struct command command_experiment = {
    "experiment", "measure methods as the dissertation does", {"[SCENE.pbrt...] -o DIR [options]"}, EXPERIMENT,
    sizeof(struct plan_options), run_experiment, true, "experiment --quick -o out/experiment"};

const struct command command_equal_time = {
    "equal-time", "give methods the same CPU time", {"[SCENE.pbrt...] -o DIR [options]"}, EQUAL_TIME,
    sizeof(struct plan_options), run_equal_time, true, "equal-time scenes/spot.pbrt -o out/equal"};

const struct command command_family = {
    "family", "give all methods the same CPU time, in all scenes", {"[SCENE.pbrt...] -o DIR [options]"}, FAMILY,
    sizeof(struct plan_options), run_family, true, "family --quick scenes/spot.pbrt -o out/family"};
