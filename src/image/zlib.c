/* zlib.c: see zlib.h.
 *
 * A stream is a row of blocks: stored bytes, or symbols in Huffman codes that are either fixed or stated at the
 * block's head. A symbol is a byte to append, or a length, which with the distance after it says what to repeat of
 * the output so far. Codes are read most significant bit first, everything else least significant bit first. */
#include "image/zlib.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"

/* The alphabets [RFC 1951 3.2.5] [RFC 1951 3.2.7]. */
enum {
    LITERALS = 288, /* literal bytes 0..255, end of block 256, lengths 257..285, two unused */
    DISTANCES = 30,
    LENGTHS = 29,
    END = 256,    /* the symbol that ends a block */
    META = 19,    /* symbols that describe code lengths */
    MAX_BITS = 15 /* longest code */
};

/* The shortest copy of a symbol of lengths, the bits that follow it; the same of distances; the order in which a block
 * states the lengths of meta codes. */
static const uint16_t LENGTH_BASE[LENGTHS] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                              31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
static const uint8_t LENGTH_EXTRA[LENGTHS] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                              2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
static const uint16_t DISTANCE_BASE[DISTANCES] = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
static const uint8_t DISTANCE_EXTRA[DISTANCES] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                  6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};
static const uint8_t META_ORDER[META] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

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

/* --- unpacking --------------------------------------------------------------------------------------- */

struct bit_reader {
    const uint8_t *data;
    size_t n, next; /* bytes, and how many of them are in `bits` or used */
    uint64_t bits;  /* bits read ahead, the next one lowest; zero above `count` */
    unsigned count; /* number of them */
    bool exhausted; /* more bits were taken than there are: these are zeros */
};

/* Read ahead: afterwards at least 56 bits are there, unless the data end. */
static void refill(struct bit_reader *in)
{
    for (; in->count <= 56 && in->next < in->n; in->count += 8)
        in->bits |= (uint64_t)in->data[in->next++] << in->count;
}

static void skip_bits(struct bit_reader *in, unsigned count)
{
    in->exhausted |= count > in->count;
    count = count < in->count ? count : in->count;
    in->bits >>= count;
    in->count -= count;
}

/* The next `count` <= 16 bits as a number. */
static unsigned read_bits(struct bit_reader *in, unsigned count)
{
    if (in->count < count)
        refill(in);
    unsigned value = (unsigned)(in->bits & ((1u << count) - 1));
    skip_bits(in, count);
    return value;
}

enum { TABLE_SIZE = 1 << MAX_BITS, INVALID = 0xffff };

/* Make the table of a code from the lengths of its symbols: by the next MAX_BITS bits, symbol * 16 + length of
 * the code that they begin with, or 0. Shorter codes are smaller, those of one length consecutive numbers in the order
 * of their symbols. Returns false if the lengths make no prefix code. A code that leaves bit patterns unused is
 * accepted only with at most one symbol, as zlib does. */
static bool make_table(uint16_t *table, const uint8_t *length, unsigned n)
{
    unsigned used = 0, code = 0; /* the next code, filled up with zeros to MAX_BITS */
    memset(table, 0, TABLE_SIZE * sizeof *table);
    for (unsigned bits = 1; bits <= MAX_BITS; bits++)
        for (unsigned i = 0; i < n; i++) {
            if (length[i] != bits)
                continue;
            if (code == TABLE_SIZE)
                return false;
            unsigned at = reverse_bits(code) >> (32 - MAX_BITS);
            for (; at < TABLE_SIZE; at += 1u << bits) /* whatever bits follow */
                table[at] = (uint16_t)(i * 16 + bits);
            code += 1u << (MAX_BITS - bits);
            used++;
        }
    return code == TABLE_SIZE || used <= 1;
}

/* The next symbol; INVALID if the bits are no code. */
static unsigned decode(const uint16_t *table, struct bit_reader *in)
{
    if (in->count < MAX_BITS)
        refill(in);
    unsigned entry = table[in->bits & (TABLE_SIZE - 1)];
    skip_bits(in, entry & 15);
    return entry != 0 ? entry >> 4 : INVALID;
}

