/* picture.h: pixels in memory, as the image formats fill and textures read them, and the transfer function of sRGB
 * between linear light and the numbers of 8-bit pictures.
 * Tests: test_image.c. */
#ifndef ASBDPT_PICTURE_H
#define ASBDPT_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

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

#endif
