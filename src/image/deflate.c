/* deflate.c: packs zlib data, see zlib.h.
 *
 * Wherever the coming bytes occurred within the last 32 KiB, a (length, distance) pair stands for them
 * [Ziv & Lempel 1977]; earlier places are found through hash chains over three bytes. Bytes and pairs are written in
 * the codes that the format has fixed [RFC 1951 3.2.6]. Codes made for each picture would make it some 10 to 30 %
 * smaller, and this file twice as long.
 */
#include "image/zlib.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/bits.h"
#include "base/mem.h"

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

/* --- bits and codes ---------------------------------------------------------------------------------- */

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
    unsigned l = class_of(deflate_length_base, DEFLATE_LENGTHS, c.length);
    unsigned s = class_of(deflate_distance_base, DEFLATE_DISTANCES, c.distance);
    put_symbol(d, 257 + l);
    put(d, (unsigned)(c.length - deflate_length_base[l]), deflate_length_extra[l]);
    put_code(d, s, 5);
    put(d, (unsigned)(c.distance - deflate_distance_base[s]), deflate_distance_extra[s]);
}

/* --- finding copies ---------------------------------------------------------------------------------- */

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
    put_symbol(d, DEFLATE_END);
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
