/* exr.h: what the files about OpenEXR share: exr_header.c, exr_read.c, exr_pack.c, piz.c, piz_huffman.c, exr_write.c.
 *
 * A file is a magic number, a version, a header of attributes, a table of offsets, and blocks: rows of the picture, or
 * tiles of it. In a block come row after row; in a row channel after channel, in the order of the header, all samples
 * of one before the next; every number is little-endian. Blocks are compressed one by one; where that saves nothing,
 * they are stored as they are. [OpenEXR]
 *
 * Tests: test_hdr.c (files of another program, round trips, damaged files).
 */
#ifndef ASBDPT_EXR_H
#define ASBDPT_EXR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/bits.h"
#include "base/error.h"

enum exr_type { EXR_UINT, EXR_HALF, EXR_FLOAT };                            /* as numbered in files */
enum exr_compression { EXR_NONE, EXR_RLE, EXR_ZIPS, EXR_ZIP, EXR_PIZ, EXR_READ }; /* those below EXR_READ are read */
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
    bool tiled;
    enum exr_compression compression;
    int64_t data_window[4], display[4]; /* left, top, right, bottom, all in it */
    size_t width, height;        /* of the data window, not empty */
    size_t block[2];             /* usual width and height of a block, at most the picture's */
    struct exr_channel *channel; /* [n_channels], at least one; owned */
    size_t n_channels, capacity;
    size_t pixel_bytes; /* of all channels */
    struct error *err;
};

static inline uint32_t exr_u32(const uint8_t *p) { return (uint32_t)bits_of_bytes(p, 4, false); }

/* exr_i32: a two's complement number. */
static inline int64_t exr_i32(const uint8_t *p)
{
    int64_t value = exr_u32(p);
    return value < 0x80000000 ? value : value - 0x100000000;
}

/* exr_read_header: fill *e, whose data, size and err are set, up to the table of offsets. Returns false with a message
 * on damage and on kinds of files that are not read. Either way e->channel is to be given to free(). */
bool exr_read_header(struct exr *e);

/* exr_unpack: the bytes of a compressed block, [size] to out.
 *   in       [n], as stored
 *   scratch  [size]
 *   width, height  pixels of the block: size = width height e->pixel_bytes
 * Returns false on damage; never writes elsewhere. */
bool exr_unpack(const struct exr *e, const uint8_t *in, size_t n, size_t width, size_t height, uint8_t *scratch,
                uint8_t *out, size_t size);

/* exr_pack_zip: a block compressed as EXR_ZIP, to be given to free().
 *   in       [n]
 *   scratch  [n]
 *   size     out, its length, which may be larger than n */
uint8_t *exr_pack_zip(const uint8_t *in, size_t n, uint8_t *scratch, size_t *size);

/* piz_unpack: the same as exr_unpack for EXR_PIZ alone. */
bool piz_unpack(const struct exr *e, const uint8_t *in, size_t n, size_t width, size_t height, uint8_t *out,
                size_t size);

/* piz_huffman_unpack: the 16-bit numbers of a Huffman-coded stream, [count] to out. Returns false on
 * damage. */
bool piz_huffman_unpack(const uint8_t *in, size_t n, uint16_t *out, size_t count);

#endif
