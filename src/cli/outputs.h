/* outputs.h: the pictures that a subcommand is to write, opened before the work begins.
 *
 * What is wrong with a name, a directory or its rights is thus said at once. Files that the work does not come to
 * write are removed. Tests: test/cli.sh.
 */
#ifndef ASBDPT_OUTPUTS_H
#define ASBDPT_OUTPUTS_H

#include <stdbool.h>

#include "base/file.h"
#include "cli/options.h"

struct outputs {
    struct file_output *file; /* [n], owned */
    int n;
};

/* outputs_open: begin to write pictures of these names, at least one, - (standard output) at most once. Returns false
 * with a message; nothing is open then. After success one of outputs_write and outputs_abandon must follow. */
bool outputs_open(const struct texts *names, struct outputs *out, struct error *err);

/* outputs_write: the picture into all of them; unless `quiet` a last line on stderr names them. One that fails does not
 * keep the others from being written: the first message is kept and false returned. */
bool outputs_write(struct outputs *o, int width, int height, const float *pixels, bool quiet, struct error *err);

void outputs_abandon(struct outputs *o);

#endif
