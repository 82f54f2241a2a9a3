/* job_options.c: see job_options.h. */
#include "library/job_options.h"

#include <string.h>

#include "base/os.h"

#define AT(member) offsetof(struct render_job, member)
const struct option LIMIT_OPTIONS[] = {
    {"--noise", "X", OPTION_NUMBER, AT(noise[NOISE_RELATIVE]), 1e-9, 1e9,
     .help = "stop when the noise is below X relative to the local brightness, e.g. 0.05; checked every 64 samples"},
    {"--noise8", "X", OPTION_NUMBER, AT(noise[NOISE_8_BIT]), 1e-9, 1e9,
     .help = "stop when the noise is below X of the 255 levels of 8-bit images; with --noise, when both hold"},
    {"--samples", "FIRST:END", OPTION_RANGE, AT(samples), 0, 1 << 30,
     .help = "render only the samples FIRST to END-1 of each pixel, for merge: -o NAME.part"},
    {.others = RUN_OPTIONS},
};

const struct option RUN_OPTIONS[] = {
    {"--nthreads", "N", OPTION_INTEGER, AT(n_threads), 1, 1024, .alias = "-j",
     .help = "number of threads (default: one for each processor)"},
    {"--seed", "N", OPTION_SEED, AT(seed), .fallback = "0", .help = "choose another set of random numbers"},
    {.others = JOB_OPTIONS},
};

const struct option JOB_OPTIONS[] = {
    {"--integrator", "NAME", OPTION_TEXT, AT(integrator_name),
     .help = "rendering method, see asbdpt help integrators (default: the scene's, else bdpt)"},
    {"-P", "NAME=VALUE", OPTION_PAIRS, AT(overrides), .help = "set a parameter of the integrator; repeatable"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 30, .help = "samples per pixel (default: the scene's, else 16)"},
    {"--quick", NULL, OPTION_ON, AT(quick),
     .help = "a quarter of the width and height unless --res is given, one sample per pixel unless --spp is given"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(max_depth), 1, PATH_MAX_DEPTH,
     .help = "longest path, where 1 is direct light (default: the scene's, else 5)"},
    {"--res", "WIDTH[xHEIGHT]", OPTION_WIDTH, AT(res), 1, 65536,
     .help = "size of the film in pixels; a width alone keeps its shape (default: the scene's)"},
    {"--filter", "NAME", OPTION_WORD, AT(filter), .words = FILTER_NAMES,
     .help = "pixel filter in place of the scene's"},
    {"--cropwindow", "X0 X1 Y0 Y1", OPTION_WINDOW, AT(crop), 0, 1,
     .help = "render only this part of the film, in fractions from 0 to 1 (default: the scene's)"},
    {"--max-memory", "GB", OPTION_NUMBER, AT(max_memory), 1e-3, 1e9,
     .help = "gigabytes that the scene and its film may take (default: three quarters of the machine's memory)"},
    {"--strict", NULL, OPTION_ON, AT(strict), .help = "treat warnings about the scene as errors"},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "print errors and warnings alone"}, {.name = NULL}};

bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err)
{
    for (int i = 0; i < outputs->n; i++)
        for (int k = 0; k < scene->n_files; k++)
            if (strcmp(outputs->item[i], "-") != 0 && os_same_file(outputs->item[i], scene->file[k]))
                return error_usage(err, "%s: the scene is read from this file; an output needs another name",
                                   outputs->item[i]);
    return true;
}
