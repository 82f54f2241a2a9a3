/* cmd_experiment.c: asbdpt experiment [--quick|--full] [SCENE...] -o DIR: the dissertation's measurements,
 * repeated. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/parallel.h"
#include "cli/command.h"
#include "lab/experiment.h"
#include "lab/report.h"

/* The five scenes measured when none is named; the program is run from the top of its tree. */
static const char *const SCENES[] = {"scenes/cornell-box.pbrt", "scenes/cornell-box-modified.pbrt",
                                     "scenes/veach-ajar.pbrt", "scenes/bathroom.pbrt", "scenes/living-room.pbrt"};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0] };

/* What the arguments say; 0 and NULL: what the preset says. */
struct arguments {
    bool full, quiet;
    const char **scene; /* [n_scenes], owned array of borrowed strings */
    int n_scenes;
    const char *directory, *reference;
    long spp, reference_spp, seeds, max_depth, threads;
    int width, height;
};

static bool resolution_of(const char *text, struct arguments *a)
{
    int n = 0;
    bool both = sscanf(text, "%dx%d%n", &a->width, &a->height, &n) == 2 && text[n] == '\0';
    bool width = !both && (a->height = 0, sscanf(text, "%d%n", &a->width, &n) == 1) && text[n] == '\0';
    if ((both || width) && a->width >= 1 && a->width <= 8192 && a->height >= (both ? 1 : 0) && a->height <= 8192)
        return true;
    return usage_error("--res %s: expected WIDTHxHEIGHT or WIDTH, each from 1 to 8192", text) == EXIT_OK;
}

/* An option that has a value. */
static bool option_with_value(const char *name, const char *value, struct arguments *a)
{
    if (strcmp(name, "-o") == 0)
        a->directory = value;
    else if (strcmp(name, "--reference") == 0)
        a->reference = value;
    else if (strcmp(name, "--res") == 0)
        return resolution_of(value, a);
    else if (strcmp(name, "--spp") == 0)
        return integer_option(name, value, 1, 1L << 20, &a->spp);
    else if (strcmp(name, "--reference-spp") == 0)
        return integer_option(name, value, 4, 1L << 24, &a->reference_spp);
    else if (strcmp(name, "--seeds") == 0)
        return integer_option(name, value, 1, PLAN_MAX_SEEDS, &a->seeds);
    else if (strcmp(name, "--maxdepth") == 0)
        return integer_option(name, value, 1, PATH_MAX_DEPTH, &a->max_depth);
    else if (strcmp(name, "--nthreads") == 0 || strcmp(name, "-j") == 0)
        return integer_option(name, value, 1, 1024, &a->threads);
    else
        return usage_error("unknown option %s", name) == EXIT_OK;
    return true;
}

static bool parse(int argc, char **argv, struct arguments *a)
{
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i];
        if (strcmp(name, "--quick") == 0 || strcmp(name, "--full") == 0)
            a->full = strcmp(name, "--full") == 0;
        else if (strcmp(name, "--quiet") == 0)
            a->quiet = true;
        else if (name[0] != '-')
            a->scene[a->n_scenes++] = name;
        else if (strncmp(name, "-j", 2) == 0 && name[2] != '\0') {
            if (!integer_option("-j", name + 2, 1, 1024, &a->threads))
                return false;
        } else if (i + 1 >= argc)
            return usage_error("%s is unknown or needs a value", name) == EXIT_OK;
        else if (!option_with_value(name, argv[++i], a))
            return false;
    }
    if (a->directory == NULL)
        return usage_error("experiment needs a directory for its results: -o DIR") == EXIT_OK;
    return true;
}

/* From arguments to a plan. The steps of the samples stay doublings of the preset's first, up to --spp. */
static bool make_plan(const struct arguments *a, struct plan *p)
{
    struct error err;
    memset(p, 0, sizeof *p);
    plan_preset(p, !a->full);
    p->scene = a->scene;
    p->n_scenes = a->n_scenes;
    p->directory = a->directory;
    p->reference = a->reference;
    p->quiet = a->quiet;
    p->max_depth = (int)a->max_depth;
    p->n_threads = a->threads > 0 ? (int)a->threads : parallel_cores();
    if (a->width > 0) {
        p->width = a->width;
        p->height = a->height;
    }
    if (a->seeds > 0)
        p->n_seeds = (int)a->seeds;
    if (a->reference_spp > 0)
        p->reference_spp = a->reference_spp;
    if (a->spp > 0 && !plan_set_spp(p, a->spp < p->spp[0] ? a->spp : p->spp[0], a->spp, &err))
        return usage_error("--spp %ld: %s", a->spp, err.text) == EXIT_OK;
    return true;
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

int command_experiment(int argc, char **argv)
{
    struct arguments a = {0};
    struct plan plan;
    a.scene = mem_alloc((size_t)(argc + N_SCENES), sizeof *a.scene);
    int status = parse(argc, argv, &a) ? EXIT_OK : EXIT_USAGE;
    if (a.n_scenes == 0) {
        memcpy(a.scene, SCENES, sizeof SCENES);
        a.n_scenes = N_SCENES;
    }
    if (status == EXIT_OK && !make_plan(&a, &plan))
        status = EXIT_USAGE;
    if (status == EXIT_OK)
        status = carry_out(&plan);
    free(a.scene);
    return status;
}
