/* inflate.h: unpacks zlib data [RFC 1950, RFC 1951].
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_INFLATE_H
#define ASBDPT_INFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* No deflate stream can grow by more than this factor: the longest copy is 258 bytes, the shortest code for one
 * takes 1 + 1 bits. */
enum { INFLATE_MAX_RATIO = 1032 };

/* inflate_zlib: unpack a zlib stream whose unpacked length is known.
 *   in   [n] the stream; bytes after its end are ignored
 *   out  [out_size] filled on success; partly filled on failure
 * Never writes beyond out_size. Returns false with a message on malformed or truncated data, on a wrong checksum,
 * and when the data unpack to another length than out_size. Thread-safe. */
bool inflate_zlib(const uint8_t *in, size_t n, uint8_t *out, size_t out_size, struct error *err);

/* The alphabets of deflate, shared with the packer [RFC 1951 3.2.5, 3.2.7]. */
enum {
    INFLATE_LITERALS = 288, /* literal bytes 0..255, end of block 256, lengths 257..285, two unused */
    INFLATE_DISTANCES = 30,
    INFLATE_LENGTHS = 29,
    INFLATE_END = 256,    /* the symbol that ends a block */
    INFLATE_META = 19,    /* symbols that describe code lengths */
    INFLATE_MAX_BITS = 15 /* longest code */
};
extern const uint16_t inflate_length_base[INFLATE_LENGTHS];     /* shortest copy of length symbol 257 + i */
extern const uint8_t inflate_length_extra[INFLATE_LENGTHS];     /* bits that follow it */
extern const uint16_t inflate_distance_base[INFLATE_DISTANCES]; /* the same for distances */
extern const uint8_t inflate_distance_extra[INFLATE_DISTANCES];
extern const uint8_t inflate_meta_order[INFLATE_META]; /* order in which a block states the lengths of meta codes */

#endif
