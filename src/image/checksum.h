/* checksum.h: the two checksums inside a PNG file.
 *
 * Tests: test_image.c (published check values).
 */
#ifndef ASBDPT_CHECKSUM_H
#define ASBDPT_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* checksum_crc32: CRC-32 of a chunk of a PNG file [PNG Annex D]. Start with crc = 0; feed pieces by passing the
 * result on. "123456789" gives cbf43926. */
uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n);

/* checksum_adler32: Adler-32 at the end of a zlib stream [RFC 1950]. "Wikipedia" gives 11e60398. */
uint32_t checksum_adler32(const uint8_t *data, size_t n);

#endif
