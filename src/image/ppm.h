/* ppm.h: portable pix maps and grey maps: P6 and P5 binary, P3 and P2 as text; 8 or 16 bits a sample.
 *
 *     P6  width height  maxval  samples     (a # begins a comment that ends with its line)
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_PPM_H
#define ASBDPT_PPM_H

#include <stddef.h>
#include <stdio.h>

#include "image/picture.h"

bool ppm_matches(const uint8_t *data, size_t size);
bool ppm_read(const uint8_t *data, size_t size, struct image *out, struct error *err);

/* ppm_write: P6, 8 bits, sRGB encoded from linear RGB. Errors stick to the stream. */
void ppm_write(FILE *f, int width, int height, const float *pixels);

#endif