/* All of the following return false where the data are damaged. */
struct inflater {
    struct bit_reader in;
    uint8_t *out;
    size_t size, done; /* bytes of out, and how many are written */
    uint16_t literal[TABLE_SIZE], distance[TABLE_SIZE];
};

static bool stored_block(struct inflater *z)
{
    struct bit_reader *in = &z->in;
    skip_bits(in, in->count % 8);
    unsigned length = read_bits(in, 16), complement = read_bits(in, 16);
    in->next -= in->count / 8; /* give back what was read ahead */
    in->bits = 0;
    in->count = 0;
    if ((length ^ complement) != 0xffff || length > in->n - in->next || length > z->size - z->done)
        return false;
    memcpy(z->out + z->done, in->data + in->next, length);
    in->next += length;
    z->done += length;
    return true;
}

static void fixed_codes(struct inflater *z)
{
    uint8_t length[LITERALS];
    for (int i = 0; i < LITERALS; i++)
        length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    make_table(z->literal, length, LITERALS);
    memset(length, 5, 32);
    make_table(z->distance, length, 32);
}

/* Read `n` code lengths that are themselves coded: 0..15 a length, 16 a repetition of the last, 17 and 18 zeros. */
static bool read_lengths(struct bit_reader *in, const uint16_t *meta, uint8_t *length, unsigned n)
{
    for (unsigned i = 0; i < n;) {
        unsigned symbol = decode(meta, in), repeat = 1, value = symbol < 16 ? symbol : 0;
        if (symbol == INVALID || (symbol == 16 && i == 0))
            return false;
        if (symbol == 16) {
            value = length[i - 1];
            repeat = 3 + read_bits(in, 2);
        } else if (symbol == 17) {
            repeat = 3 + read_bits(in, 3);
        } else if (symbol == 18) {
            repeat = 11 + read_bits(in, 7);
        }
        if (repeat > n - i)
            return false;
        memset(length + i, (int)value, repeat);
        i += repeat;
    }
    return true;
}

static bool stated_codes(struct inflater *z)
{
    unsigned literals = 257 + read_bits(&z->in, 5), distances = 1 + read_bits(&z->in, 5), n = 4 + read_bits(&z->in, 4);
    uint8_t meta[META] = {0}, length[286 + DISTANCES];
    for (unsigned i = 0; i < n; i++)
        meta[META_ORDER[i]] = (uint8_t)read_bits(&z->in, 3);
    /* the distances' table has room for the meta code until theirs is known */
    return literals <= 286 && distances <= DISTANCES && make_table(z->distance, meta, META) &&
           read_lengths(&z->in, z->distance, length, literals + distances) && length[END] != 0 &&
           make_table(z->literal, length, literals) && make_table(z->distance, length + literals, distances);
}

/* Repeat `length` bytes from `distance` before the end of the output; the two may overlap. */
static bool repeat_bytes(struct inflater *z, size_t length, size_t distance)
{
    if (distance > z->done || length > z->size - z->done)
        return false;
    uint8_t *to = z->out + z->done;
    for (size_t i = 0; i < length; i++)
        to[i] = z->out[z->done - distance + i];
    z->done += length;
    return true;
}

static bool coded_block(struct inflater *z)
{
    for (;;) {
        unsigned symbol = decode(z->literal, &z->in);
        if (symbol == END)
            return true;
        if (symbol < END) {
            if (z->done == z->size)
                return false;
            z->out[z->done++] = (uint8_t)symbol;
            continue;
        }
        symbol -= END + 1;
        if (symbol >= LENGTHS)
            return false;
        size_t length = LENGTH_BASE[symbol] + (size_t)read_bits(&z->in, LENGTH_EXTRA[symbol]);
        symbol = decode(z->distance, &z->in);
        if (symbol >= DISTANCES)
            return false;
        size_t distance = DISTANCE_BASE[symbol] + (size_t)read_bits(&z->in, DISTANCE_EXTRA[symbol]);
        if (!repeat_bytes(z, length, distance))
            return false;
    }
}

