/* deflate.c: packs zlib data, see zlib.h.
 *
 * Two steps, block by block [RFC 1951]. First the bytes become symbols: wherever the coming bytes occurred within
 * the last 32 KiB, a (length, distance) pair stands for them [Ziv & Lempel 1977]; earlier places are found
 * through hash chains over three bytes. Then the symbols are written in Huffman codes made for the block
 * [Huffman 1952]. (With the format's fixed codes instead, pictures would be 10 to 30 % larger.)
 */
#include "image/zlib.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"

enum {
    WINDOW = 32768, /* farthest copy, and size of the chain arrays */
    HASH_SIZE = 32768,
    SHORTEST = 3, /* copies, in bytes */
    LONGEST = 258,
    NEAR = 4096, /* a copy of 3 bytes from farther away costs more than the bytes */
    CHAIN = 8,   /* places tried for one match */
    GOOD = 32,   /* a match this long is taken without looking for a better one one byte later */
    BLOCK_PHRASES = 32768,
    STATED_LITERALS = 286 /* symbols of the literal code that a block may use */
};

/* A literal byte (distance 0) or a copy: what Ziv and Lempel call a phrase. */
struct phrase {
    uint16_t value; /* the byte, or the length */
    uint16_t distance;
};

struct deflater {
    const uint8_t *in;
    size_t n;
    size_t hashed;             /* positions before this one are in the chains */
    uint32_t head[HASH_SIZE];  /* last position with this hash, plus 1; 0 for none */
    uint32_t previous[WINDOW]; /* by position modulo WINDOW: the one before it in its chain, plus 1 */
    struct phrase phrase[BLOCK_PHRASES];
    int n_phrases;
    uint8_t *out;
    size_t size, capacity;
    uint64_t bits; /* bits not yet in out, the first one lowest */
    unsigned count;
};

/* --- bits -------------------------------------------------------------------------------------------- */

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

/* --- Huffman codes ----------------------------------------------------------------------------------- */

struct encoder {
    uint8_t length[DEFLATE_LITERALS]; /* bits of each symbol's code, 0 for an unused symbol */
    uint16_t bits[DEFLATE_LITERALS];  /* the code, first bit lowest */
};

/* Sort the symbols that occur by rising frequency; returns their number. */
static int sort_symbols(const unsigned *frequency, int n, int *symbol)
{
    int used = 0;
    for (int i = 0; i < n; i++) {
        if (frequency[i] == 0)
            continue;
        int place = used++;
        for (; place > 0 && frequency[symbol[place - 1]] > frequency[i]; place--)
            symbol[place] = symbol[place - 1];
        symbol[place] = i;
    }
    return used;
}

/* Huffman's algorithm over leaves sorted by weight: the two lightest nodes become one, until one is left. Inner
 * nodes arise in order of weight, so the lightest node is always the next leaf or the next inner node. Writes the
 * bits of each leaf to depth[used]; returns the greatest. */
static int tree_depths(const unsigned *weight_of_leaf, int used, int *depth)
{
    unsigned weight[2 * DEFLATE_LITERALS];
    int parent[2 * DEFLATE_LITERALS], level[2 * DEFLATE_LITERALS];
    memcpy(weight, weight_of_leaf, (size_t)used * sizeof *weight);
    int leaf = 0, inner = used, end = used;
    while (end < 2 * used - 1) {
        weight[end] = 0;
        for (int child = 0; child < 2; child++) {
            bool take_leaf = leaf < used && (inner == end || weight[leaf] <= weight[inner]);
            int lightest = take_leaf ? leaf++ : inner++;
            weight[end] += weight[lightest];
            parent[lightest] = end;
        }
        end++;
    }
    level[end - 1] = 0;
    for (int i = end - 2; i >= 0; i--)
        level[i] = level[parent[i]] + 1;
    memcpy(depth, level, (size_t)used * sizeof *depth);
    return level[0]; /* the lightest leaf lies deepest */
}

/* Number the codes: shorter ones first, equal lengths in order of the symbols [RFC 1951 3.2.2]. */
static void assign_bits(struct encoder *c, int n)
{
    unsigned next = 0;
    for (unsigned length = 1; length <= DEFLATE_MAX_BITS; length++) {
        for (int i = 0; i < n; i++)
            if (c->length[i] == length)
                c->bits[i] = (uint16_t)(reverse_bits(next++) >> (32 - length));
        next *= 2;
    }
}

/* The code for these frequencies. Where Huffman's tree is too deep, the frequencies are flattened and the tree is built
 * again: no longer optimal, but close, and rare. */
static void encoder_build(struct encoder *c, unsigned *f, int n)
{
    memset(c, 0, sizeof *c);
    int symbol[DEFLATE_LITERALS], depth[DEFLATE_LITERALS], used = sort_symbols(f, n, symbol);
    for (int i = 0; used < 2; i++) /* every code gets two symbols: then it has no unused bit patterns */
        if (f[i] == 0) {
            f[i] = 1;
            used = sort_symbols(f, n, symbol);
        }
    unsigned weight[DEFLATE_LITERALS];
    for (int i = 0; i < used; i++)
        weight[i] = f[symbol[i]];
    while (tree_depths(weight, used, depth) > DEFLATE_MAX_BITS)
        for (int i = 0; i < used; i++)
            weight[i] = weight[i] / 2 + 1;
    for (int i = 0; i < used; i++)
        c->length[symbol[i]] = (uint8_t)depth[i];
    assign_bits(c, n);
}

/* --- writing a block --------------------------------------------------------------------------------- */

/* The last of the ascending base values that is not above `value`. */
static unsigned class_of(const uint16_t *base, unsigned n, unsigned value)
{
    while (base[n - 1] > value)
        n--;
    return n - 1;
}

