/* formats.h: the picture formats, each of which image.c names in its table.
 *
 * Readers take a file that is in memory. X_matches tells by the content whether it is one of theirs. X_read fills
 * *out, to be released with image_free; on failure it returns false with a message and *out holds nothing to be
 * released; it asks `memory` first. Writers take linear RGB, top row first; errors stick to the stream.
 * Tests: test_image.c, test_hdr.c (pictures of other programs, truncations, changed bytes, absurd sizes). */
#ifndef ASBDPT_FORMATS_H
#define ASBDPT_FORMATS_H

#include <stddef.h>
#include <stdio.h>

#include "base/file.h"
#include "image/picture.h"

/* PFM, portable float maps: a text header, then 32-bit floats, bottom row first. Read: RGB and grey, either byte order.
 * Written: RGB, little-endian whatever the machine, scale -1, as pbrt-v3 writes it.
 *
 *     PF        (RGB; Pf: grey)
 *     width height
 *     scale     (negative: little-endian, positive: big-endian; samples are multiplied by its size) */
bool pfm_matches(const uint8_t *data, size_t size);
bool pfm_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void pfm_write(FILE *f, const struct raster *r);

/* PPM and PGM, portable pix maps and grey maps: P6 and P5 binary, P3 and P2 as text; 8 or 16 bits a sample. Written:
 * P6, 8 bits, sRGB encoded.
 *
 *     P6  width height  maxval  samples     (a # begins a comment that ends with its line) */
bool ppm_matches(const uint8_t *data, size_t size);
bool ppm_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void ppm_write(FILE *f, const struct raster *r);

/* PNG files [PNG]. Read: every colour type and depth, not interlaced. Alpha, transparency and colour profiles are
 * not used; checksums are checked. Written: 8 bits, sRGB encoded; with alpha, if there is, by which colours are
 * divided. */
bool png_matches(const uint8_t *data, size_t size);
bool png_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void png_write(FILE *f, const struct raster *r);

/* TGA, Truevision's Targa files: colour, grey and colour-mapped, run-length coded or not. TGA has no signature: the
 * file's name decides. Pixels of 24 or 32 bits (blue, green, red, alpha), grey and map indices of 8 bits; 15 and 16-bit
 * pixels are refused. */
bool tga_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);

/* OpenEXR files [OpenEXR]. Read: one part in rows, channels of halfs, floats and integers, uncompressed or by ZIPS, ZIP
 * or PIZ; as pbrt-v3 does, the data window as the picture, of the channels R, G, B (also r, g, b; a missing one
 * is 0), or Y alone as grey. Other compressions, several parts, tiles, deep pictures and subsampled channels are
 * refused. Written: R, G, B and all other channels as halfs, where what is finite and beyond 65504 becomes that, or as
 * floats, exactly; ZIP; as pbrt-v3 does, the picture as the data window and the whole as the display window. */
bool exr_matches(const uint8_t *data, size_t size);
bool exr_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void exr_write_half(FILE *f, const struct raster *r);
void exr_write_float(FILE *f, const struct raster *r);

#endif
