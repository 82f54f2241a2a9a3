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

/* Four bytes at a time: what each of them leaves of the remainder, by itself, adds up to what they leave together. */
uint32_t checksum_crc32(uint32_t crc, const uint8_t *data, size_t n)
{
    uint32_t left[4][256]; /* [k][b]: of byte b after k more bytes, bits reversed, modulo the polynomial edb88320 */
    for (uint32_t b = 0; b < 256; b++) {
        left[0][b] = b;
        for (int bit = 0; bit < 8; bit++)
            left[0][b] = left[0][b] >> 1 ^ (left[0][b] & 1 ? 0xedb88320 : 0);
    }
    for (int k = 1; k < 4; k++)
        for (int b = 0; b < 256; b++)
            left[k][b] = left[k - 1][b] >> 8 ^ left[0][left[k - 1][b] & 255];
    crc = ~crc;
    for (; n >= 4; data += 4, n -= 4) {
        crc ^= data[0] | (uint32_t)data[1] << 8 | (uint32_t)data[2] << 16 | (uint32_t)data[3] << 24;
        crc = left[3][crc & 255] ^ left[2][crc >> 8 & 255] ^ left[1][crc >> 16 & 255] ^ left[0][crc >> 24];
    }
    for (; n > 0; data++, n--)
        crc = crc >> 8 ^ left[0][(crc ^ *data) & 255];
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
