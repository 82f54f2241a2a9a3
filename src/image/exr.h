/* exr.h: what the files about OpenEXR share: exr.c, piz.c.
 *
 * A file is a magic number, a version, a header of attributes, a table of offsets, and blocks of rows of the picture.
 * In a block come row after row; in a row channel after channel, in the order of the header, all samples
 * of one before the next; every number is little-endian. Blocks are compressed one by one; where that saves nothing,
 * they are stored as they are. [OpenEXR]
 * Tests: test_hdr.c (files of another program, round trips, damaged files, all 65536 halfs). */
#ifndef ASBDPT_EXR_H
#define ASBDPT_EXR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/bits.h"
#include "base/error.h"

enum exr_type { EXR_UINT, EXR_HALF, EXR_FLOAT };                            /* as numbered in files */
enum exr_compression { EXR_NONE, EXR_RLE, EXR_ZIPS, EXR_ZIP, EXR_PIZ, EXR_READ }; /* read: below EXR_READ, not RLE */
enum { EXR_ZIP_ROWS = 16, EXR_PIZ_ROWS = 32 };                              /* of a block; the others have one row */

struct exr_channel {
    const char *name; /* in the file */
    enum exr_type type;
    size_t start; /* bytes of a pixel in the channels before this one */
};

static inline size_t exr_type_bytes(enum exr_type type) { return type == EXR_HALF ? 2 : 4; }

/* A file in memory, and what its header says. */
struct exr {
    const uint8_t *data;
    size_t size, at; /* bytes, and how many are read */
    enum exr_compression compression;
    int64_t data_window[4], display[4]; /* left, top, right, bottom, all in it */
    size_t width, height;        /* of the data window, not empty */
    bool tiled;
    size_t columns, rows;        /* of a block; the last may have fewer */
    struct exr_channel *channel; /* [n_channels], at least one; owned */
    size_t n_channels, capacity;
    size_t pixel_bytes; /* of all channels */
    const struct budget *memory;
    struct error *err;
};

static inline uint32_t exr_u32(const uint8_t *p) { return (uint32_t)bits_of_bytes(p, 4, false); }

/* exr_i32: a two's complement number. */
static inline int64_t exr_i32(const uint8_t *p)
{
    int64_t value = exr_u32(p);
    return value < 0x80000000 ? value : value - 0x100000000;
}

/* piz_unpack: the bytes of a block compressed as EXR_PIZ, of [n] bytes, [size] to out. False on damage; never writes
 * elsewhere.
 *   width, height  pixels of the block: size = width height e->pixel_bytes */
bool piz_unpack(const struct exr *e, const uint8_t *in, size_t n, size_t width, size_t height, uint8_t *out,
                size_t size);

/* --- halfs: 16-bit floating point numbers, binary16 [IEEE 754 3.6]: a sign, 5 bits of exponent (bias 15), 10 of
 * fraction ---------------------------------------------------------------------------------------------- */

/* The largest finite half. */
#define HALF_MAX 65504

/* half_to_float: exact; a NaN stays one. */
static inline float half_to_float(uint16_t h)
{
    unsigned exponent = h >> 10 & 31, fraction = h & 1023;
    if (exponent == 0) { /* 0 and subnormal numbers: multiples of 2^-24 */
        float small = (float)fraction * (1.0f / (1 << 24));
        return (h & 0x8000) != 0 ? -small : small;
    }
    return float_of_bits((uint32_t)(h & 0x8000) << 16 | (exponent == 31 ? 255 : exponent + 112) << 23 | fraction << 13);
}

/* float_to_half: the nearest half, of two equally near ones the even. What is finite stays finite: at most HALF_MAX in
 * magnitude. */
static inline uint16_t float_to_half(float x)
{
    uint32_t bits = bits_of_float(x);
    uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
    uint32_t size = bits & 0x7fffffff;
    if (size >= 0x7f800000) /* infinity, NaN */
        return (uint16_t)(sign | (size > 0x7f800000 ? 0x7e00 : 0x7c00));
    if (size >= 0x477fe000) /* HALF_MAX */
        return (uint16_t)(sign | 0x7bff);
    if (size < 0x38800000) /* below 2^-14: a multiple of 2^-24, which rounding to an integer finds */
        return (uint16_t)(sign | (uint16_t)lrintf(fabsf(x) * (1 << 24)));
    size += 0xfff + (size >> 13 & 1); /* round to even; a carry into the exponent is right */
    return (uint16_t)(sign | (size - 0x38000000) >> 13);
}

#endif
