/* render_files.h: what asbdpt render writes besides its image: first-hit images, lights, statistics.
 * Tests: test/cli.sh, test/outputs.sh. */
#ifndef ASBDPT_RENDER_FILES_H
#define ASBDPT_RENDER_FILES_H

#include "cli/job_options.h"
#include "cli/outputs.h"
#include "render/aov.h"

/* --aov: next to NAME.png are NAME.albedo.pfm, NAME.normal.pfm, ..., or NAME.exr has them as layers, with the channels
 * albedo.R, .G, .B, normal.X, .Y, .Z, depth.Z and so on, as compositors name them. */
struct aov_files {
    bool wanted[N_AOVS];
    bool layers;
    struct outputs out;     /* of each that is wanted, in this order; as layers: the .exr once more */
    float *picture[N_AOVS]; /* owned, NULL before aov_write */
};

/* aov_read: names of aov_name with commas between them; NULL: none. False with a message. */
bool aov_read(const char *list, struct aov_files *out, struct error *err);

/* aov_open: begin to write them next to the first of the images; as layers: is one of these an .exr? False with a
 * message.
 *   pictures  those of the command */
bool aov_open(struct aov_files *f, bool layers, const struct outputs *pictures, struct error *err);

/* aov_write: make them when all pictures are written, which may be later overtaken by a signal, and write them.
 *   options, film  of the render that is done, and its progress; for the variance the film must have kept errors
 *   seen           see aov.h
 *   pixels         the picture
 * False with a message. */
bool aov_write(struct aov_files *f, const struct scene *scene, const struct render_options *options,
               const struct film *film, bool seen, const float *pixels, bool quiet, struct error *err);

/* lights_open: make the directory of --lights, NULL: nothing is done, and begin to write a picture of each group of
 * lights (scene/light.h) of a film that keeps them. False with a message. */
bool lights_open(const char *directory, const struct scene *scene, struct outputs *out, struct error *err);

/* How long a render took, and how many samples per pixel in that time. */
struct render_times {
    double load, wall, cpu; /* seconds */
    double samples;
};

/* render_us_per_path: microseconds of CPU per sample of a pixel; 0 if there was none. */
double render_us_per_path(const struct film *film, const struct render_times *times);

/* stats_write: what a render was of and how it went, as one object of JSON for programs.
 *   pictures, features  all files that are about to be written */
void stats_write(FILE *f, const struct job_options *o, const struct scene *scene, const struct render_options *render,
                 const struct film *film, const struct outputs *pictures, const struct outputs *features,
                 const struct render_times *times);

#endif
