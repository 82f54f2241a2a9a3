/* image.h: pictures in memory and their files.
 *
 * Formats are rows of one table in image.c: PFM and OpenEXR (linear RGB), PPM, PNG and TGA (8-bit sRGB when written;
 * read as stored). TGA is only read. The pixels in memory are picture.h's, the formats formats.h's.
 * Tests: test_image.c, test_hdr.c. */
#ifndef ASBDPT_IMAGE_H
#define ASBDPT_IMAGE_H

#include <stdbool.h>

#include "base/error.h"
#include "base/file.h"
#include "image/picture.h"

/* image_read: read a picture; the format is recognised by content where it has a signature, else by the
 * name's extension (upper or lower case).
 *   memory  that may be used for it; nothing is taken; NULL: what is usual (budget_new)
 *   out     filled on success, to be released with image_free (picture.h); empty on failure
 * Returns false with a message "PATH: what is wrong" on a missing, truncated, too large or unknown file. */
bool image_read(const char *path, const struct budget *memory, struct image *out, struct error *err);

/* image_read_linear: any picture as linear RGB floats [height*width*3], top row first, to be freed; what is not linear
 * is decoded from sRGB. NULL with a message. image_read_values: the same without decoding: sRGB values are from 0 to 1.
 *   about  becomes what image_read says of the file, without its pixels; may be NULL */
float *image_read_linear(const char *path, int *width, int *height, struct image *about, struct error *err);
float *image_read_values(const char *path, int *width, int *height, struct image *about, struct error *err);

/* image_mend: make samples that are NaN or infinite 0, and negative ones too if asked; `replaced` counts them. */
void image_mend(struct image *img, bool negative_too);

/* The extensions of what is written, for messages. */
#define IMAGE_WRITTEN ".pfm, .exr, .png or .ppm"

/* image_create, image_finish: write a picture in the format named by the extension; to standard output, -, as PFM.
 * .ppm and .png are clamped to [0,1] and sRGB encoded; .exr has halfs, like pbrt-v3's, and a warning says how many
 * values these have cut; .float.exr has floats. The file appears whole or not at all. The first says what is wrong with
 * the name or the place, as of a terminal, and is to be followed by image_finish or file_abandon; the second, which may
 * come hours later, fails on any I/O error. */
bool image_create(const char *path, struct file_output *out, struct error *err);
bool image_finish(struct file_output *f, const struct raster *r, struct error *err);

/* image_writable: does it end in an extension that image_create knows? image_is_8_bit: in one of 8-bit pictures? */
bool image_writable(const char *path);
bool image_is_8_bit(const char *path);

#endif
