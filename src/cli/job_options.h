/* job_options.h: the options that the subcommands which load a scene share. */
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
    bool unclamped;
    struct keep_options keep;
};
/* Of render; RUN_OPTIONS, for what takes samples; JOB_OPTIONS, for all: each leads on to the next. */
extern const struct option RENDER_OPTIONS[], RUN_OPTIONS[], JOB_OPTIONS[];

/* load_job: job_load (render/job.h) of what the options ask. Returns EXIT_OK, or another status after saying why.
 * job_request: what that is; borrows their texts. job_failed: say why it has failed, unless that has been said; returns
 * the exit status. */
int load_job(const struct job_options *o, struct scene *scene, struct job *job);
struct job_request job_request(const struct job_options *o);
int job_failed(const struct error *err);

/* job_spares: is none of these outputs a file that the scene was read from? False with a message. */
bool job_spares(const struct scene *scene, const struct texts *outputs, struct error *err);

#endif
