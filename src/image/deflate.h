/* deflate.h: packs bytes as zlib data [RFC 1950, RFC 1951].
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_DEFLATE_H
#define ASBDPT_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

/* deflate_zlib: a zlib stream that unpacks to the n bytes at `in`; to be given to free().
 *   n     below 2^32 - 1
 *   size  out, its length
 * Cannot fail. The same input gives the same output everywhere. Thread-safe. */
uint8_t *deflate_zlib(const uint8_t *in, size_t n, size_t *size);

#endif
