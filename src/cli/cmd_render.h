/* cmd_render.h: the steps of `asbdpt render`, which the laboratory's program takes, too, and looks on.
 * Tests: test/run/cli.sh, test/run/outputs.sh, test/run/checkpoint.sh. */
#ifndef ASBDPT_CMD_RENDER_H
#define ASBDPT_CMD_RENDER_H

#include <stdio.h>

#include "library/job_options.h"
#include "cli/checkpoint.h"
#include "cli/outputs.h"

/* A render on its way from options to files. */
struct render_run {
    struct asbdpt of;       /* the options that all renders have, and what becomes of them */
    struct texts output;
    struct tone_options tone;
    bool unclamped;
    const char *stats_path; /* or NULL */
    struct checkpoint checkpoint; /* options that stop, save and resume, and what becomes of them */
    struct outputs pictures;
    struct file_output stats; /* its stream NULL: none; it is complete when all others are */
};

extern const struct option RENDER_OPTIONS[]; /* of a struct that begins with render_run */

/* render_open: load the scene, open all files that are to be written, and begin a film. Returns EXIT_OK, or another
 * status after saying why (then nothing needs release).
 * render_work: render, and write all files but --stats. False with a message.
 * render_close: write --stats if all is well so far, else say what `err` does; remove what is not written; release
 * everything. Returns the exit status. */
int render_open(struct render_run *r);
bool render_work(struct render_run *r, struct error *err);
int render_close(struct render_run *r, bool ok, struct error *err);

#endif
