/* files.h: whole files of the laboratory: a picture, and a directory for many.
 *
 * Tests: test/run/cli.sh.
 */
#ifndef ASBDPT_LAB_FILES_H
#define ASBDPT_LAB_FILES_H

#include <stdbool.h>

#include "base/error.h"

/* image_write: a picture of linear values, [height*width*3], in the format that its name's extension says.
 * file_make_directory: and those above it, if they are not there. Both return false with a message. */
bool image_write(const char *path, int width, int height, const float *pixels, struct error *err);
bool file_make_directory(const char *path, struct error *err);

#endif
