/* image.h: pictures in memory and their files.
 *
 * Formats are one table {extension, read, write}: PFM (linear float RGB), PPM and PNG (8-bit sRGB when
 * written; read as stored), TGA (read only). Each format lives in a file of its own.
 *
 * Used by: texture, light (environment maps), film output, compare.
 */
#ifndef ASBDPT_IMAGE_H
#define ASBDPT_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"

/* A picture, top row first, channels interleaved. Exactly one of u8 and f32 is set. */
struct image {
    int width, height;
    int channels; /* 1 grey or 3 RGB; an alpha channel is dropped on reading */
    uint8_t *u8;  /* [height*width*channels], as stored in the file (usually sRGB encoded); owned */
    float *f32;   /* [height*width*channels]; PFM as stored; 16-bit files as value/65535; owned */
    bool linear;  /* true for PFM: values are linear light already */
};

/* image_read: read a picture; the format is recognised by content where it has a signature, else by the
 * name's extension (upper or lower case).
 *   out  filled on success, to be released with image_free
 * Returns false with a message "PATH: what is wrong" on a missing, truncated, absurdly large or unknown file. */
bool image_read(const char *path, struct image *out, struct error *err);
void image_free(struct image *img);

/* image_write: write linear RGB as the format named by the extension (.pfm, .ppm, .png).
 *   pixels  [height*width*3] floats, top row first, linear; .ppm and .png are clamped to [0,1] and sRGB encoded
 * The file appears whole or not at all: it is written beside its name and renamed. Returns false with a
 * message on an unknown extension or any I/O error (full disk), leaving no file behind. */
bool image_write(const char *path, int width, int height, const float *pixels, struct error *err);

/* image_writable: does `path` end in an extension image_write knows? */
bool image_writable(const char *path);

/* srgb_encode: linear [0,1] -> sRGB [0,1];  srgb_decode: its inverse [IEC 61966-2-1]. */
double srgb_encode(double linear);
double srgb_decode(double encoded);

/* srgb_byte: the 8-bit value written for a linear number: clamp(255 encode(x) + 0.5); NaN gives 0. */
uint8_t srgb_byte(double linear);

#endif
