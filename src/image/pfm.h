/* pfm.h: portable float maps: a text header, then 32-bit floats, bottom row first.
 *
 *     PF        (RGB; Pf: grey)
 *     width height
 *     scale     (negative: little-endian, positive: big-endian; samples are multiplied by its size)
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_PFM_H
#define ASBDPT_PFM_H

#include <stddef.h>
#include <stdio.h>

#include "image/picture.h"

bool pfm_matches(const uint8_t *data, size_t size);
bool pfm_read(const uint8_t *data, size_t size, struct image *out, struct error *err);

/* pfm_write: RGB, little-endian whatever the machine, scale -1, as pbrt-v3 writes it. Errors stick to f. */
void pfm_write(FILE *f, int width, int height, const float *pixels);

#endif
