/* aov_files.h: render --aov: which first-hit pictures are wanted, and the files beside the rendered one.
 *
 * Beside NAME.png lie NAME.albedo.pfm, NAME.normal.pfm, ... Tests: test/cli.sh.
 */
#ifndef ASBDPT_AOV_FILES_H
#define ASBDPT_AOV_FILES_H

#include "cli/names.h"
#include "cli/outputs.h"
#include "render/aov.h"

struct aov_files {
    struct outputs file[N_AOVS]; /* one each, or none */
    bool any;
};

/* aov_check: is the list made of names of aov_name, with commas between them? False with a message. */
bool aov_check(const char *list, struct error *err);

/* aov_open: begin to write the pictures of a good list beside `picture`.
 *   all  the files of the command; in-out
 * Returns false with a message; nothing is open then. After success one of aov_write and aov_abandon must follow. */
bool aov_open(const char *list, const char *picture, struct names *all, struct aov_files *out, struct error *err);

/* aov_write: make and write them.
 *   options, film  of the render that is done; for the variance the film must have kept errors
 * Returns false with a message, also when the render was stopped too early for a variance; the others are written. */
bool aov_write(struct aov_files *f, const struct scene *scene, const struct render_options *options,
               const struct film *film, bool quiet, struct error *err);

void aov_abandon(struct aov_files *f);

#endif