static unsigned length_class(unsigned length) { return class_of(deflate_length_base, DEFLATE_LENGTHS, length); }
static unsigned distance_class(unsigned d) { return class_of(deflate_distance_base, DEFLATE_DISTANCES, d); }

static void put_symbol(struct deflater *d, const struct encoder *c, unsigned symbol)
{
    put(d, c->bits[symbol], c->length[symbol]);
}

/* State both codes at the block's head [RFC 1951 3.2.7]. The lengths, 0 to 15, are written as they are, in a code that
 * gives each of them four bits; the symbols for repetitions would save a hundred bytes a block, and are not used. */
static void put_codes(struct deflater *d, const struct encoder *literal, const struct encoder *distance)
{
    put(d, STATED_LITERALS - 257, 5);
    put(d, DEFLATE_DISTANCES - 1, 5);
    put(d, DEFLATE_META - 4, 4);
    for (int i = 0; i < DEFLATE_META; i++)
        put(d, deflate_meta_order[i] <= DEFLATE_MAX_BITS ? 4 : 0, 3);
    for (int i = 0; i < STATED_LITERALS + DEFLATE_DISTANCES; i++) {
        uint32_t length = i < STATED_LITERALS ? literal->length[i] : distance->length[i - STATED_LITERALS];
        put(d, reverse_bits(length) >> 28, 4);
    }
}

static void put_phrase(struct deflater *d, struct phrase t, const struct encoder *literal,
                       const struct encoder *distance)
{
    if (t.distance == 0) {
        put_symbol(d, literal, t.value);
        return;
    }
    unsigned l = length_class(t.value), s = distance_class(t.distance);
    put_symbol(d, literal, 257 + l);
    put(d, t.value - (unsigned)deflate_length_base[l], deflate_length_extra[l]);
    put_symbol(d, distance, s);
    put(d, t.distance - (unsigned)deflate_distance_base[s], deflate_distance_extra[s]);
}

static void put_block(struct deflater *d, bool last)
{
    unsigned literals[DEFLATE_LITERALS] = {0}, distances[DEFLATE_DISTANCES] = {0};
    literals[DEFLATE_END] = 1;
    for (int i = 0; i < d->n_phrases; i++) {
        struct phrase t = d->phrase[i];
        if (t.distance == 0) {
            literals[t.value]++;
        } else {
            literals[257 + length_class(t.value)]++;
            distances[distance_class(t.distance)]++;
        }
    }
    struct encoder literal, distance;
    encoder_build(&literal, literals, STATED_LITERALS);
    encoder_build(&distance, distances, DEFLATE_DISTANCES);
    put(d, last, 1);
    put(d, 2, 2); /* codes are stated */
    put_codes(d, &literal, &distance);
    for (int i = 0; i < d->n_phrases; i++)
        put_phrase(d, d->phrase[i], &literal, &distance);
    put_symbol(d, &literal, DEFLATE_END);
    d->n_phrases = 0;
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
static struct phrase find_copy(struct deflater *d, size_t at)
{
    struct phrase best = {0, 0};
    if (at + SHORTEST > d->n)
        return best;
    hash_until(d, at);
    size_t limit = d->n - at < LONGEST ? d->n - at : LONGEST, place = d->head[hash3(d->in + at)];
    for (int tries = 0; tries < CHAIN && place != 0 && at - (place - 1) < WINDOW; tries++) {
        const uint8_t *candidate = d->in + (place - 1);
        if (candidate[best.value] == d->in[at + best.value]) { /* else it cannot be longer */
            size_t length = common_length(candidate, d->in + at, limit);
            if (length > best.value) {
                best.value = (uint16_t)length;
                best.distance = (uint16_t)(at - (place - 1));
            }
            if (length == limit)
                break;
        }
        place = d->previous[(place - 1) % WINDOW];
    }
    bool worth = best.value > SHORTEST || (best.value == SHORTEST && best.distance <= NEAR);
    struct phrase none = {0, 0};
    return worth ? best : none;
}

static void put_in_block(struct deflater *d, struct phrase t)
{
    if (d->n_phrases == BLOCK_PHRASES)
        put_block(d, false);
    d->phrase[d->n_phrases++] = t;
}

/* Cut the input into phrases. A copy is put off by one byte when a longer one begins there. */
static void put_data(struct deflater *d)
{
    struct phrase copy = find_copy(d, 0);
    for (size_t at = 0; at < d->n;) {
        struct phrase next = {0, 0}, literal = {d->in[at], 0};
        bool may_wait = copy.value < GOOD;
        if (may_wait)
            next = find_copy(d, at + 1);
        if (copy.value == 0 || (may_wait && next.value > copy.value)) {
            put_in_block(d, literal);
            at++;
            copy = next;
        } else {
            put_in_block(d, copy);
            at += copy.value;
            copy = find_copy(d, at);
        }
    }
    put_block(d, true);
}

uint8_t *deflate_zlib(const uint8_t *in, size_t n, size_t *size)
{
    assert(n < UINT32_MAX);
    struct deflater *d = mem_alloc(1, sizeof *d);
    d->in = in;
    d->n = n;
    put_byte(d, 0x78); /* deflate, window of 32 KiB */
    put_byte(d, 0x9c); /* default effort; makes the two bytes a multiple of 31 */
    put_data(d);
    put(d, 0, 7); /* up to the next byte */
    d->bits = 0;
    d->count = 0;
    uint32_t sum = checksum_adler32(in, n);
    for (int shift = 24; shift >= 0; shift -= 8)
        put_byte(d, sum >> shift & 255);
    uint8_t *out = d->out;
    *size = d->size;
    free(d);
    return out;
}
