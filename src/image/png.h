/* png.h: PNG files [PNG: ISO/IEC 15948, W3C Portable Network Graphics].
 *
 * Read: every colour type and depth, interlaced or not. Alpha, transparency and colour profiles are not used;
 * checksums are checked. Written: 8-bit RGB.
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_PNG_H
#define ASBDPT_PNG_H

#include <stddef.h>
#include <stdio.h>

#include "image/picture.h"

bool png_matches(const uint8_t *data, size_t size);
bool png_read(const uint8_t *data, size_t size, struct image *out, struct error *err);

/* png_write: 8-bit RGB, sRGB encoded from linear RGB. Errors stick to the stream. */
void png_write(FILE *f, int width, int height, const float *pixels);

#endif
