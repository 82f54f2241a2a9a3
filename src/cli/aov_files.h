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
    bool wanted[N_AOVS];
    int first;              /* of the outputs that are theirs, in this order */
    float *picture[N_AOVS]; /* owned, NULL before aov_make */
};

/* aov_read: names of aov_name with commas between them; NULL: none. False with a message. */
bool aov_read(const char *list, struct aov_files *out, struct error *err);

/* aov_open: begin to write them beside the first of the pictures.
 *   all  the files of the command; in-out
 *   out  the pictures of the command; in-out
 * Returns false with a message. */
bool aov_open(struct aov_files *f, struct names *all, struct outputs *out, struct error *err);

/* aov_make: make them, for outputs_write; aov_free after that.
 *   options, film  of the render that is done; for the variance the film must have kept errors */
void aov_make(struct aov_files *f, const struct scene *scene, const struct render_options *options,
              const struct film *film, struct outputs *out);
void aov_free(struct aov_files *f);

#endif
