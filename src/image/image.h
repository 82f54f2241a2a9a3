/* image.h: pictures in memory and their files.
 *
 * Pixels are as the image formats fill and textures read them. Formats are rows of one table in image.c: PFM and
 * OpenEXR (linear RGB), PPM, PNG and TGA (8-bit sRGB when written; read as stored). TGA is only read.
 * Tests: test_image.c, test_hdr.c (pictures of other programs, truncations, changed bytes, absurd sizes). */
#ifndef ASBDPT_IMAGE_H
#define ASBDPT_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/file.h"

/* --- pixels ------------------------------------------------------------------------------------------- */

/* Where a picture lies in a whole of which it may be a part, as a crop window is: where its top left pixel is, and the
 * size of the whole; width 0: nobody knows. Of the formats OpenEXR alone says it. */
struct placement {
    int x, y, width, height;
};

/* One channel of a picture that is to be written: sample i is value[i * step]. */
struct channel {
    const char *name; /* "R"; of "A", alpha, premultiplied colours are multiples */
    const float *value;
    size_t step;
    bool exact; /* floats, also where OpenEXR's others are halfs */
};

/* A picture to be written. */
struct raster {
    struct placement at;
    int width, height;
    const float *pixels;        /* [height*width*3], linear RGB, top row first */
    const struct channel *more; /* [n_more] in addition to R, G, B: OpenEXR keeps all, PNG "A", the others none */
    int n_more;
    bool preview; /* nothing is said of what the format cuts */
};

/* raster_alpha: the channel "A", or NULL. */
const struct channel *raster_alpha(const struct raster *r);

/* A picture, top row first, channels interleaved. Exactly one of u8 and f32 is set. */
struct image {
    int width, height;
    int channels;      /* 1 grey or 3 RGB */
    uint8_t *u8;       /* [height*width*channels], as stored in the file (usually sRGB encoded); owned */
    float *f32;        /* [height*width*channels]; light as stored; 16-bit files as value/65535; owned */
    bool linear;       /* values are light already, as in PFM and OpenEXR; else sRGB */
    struct placement place;
    long replaced;     /* samples that image_mend found and made 0 */
    uint64_t content;  /* hash_content of the file */
    size_t file_size;  /* bytes */
    float decode[256]; /* sRGB byte -> linear light, for readers of u8 */
};

/* More pixels than PICTURE_MAX_PIXELS, 16384 x 16384, are taken for a damaged or hostile header. */
enum { PICTURE_MAX_PIXELS = 1 << 28 };

/* picture_size_ok: may a picture, or a film, be this large? False with a message. picture_truncated: the message that a
 * file is too short for the pixels it announces; false. */
bool picture_size_ok(uint64_t width, uint64_t height, struct error *err);
bool picture_truncated(unsigned long width, unsigned long height, struct error *err);

/* picture_alloc_u8 / picture_alloc_f32: black pixels of a size that picture_size_ok accepts, to be released with
 * image_free. Fills every field; `linear` is set for f32. */
void picture_alloc_u8(struct image *out, size_t width, size_t height, int channels);
void picture_alloc_f32(struct image *out, size_t width, size_t height, int channels);

/* image_free: its pixels; what is said of the file stays. */
void image_free(struct image *img);

/* image_bytes: what its pixels take. */
static inline size_t image_bytes(const struct image *img)
{
    size_t samples = (size_t)img->width * (size_t)img->height * (size_t)img->channels;
    return img->u8 != NULL ? samples : samples * sizeof *img->f32;
}

/* srgb_encode: linear [0,1] -> sRGB [0,1];  srgb_decode: its inverse [IEC 61966-2-1]. Negative numbers stay linear. */
double srgb_encode(double linear);
double srgb_decode(double encoded);

/* srgb_byte: the 8-bit value written for a linear number: clamp(255 encode(x) + 0.5); NaN gives 0. */
uint8_t srgb_byte(double linear);

/* --- files -------------------------------------------------------------------------------------------- */

