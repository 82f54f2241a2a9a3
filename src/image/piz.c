/* piz.c: OpenEXR's PIZ compression, see exr.h. [OpenEXR]
 *
 * The block is taken as 16-bit numbers, one per half and two per longer sample, channel after channel. The numbers that
 * occur are counted through, so that they become small; the planes go through a wavelet transform of pairs (average and
 * difference), level by level; what comes out is Huffman-coded. Here all of that is undone.
 *
 *     first, last                        16 bits each: bytes of the following map
 *     map[first..last]                   bit v % 8 of byte v / 8: does the number v occur? 0 always does
 *     length, and so many bytes of data  see piz_huffman.c */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"

enum { NUMBERS = 65536, MAP_BYTES = NUMBERS / 8 };

/* Fill value[0..], the numbers that occur in rising order. Returns the largest index, or -1 on damage; *at moves on. */
static int read_map(const uint8_t *in, size_t n, size_t *at, uint16_t *value)
{
    if (n < 4)
        return -1;
    size_t first = (size_t)bits_of_bytes(in, 2, false), last = (size_t)bits_of_bytes(in + 2, 2, false);
    size_t bytes = first <= last ? last - first + 1 : 0;
    *at = 4;
    if (last >= MAP_BYTES || bytes > n - *at)
        return -1;
    const uint8_t *map = in + *at;
    *at += bytes;
    int used = 1; /* value[0] = 0 */
    for (size_t i = 0; i < bytes; i++)
        for (size_t bit = 0; bit < 8; bit++)
            if ((map[i] >> bit & 1) != 0 && (first + i) * 8 + bit != 0)
                value[used++] = (uint16_t)((first + i) * 8 + bit);
    return used - 1;
}

/* A pair back from an average, in *a, and a difference, in *b. Narrow: of numbers below 2^14, two's complement. Wide:
 * of all 16 bits, modulo 2^16, the difference shifted by 2^15. */
static void undo_pair(uint16_t *a, uint16_t *b, bool wide)
{
    unsigned difference = *b, half = difference >> 1 | (difference & 0x8000), first = *a + (difference & 1) + half;
    unsigned second = first - difference;
    if (wide) {
        second = (unsigned)*a - (difference >> 1);
        first = difference + second + 0x8000;
    }
    *a = (uint16_t)first;
    *b = (uint16_t)second;
}

/* Undo the wavelet transform of nx * ny numbers, `dx` apart in a row, `dy` from row to row. At a level, numbers `half`
 * apart are the pairs, first in y, then in x; what has no partner at the right or bottom is paired in one direction. */
static void undo_wavelet(uint16_t *v, size_t nx, size_t dx, size_t ny, size_t dy, bool wide)
{
    size_t least = nx < ny ? nx : ny, whole = 1;
    while (whole <= least / 2)
        whole *= 2;
    for (; whole >= 2; whole /= 2) {
        size_t half = whole / 2, x, y, right = half * dx, down = half * dy;
        for (y = 0; y + whole <= ny; y += whole) {
            for (x = 0; x + whole <= nx; x += whole) {
                uint16_t *p = v + y * dy + x * dx;
                undo_pair(p, p + down, wide);
                undo_pair(p + right, p + right + down, wide);
                undo_pair(p, p + right, wide);
                undo_pair(p + down, p + down + right, wide);
            }
            if ((nx & half) != 0)
                undo_pair(v + y * dy + x * dx, v + y * dy + x * dx + down, wide);
        }
        for (x = 0; (ny & half) != 0 && x + whole <= nx; x += whole)
            undo_pair(v + y * dy + x * dx, v + y * dy + x * dx + right, wide);
    }
}

/* From planes, channel after channel, to the bytes of rows. */
static void interleave(const struct exr *e, const uint16_t *number, const uint16_t *value, size_t width, size_t height,
                       uint8_t *out)
{
    for (size_t i = 0; i < e->n_channels; i++) {
        const struct exr_channel *c = &e->channel[i];
        size_t row = width * exr_type_bytes(c->type) / 2;
        for (size_t y = 0; y < height; y++) {
            const uint16_t *from = number + (width * height * c->start) / 2 + y * row;
            uint8_t *to = out + (y * e->pixel_bytes + c->start) * width;
            for (size_t k = 0; k < row; k++)
                bytes_of_bits(value[from[k]], to + 2 * k, 2, false);
        }
    }
}

bool piz_unpack(const struct exr *e, const uint8_t *in, size_t n, size_t width, size_t height, uint8_t *out,
                size_t size)
{
    uint16_t *value = mem_alloc(NUMBERS, sizeof *value), *number = mem_alloc(size / 2, sizeof *number);
    size_t at = 0;
    int largest = read_map(in, n, &at, value);
    bool ok = largest >= 0 && n - at >= 4 && exr_u32(in + at) <= n - at - 4 &&
              piz_huffman_unpack(in + at + 4, exr_u32(in + at), number, size / 2);
    for (size_t i = 0; ok && i < e->n_channels; i++) {
        const struct exr_channel *c = &e->channel[i];
        size_t words = exr_type_bytes(c->type) / 2;
        for (size_t k = 0; k < words; k++)
            undo_wavelet(number + width * height * c->start / 2 + k, width, words, height, width * words,
                         largest >= 1 << 14);
    }
    if (ok)
        interleave(e, number, value, width, height, out);
    free(number);
    free(value);
    return ok;
}
