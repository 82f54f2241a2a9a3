/* piz.c: OpenEXR's PIZ compression, see exr.h. [OpenEXR] [Huffman 1952]
 *
 * The block is taken as 16-bit numbers, one per half and two per longer sample, channel after channel. The numbers that
 * occur are counted through, so that they become small; the planes go through a wavelet transform of pairs (average and
 * difference), level by level; what comes out is Huffman-coded. Here all of that is undone.
 *
 *     first, last                        16 bits each: bytes of the following map
 *     map[first..last]                   bit v % 8 of byte v / 8: does the number v occur? 0 always does
 *     length, and so many bytes of data  see below */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"

/* --- Huffman codes ------------------------------------------------------------------------------------
 *
 * Symbols are 16-bit numbers, and one more, the last of the code, that says how often to repeat the number before. The
 * lengths of the codes are stated at the head. Codes of one length are consecutive numbers in the order of their
 * symbols, the longest codes being the smallest: at every length, what is below the first code of that length goes on.
 * Bits are read most significant bit first.
 *
 *     first symbol, last symbol, (unused), bits of data, (unused)    five numbers of 32 bits
 *     lengths of the codes                                           6 bits each, zeros in runs
 *     data                                                           from the next byte on */

enum {
    HEAD = 20,
    SYMBOLS = 65537,
    MAX_BITS = 57, /* longest code; a longer one needs more than 10^11 numbers */
    SHORT_RUN = 59, /* lengths 59..62: a run of 2..5 zeros; 63: of 6 and what the next 8 bits say */
    LONG_RUN = 63
};

struct bit_reader {
    const uint8_t *data;
    size_t n, next;
    uint64_t bits;  /* read ahead, the next one highest; zero below `count` */
    unsigned count;
    bool exhausted; /* more bits were taken than there are */
};

/* Read ahead: afterwards at least MAX_BITS bits are there, unless the data end. */
static void refill(struct bit_reader *in)
{
    for (; in->count <= 56 && in->next < in->n; in->count += 8)
        in->bits |= (uint64_t)in->data[in->next++] << (56 - in->count);
}

static void skip_bits(struct bit_reader *in, unsigned count)
{
    in->exhausted = in->exhausted || count > in->count;
    in->count -= count < in->count ? count : in->count;
    in->bits <<= count;
}

/* The next `count` bits, 1 to 8. */
static unsigned read_bits(struct bit_reader *in, unsigned count)
{
    refill(in);
    unsigned value = (unsigned)(in->bits >> (64 - count));
    skip_bits(in, count);
    return value;
}

struct code {
    uint8_t length[SYMBOLS];       /* 0 for a symbol that does not occur */
    uint32_t count[MAX_BITS + 1];  /* number of codes of each length */
    uint64_t first[MAX_BITS + 1];  /* first code of each length */
    uint32_t place[MAX_BITS + 1];  /* of its symbol in symbol[] */
    uint32_t symbol[SYMBOLS];      /* by length, then in order */
};

/* The lengths of symbols first to last. */
static bool read_lengths(struct code *c, struct bit_reader *in, uint32_t first, uint32_t last)
{
    for (uint32_t i = first; i <= last;) {
        unsigned length = read_bits(in, 6), run = 1;
        if (length >= SHORT_RUN) {
            run = length == LONG_RUN ? read_bits(in, 8) + 6 : length - SHORT_RUN + 2;
            length = 0;
        }
        if (in->exhausted || length > MAX_BITS || run > last - i + 1)
            return false;
        c->length[i] = (uint8_t)length; /* the others of a run are 0 already */
        c->count[length]++;
        i += run;
    }
    c->count[0] = 0;
    return true;
}

static bool build(struct code *c, uint32_t first, uint32_t last)
{
    uint64_t longer = 0; /* codes of the next length that begin longer ones, in pairs */
    uint32_t place = 0, next[MAX_BITS + 1];
    for (int l = MAX_BITS; l > 0; l--) {
        c->first[l] = longer;
        if (longer + c->count[l] > (uint64_t)1 << l)
            return false;
        longer = (longer + c->count[l]) / 2;
        c->place[l] = next[l] = place;
        place += c->count[l];
    }
    for (uint32_t i = first; i <= last; i++) {
        unsigned l = c->length[i];
        if (l > 0)
            c->symbol[next[l]++] = i;
    }
    return true;
}

/* The next symbol; SYMBOLS if the bits are no code. */
static uint32_t decode(const struct code *c, struct bit_reader *in)
{
    refill(in);
    for (unsigned l = 1; l <= MAX_BITS; l++) {
        uint64_t value = in->bits >> (64 - l);
        if (value < c->first[l])
            continue;
        skip_bits(in, l);
        value -= c->first[l];
        return value < c->count[l] ? c->symbol[c->place[l] + value] : SYMBOLS;
    }
    return SYMBOLS;
}

static bool decode_all(const struct code *c, struct bit_reader *in, uint32_t repeat, uint16_t *out, size_t count)
{
    for (size_t done = 0; done < count;) {
        uint32_t symbol = decode(c, in);
        size_t run = 1;
        if (symbol == repeat) {
            run = read_bits(in, 8);
            symbol = done > 0 ? out[done - 1] : SYMBOLS;
        }
        if (in->exhausted || symbol >= SYMBOLS - 1 || run > count - done)
            return false;
        for (; run > 0; run--)
            out[done++] = (uint16_t)symbol;
    }
    return true;
}

/* The 16-bit numbers of a Huffman-coded stream, [count] to out. False on damage. */
static bool huffman_unpack(const uint8_t *in, size_t n, uint16_t *out, size_t count)
{
    uint32_t first = n < HEAD ? SYMBOLS : exr_u32(in), last = n < HEAD ? 0 : exr_u32(in + 4);
    if (first > last || last >= SYMBOLS)
        return false;
    struct code *c = mem_alloc(1, sizeof *c);
    struct bit_reader bits = {.data = in + HEAD, .n = n - HEAD};
    bool ok = read_lengths(c, &bits, first, last) && build(c, first, last);
    skip_bits(&bits, bits.count % 8);
    ok = ok && decode_all(c, &bits, last, out, count);
    free(c);
    return ok;
}

/* --- blocks ------------------------------------------------------------------------------------------- */

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
              huffman_unpack(in + at + 4, exr_u32(in + at), number, size / 2);
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
