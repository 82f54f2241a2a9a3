/* zlib.c: the checksums and tables that inflate.c, deflate.c and png.c share, see zlib.h. */
#include "image/zlib.h"

const uint16_t deflate_length_base[DEFLATE_LENGTHS] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                                       15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                                       67, 83, 99, 115, 131, 163, 195, 227, 258};
const uint8_t deflate_length_extra[DEFLATE_LENGTHS] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                                       2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
const uint16_t deflate_distance_base[DEFLATE_DISTANCES] = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
const uint8_t deflate_distance_extra[DEFLATE_DISTANCES] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                           6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
const uint8_t deflate_meta_order[DEFLATE_META] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n)
{
    uint32_t left[256]; /* what a byte leaves, bits reversed, modulo the polynomial edb88320 */
    for (uint32_t b = 0; b < 256; b++) {
        left[b] = b;
        for (int bit = 0; bit < 8; bit++)
            left[b] = left[b] >> 1 ^ (left[b] & 1 ? 0xedb88320 : 0);
    }
    crc = ~crc;
    for (size_t i = 0; i < n; i++)
        crc = crc >> 8 ^ left[(crc ^ data[i]) & 255];
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
