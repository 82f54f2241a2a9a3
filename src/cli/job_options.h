/* job_options.h: the options that the subcommands which load a scene share, and the loading. */
#ifndef ASBDPT_JOB_OPTIONS_H
#define ASBDPT_JOB_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

#include "cli/options.h"
#include "cli/outputs.h"
#include "render/job.h"
#include "scene/scene.h"

/* How a render is stopped, saved and resumed. */
struct keep_options {
    double time;             /* seconds; 0: no limit */
    double noise[N_NOISE_SCALES]; /* 0: no limit */
    const char *checkpoint;  /* file or NULL */
    double interval;         /* seconds between checkpoints */
    const char *resume;      /* file or NULL */
    double preview;          /* most seconds between previews; 0: none */
    int samples[2];          /* of each pixel, the second excluded; 0, 0: all */
};

/* keep_asks_noise: is there a limit of noise? */
static inline bool keep_asks_noise(const struct keep_options *o)
{
    return o->noise[NOISE_RELATIVE] > 0 || o->noise[NOISE_8_BIT] > 0;
}

/* A subcommand with options of its own has this as the first member of its struct: offsets count from there. */
struct job_options {
    const char *scene_path;
    const char *integrator; /* NULL: the scene's */
    struct texts overrides; /* NAME=VALUE of -P */
    int spp;                /* 0: the scene's */
    int max_depth;          /* 0: the scene's */
    int res[2];             /* width, height; 0: the scene's */
    const char *filter;     /* NULL: the scene's */
    double crop[4];         /* x0, x1, y0, y1; x1 = 0: the scene's */
    int n_threads;
    uint64_t seed;
    double max_memory;      /* GB; 0: what is usual (budget_new) */
    bool quick;             /* a quarter of the width and height, one sample, unless options say otherwise */
    bool strict, quiet;
    struct texts output; /* of render and worth */
    /* Of render alone: */
    const char *stats;      /* file or NULL */
    struct tone_options tone;
    struct keep_options keep;
};
/* Of render; RUN_OPTIONS, for what takes samples; JOB_OPTIONS, for all: each leads on to the next. */
extern const struct option RENDER_OPTIONS[], RUN_OPTIONS[], JOB_OPTIONS[];

/* job_load: parse the scene, apply the options, settle the job, whose samples are those of --spp, --quick or the scene,
 * else 16, in whole cycles of the filter (filter.h), and prepare the scene. Returns EXIT_OK, after which job_free and
 * scene_free must follow, or EXIT_JOB or EXIT_USAGE after printing why. */
int job_load(const struct job_options *o, struct scene *scene, struct job *job);

/* The same in two steps: job_open parses the scene, applies the options and finds the method; job_ready does the rest,
 * and releases the scene if it fails.
 *   readers  all methods that will read the settings, ended by NULL; the job is the first one's */
struct job_loading {
    const struct job_options *options;
    long n_warnings; /* so far */
};
int job_open(struct job_loading *l, struct scene *scene, const struct method **method);
int job_ready(struct job_loading *l, const struct method *const *readers, struct scene *scene, struct job *job);

/* job_spares: is none of these outputs a file that the scene was read from? False with a message. */
bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err);

#endif