/* image_read: read a picture; the format is recognised by content where it has a signature, else by the
 * name's extension (upper or lower case).
 *   memory  that may be used for it; nothing is taken; NULL: what is usual (budget_new)
 *   out     filled on success, to be released with image_free; empty on failure
 * Returns false with a message "PATH: what is wrong" on a missing, truncated, too large or unknown file. */
bool image_read(const char *path, const struct budget *memory, struct image *out, struct error *err);

/* image_read_linear: any picture as linear RGB floats [height*width*3], top row first, to be freed; what is not linear
 * is decoded from sRGB. NULL with a message. image_read_values: the same without decoding: sRGB values are from 0 to 1.
 *   about  becomes what image_read says of the file, without its pixels; may be NULL */
float *image_read_linear(const char *path, int *width, int *height, struct image *about, struct error *err);
float *image_read_values(const char *path, int *width, int *height, struct image *about, struct error *err);

/* image_mend: make samples that are NaN or infinite 0, and negative ones too if asked; `replaced` counts them. */
void image_mend(struct image *img, bool negative_too);

/* image_list_read, image_list_written: the extensions of all formats with a blank between them, for messages and help.
 * Both return `text`. */
enum { IMAGE_LIST_TEXT = 128 };
const char *image_list_read(char text[IMAGE_LIST_TEXT]);
const char *image_list_written(char text[IMAGE_LIST_TEXT]);

/* image_create, image_finish: write a picture in the format named by the extension; to standard output, -, as PFM.
 * .ppm and .png are clamped to [0,1] and sRGB encoded; .exr has halfs, like pbrt-v3's, and a warning says how many
 * values these have cut; .float.exr has floats. The file appears whole or not at all. The first says what is wrong with
 * the name or the place, and is to be followed by image_finish or file_abandon; the second, which may come hours later,
 * fails on any I/O error. */
bool image_create(const char *path, struct file_output *out, struct error *err);
bool image_finish(struct file_output *f, const struct raster *r, struct error *err);

/* image_writable: does it end in an extension that image_create knows? image_is_8_bit: in one of 8-bit pictures? */
bool image_writable(const char *path);
bool image_is_8_bit(const char *path);

/* --- formats, each a row of the table in image.c ------------------------------------------------------
 *
 * Readers take a file that is in memory. X_matches tells by the content whether it is one of theirs. X_read fills
 * *out, to be released with image_free; on failure it returns false with a message and *out holds nothing to be
 * released; it asks `memory` first. Writers take linear RGB, top row first; errors stick to the stream. */

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

/* PNG files [PNG]. Read: every colour type and depth. Alpha, transparency and colour profiles are
 * not used; checksums are checked. Written: 8 bits, sRGB encoded; with alpha, if there is, by which colours are
 * divided. */
bool png_matches(const uint8_t *data, size_t size);
bool png_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void png_write(FILE *f, const struct raster *r);

/* TGA, Truevision's Targa files: colour, grey and colour-mapped, run-length coded or not. TGA has no signature: the
 * file's name decides. Pixels of 24 or 32 bits (blue, green, red, alpha), grey and map indices of 8 bits; 15 and 16-bit
 * pixels are refused. */
bool tga_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);

/* OpenEXR files [OpenEXR]. Read: one part in rows or tiles, channels of halfs, floats and integers, uncompressed or by
 * ZIPS, ZIP or PIZ; as pbrt-v3 does, the data window as the picture, of the channels R, G, B (also r, g, b; a missing one
 * is 0), or Y alone as grey. Other compressions, several parts, deep pictures and subsampled channels are
 * refused. Written: R, G, B and all other channels as halfs, where what is finite and beyond 65504 becomes that, or as
 * floats, exactly; ZIP; as pbrt-v3 does, the picture as the data window and the whole as the display window. */
bool exr_matches(const uint8_t *data, size_t size);
bool exr_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
void exr_write_half(FILE *f, const struct raster *r);
void exr_write_float(FILE *f, const struct raster *r);
void exr_warn_half(const char *path, const struct raster *r); /* of what halfs cut */

#endif
