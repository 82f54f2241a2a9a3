/* command.h: the subcommands of the command line.
 *
 * Each reads its own arguments (argv[0] is the subcommand's name) and returns the program's exit status: 0 success,
 * 1 failure of the job, 2 wrong usage. Messages go to stderr through the helpers here.
 *
 * Used by: main.
 */
#ifndef ASBDPT_COMMAND_H
#define ASBDPT_COMMAND_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "render/render.h"
#include "scene/scene.h"

enum { EXIT_OK = 0, EXIT_JOB = 1, EXIT_USAGE = 2 };

int command_render(int argc, char **argv);
int command_compare(int argc, char **argv);
int command_verify(int argc, char **argv);
int command_info(int argc, char **argv);
int command_experiment(int argc, char **argv);
int command_bench(int argc, char **argv);

/* fail / usage_error: print "asbdpt: message" and return EXIT_JOB / EXIT_USAGE. */
int fail(const struct error *err);
int usage_error(const char *format, ...);

/* integer_option: the whole number that `text`, the value of `option`, is; a usage error outside [low, high]. */
bool integer_option(const char *option, const char *text, long low, long high, long *out);

/* size_option: "WIDTHxHEIGHT" or "WIDTH", each from 1 to `high`. Returns how many numbers there are; 0: it is neither.
 * *height is left alone where it is not given. */
int size_option(const char *text, int high, int *width, int *height);

/* The options that render, trace and info share. */
struct job_options {
    const char *scene_path;
    const char **output; /* [n_outputs], owned array of borrowed strings */
    int n_outputs;
    const char *integrator;    /* NULL: the scene's */
    struct settings overrides; /* -P */
    long spp;                  /* 0: the scene's */
    int max_depth;             /* 0: the scene's */
    int width, height;         /* 0: the scene's */
    const char *filter;        /* NULL: the scene's */
    bool has_crop;
    double crop[4];
    int n_threads;
    uint64_t seed;
    const char *strategies; /* directory or NULL */
    bool quiet;
};

/* job_options_parse: read the arguments after the subcommand. Returns EXIT_OK, or EXIT_USAGE after printing why. */
int job_options_parse(int argc, char **argv, struct job_options *out);
void job_options_free(struct job_options *o);

/* job_load: parse the scene, apply the overrides, prepare it, and find the method. Returns EXIT_OK, or EXIT_JOB after
 * printing why (then nothing needs release). */
int job_load(const struct job_options *o, struct scene *scene, const struct method **method);

/* job_spp: samples per pixel in force: option, scene, else 16. */
long job_spp(const struct job_options *o, const struct scene *scene);

#endif