static bool read_block(struct inflater *z, bool *last)
{
    *last = read_bits(&z->in, 1) == 1;
    unsigned kind = read_bits(&z->in, 2);
    if (kind == 0)
        return stored_block(z);
    if (kind == 1)
        fixed_codes(z);
    return (kind == 1 || (kind == 2 && stated_codes(z))) && coded_block(z) && !z->in.exhausted;
}

static bool read_stream(struct inflater *z)
{
    unsigned method = read_bits(&z->in, 8), flags = read_bits(&z->in, 8);
    if ((method & 15) != 8 || method >> 4 > 7 || (method * 256 + flags) % 31 != 0 || (flags & 32) != 0)
        return false;
    for (bool last = false; !last;)
        if (!read_block(z, &last))
            return false;
    skip_bits(&z->in, z->in.count % 8);
    uint32_t sum = 0;
    for (int i = 0; i < 4; i++)
        sum = sum << 8 | read_bits(&z->in, 8);
    return !z->in.exhausted && z->done == z->size && sum == checksum_adler32(z->out, z->size);
}

bool inflate_zlib(const uint8_t *in, size_t n, uint8_t *out, size_t out_size, struct error *err)
{
    struct inflater *z = mem_alloc(1, sizeof *z);
    z->in.data = in;
    z->in.n = n;
    z->out = out;
    z->size = out_size;
    bool ok = read_stream(z);
    free(z);
    return ok || error_set(err, "compressed data are damaged or truncated");
}

/* --- packing: wherever the coming bytes occurred within the last 32 KiB, a (length, distance) pair stands for them
 * [Ziv & Lempel 1977]; earlier places are found through hash chains over three bytes. Bytes and pairs are written in
 * the codes that the format has fixed [RFC 1951 3.2.6]. Codes made for each picture would make it some 10 to 30 %
 * smaller, and this part twice as long ----------------------------------------------------------------- */

enum {
    WINDOW = 32768, /* farthest copy, and size of the chain arrays */
    HASH_SIZE = 32768,
    SHORTEST = 3, /* copies, in bytes */
    LONGEST = 258,
    NEAR = 4096, /* a copy of 3 bytes from farther away costs more than the bytes */
    CHAIN = 8    /* places tried for one match */
};

/* Bytes that occurred before; length 0: none. */
struct copy {
    size_t length, distance;
};

struct deflater {
    const uint8_t *in;
    size_t n;
    size_t hashed;             /* positions before this one are in the chains */
    uint32_t head[HASH_SIZE];  /* last position with this hash, plus 1; 0 for none */
    uint32_t previous[WINDOW]; /* by position modulo WINDOW: the one before it in its chain, plus 1 */
    uint8_t *out;
    size_t size, capacity;
    uint64_t bits; /* bits not yet in out, the first one lowest */
    unsigned count;
};

static void put_byte(struct deflater *d, unsigned byte)
{
    d->out = mem_grow(d->out, &d->capacity, d->size + 1, 1);
    d->out[d->size++] = (uint8_t)byte;
}

/* Append the lowest `count` <= 16 bits of `value`, which has no others. */
static void put(struct deflater *d, unsigned value, unsigned count)
{
    d->bits |= (uint64_t)value << d->count;
    d->count += count;
    for (; d->count >= 8; d->count -= 8, d->bits >>= 8)
        put_byte(d, (unsigned)(d->bits & 255));
}

/* A code, whose first bit is its highest. */
static void put_code(struct deflater *d, unsigned code, unsigned count)
{
    put(d, reverse_bits(code) >> (32 - count), count);
}

