/* zlib.h: packs and unpacks zlib data [RFC 1950] [RFC 1951], and the checksums inside a PNG file.
 * Tests: test_zlib.c (published check values, streams of another program, round trips, damaged streams). */
#ifndef ASBDPT_ZLIB_H
#define ASBDPT_ZLIB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* No deflate stream can grow by more than this factor: the longest copy is 258 bytes, the shortest code for one
 * takes 1 + 1 bits. */
enum { INFLATE_MAX_RATIO = 1032 };

/* inflate_zlib: unpack a zlib stream [n], behind whose end there may be more, to out [out_size]. False with a message,
 * and `out` partly filled, on malformed or truncated data, a wrong checksum, and another length than out_size. */
bool inflate_zlib(const uint8_t *in, size_t n, uint8_t *out, size_t out_size, struct error *err);

/* deflate_zlib: a zlib stream [size] that unpacks to the n bytes at `in`, n below 2^32 - 1; to be given to free(). The
 * same everywhere. */
uint8_t *deflate_zlib(const uint8_t *in, size_t n, size_t *size);

/* checksum_crc32: of a chunk of a PNG file [PNG annex D]. Start with crc = 0; feed pieces by passing the result on.
 * checksum_adler32: at the end of a zlib stream [RFC 1950]. */
uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n);
uint32_t checksum_adler32(const uint8_t *data, size_t n);

#endif
