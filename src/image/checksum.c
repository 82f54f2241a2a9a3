/* checksum.c: see checksum.h. */
#include "image/checksum.h"

uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n)
{
    /* remainder of each 4-bit value, bits reversed, modulo the polynomial edb88320 */
    static const uint32_t REMAINDER[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4,
                                           0x4db26158, 0x5005713c, 0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                           0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    crc = ~crc;
    for (size_t i = 0; i < n; i++) {
        crc ^= data[i];
        crc = crc >> 4 ^ REMAINDER[crc & 15];
        crc = crc >> 4 ^ REMAINDER[crc & 15];
    }
    return ~crc;
}

uint32_t checksum_adler32(const uint8_t *data, size_t n)
{
    enum { PIECE = 5552 }; /* the longest run whose sums stay below 2^32 */
    uint32_t a = 1, b = 0;
    while (n > 0) {
        size_t run = n < PIECE ? n : PIECE;
        for (size_t i = 0; i < run; i++) {
            a += data[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
        data += run;
        n -= run;
    }
    return b << 16 | a;
}