static void put_symbol(struct deflater *d, unsigned symbol)
{
    if (symbol < 144)
        put_code(d, 0x30 + symbol, 8);
    else if (symbol < 256)
        put_code(d, 0x190 + symbol - 144, 9);
    else if (symbol < 280)
        put_code(d, symbol - 256, 7);
    else
        put_code(d, 0xc0 + symbol - 280, 8);
}

/* The last of the ascending base values that is not above `value`. */
static unsigned class_of(const uint16_t *base, unsigned n, size_t value)
{
    while (base[n - 1] > value)
        n--;
    return n - 1;
}

static void put_copy(struct deflater *d, struct copy c)
{
    unsigned l = class_of(LENGTH_BASE, LENGTHS, c.length);
    unsigned s = class_of(DISTANCE_BASE, DISTANCES, c.distance);
    put_symbol(d, 257 + l);
    put(d, (unsigned)(c.length - LENGTH_BASE[l]), LENGTH_EXTRA[l]);
    put_code(d, s, 5);
    put(d, (unsigned)(c.distance - DISTANCE_BASE[s]), DISTANCE_EXTRA[s]);
}

static unsigned hash3(const uint8_t *p)
{
    uint32_t three = (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
    return three * 2654435761u >> 17;
}

/* Enter all positions before `end` into the chains. */
static void hash_until(struct deflater *d, size_t end)
{
    for (; d->hashed < end && d->hashed + SHORTEST <= d->n; d->hashed++) {
        uint32_t *head = &d->head[hash3(d->in + d->hashed)];
        d->previous[d->hashed % WINDOW] = *head;
        *head = (uint32_t)(d->hashed + 1);
    }
}

static size_t common_length(const uint8_t *a, const uint8_t *b, size_t limit)
{
    size_t length = 0;
    while (length < limit && a[length] == b[length])
        length++;
    return length;
}

/* The longest copy for the bytes at `at`, the nearest of equals; length 0 if none is worth it. */
static struct copy find_copy(struct deflater *d, size_t at)
{
    struct copy best = {0, 0}, none = {0, 0};
    if (at + SHORTEST > d->n)
        return best;
    hash_until(d, at);
    size_t limit = d->n - at < LONGEST ? d->n - at : LONGEST, place = d->head[hash3(d->in + at)];
    for (int tries = 0; tries < CHAIN && place != 0 && at - (place - 1) < WINDOW; tries++) {
        const uint8_t *candidate = d->in + (place - 1);
        if (candidate[best.length] == d->in[at + best.length]) { /* else it cannot be longer */
            size_t length = common_length(candidate, d->in + at, limit);
            if (length > best.length) {
                best.length = length;
                best.distance = at - (place - 1);
            }
            if (length == limit)
                break;
        }
        place = d->previous[(place - 1) % WINDOW];
    }
    bool worth = best.length > SHORTEST || (best.length == SHORTEST && best.distance <= NEAR);
    return worth ? best : none;
}

uint8_t *deflate_zlib(const uint8_t *in, size_t n, size_t *size)
{
    assert(n < UINT32_MAX);
    struct deflater *d = mem_alloc(1, sizeof *d);
    d->in = in;
    d->n = n;
    put_byte(d, 0x78); /* deflate, window of 32 KiB */
    put_byte(d, 0x9c); /* default effort; makes the two bytes a multiple of 31 */
    put(d, 1, 1);      /* the last block, */
    put(d, 1, 2);      /* in fixed codes */
    for (size_t at = 0; at < n;) {
        struct copy copy = find_copy(d, at);
        if (copy.length > 0)
            put_copy(d, copy);
        else
            put_symbol(d, in[at]);
        at += copy.length > 0 ? copy.length : 1;
    }
    put_symbol(d, END);
    put(d, 0, 7); /* up to the next byte */
    d->count = 0;
    uint32_t sum = checksum_adler32(in, n);
    for (int shift = 24; shift >= 0; shift -= 8)
        put_byte(d, sum >> shift & 255);
    uint8_t *out = d->out;
    *size = d->size;
    free(d);
    return out;
}
