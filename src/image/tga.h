/* tga.h: Truevision TGA files: colour, grey and colour-mapped, plain or run-length coded. Reading only.
 *
 * TGA has no signature: the file's name decides. Pixels of 24 or 32 bits (blue, green, red, alpha), grey and map
 * indices of 8 bits; 15 and 16-bit pixels are refused.
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_TGA_H
#define ASBDPT_TGA_H

#include <stddef.h>

#include "image/picture.h"

bool tga_read(const uint8_t *data, size_t size, struct image *out, struct error *err);

#endif
