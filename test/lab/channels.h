/* channels.h: images of the paths of a render that asbdpt-lab render writes besides its picture: what the camera sees
 * first (aov.h); lights apart, alpha and variance (planes.h).
 *
 * Next to NAME.png are NAME.albedo.pfm, NAME.normal.pfm, ..., or NAME.exr has them as layers, with the channels
 * albedo.R, .G, .B, normal.X, .Y, .Z, depth.Z and so on, as compositors name them. Layers and alpha are in the
 * picture's own files, which are written again when these are made.
 *
 * Tests: test/run/cli.sh, test/run/outputs.sh. */
#ifndef ASBDPT_LAB_CHANNELS_H
#define ASBDPT_LAB_CHANNELS_H

#include "cli/cmd_render.h"
#include "lab/aov.h"
#include "lab/planes.h"

struct channel_options {
    const char *aov;    /* list or NULL */
    bool layers, seen;  /* they go into the picture's own file; see aov.h */
    const char *lights; /* directory or NULL */
    bool alpha;
};

/* One more file, and what is in it. */
struct channel_file {
    struct file_output file; /* its stream NULL: it is written */
    int light;               /* a group of lights; -1: none */
    enum aov aov;            /* else, N_AOVS: the picture, with layers and alpha */
};

struct channels {
    const struct channel_options *options;
    struct render_run *run;
    bool wanted[N_AOVS];
    struct channel_file *item; /* [n], owned */
    int n;
    struct planes planes;
    struct observers observers; /* of the planes */
};

/* channels_check: can the options be as they are? False with a message.
 * channels_variance: do they ask for the variance? */
bool channels_check(const struct channel_options *o, struct error *err);
bool channels_variance(const struct channel_options *o);

/* channels_open: begin to write the files, and look on at the render, which is open. False with a message, after which
 * nothing needs release.
 * channels_write: write them when the render is over if it went well, and release everything. False with a message; err
 * stays as it is where the render did not go well. */
bool channels_open(struct channels *l, const struct channel_options *o, struct render_run *run, struct error *err);
bool channels_write(struct channels *l, bool ok, struct error *err);

#endif
