/* zlib.h: packs and unpacks zlib data [RFC 1950] [RFC 1951], and the checksums inside a PNG file.
 *
 * zlib.c holds the checksums and the tables of the format, inflate.c unpacks, deflate.c packs.
 * Tests: test_zlib.c (published check values, streams of another program, round trips, damaged streams).
 */
#ifndef ASBDPT_ZLIB_H
#define ASBDPT_ZLIB_H

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

/* deflate_zlib: a zlib stream that unpacks to the n bytes at `in`; to be given to free().
 *   n     below 2^32 - 1
 *   size  out, its length
 * Cannot fail. The same input gives the same output everywhere. Thread-safe. */
uint8_t *deflate_zlib(const uint8_t *in, size_t n, size_t *size);

/* checksum_crc32: CRC-32 of a chunk of a PNG file [PNG annex D]. Start with crc = 0; feed pieces by passing the
 * result on. "123456789" gives cbf43926. */
uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n);

/* checksum_adler32: Adler-32 at the end of a zlib stream [RFC 1950]. "Wikipedia" gives 11e60398. */
uint32_t checksum_adler32(const uint8_t *data, size_t n);

/* The alphabets of deflate, for inflate.c and deflate.c alone [RFC 1951 3.2.5] [RFC 1951 3.2.7]. */
enum {
    DEFLATE_LITERALS = 288, /* literal bytes 0..255, end of block 256, lengths 257..285, two unused */
    DEFLATE_DISTANCES = 30,
    DEFLATE_LENGTHS = 29,
    DEFLATE_END = 256,    /* the symbol that ends a block */
    DEFLATE_META = 19,    /* symbols that describe code lengths */
    DEFLATE_MAX_BITS = 15 /* longest code */
};
extern const uint16_t deflate_length_base[DEFLATE_LENGTHS];     /* shortest copy of length symbol 257 + i */
extern const uint8_t deflate_length_extra[DEFLATE_LENGTHS];     /* bits that follow it */
extern const uint16_t deflate_distance_base[DEFLATE_DISTANCES]; /* the same for distances */
extern const uint8_t deflate_distance_extra[DEFLATE_DISTANCES];
extern const uint8_t deflate_meta_order[DEFLATE_META]; /* order in which a block states the lengths of meta codes */

#endif
