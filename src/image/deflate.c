/* deflate.c: see deflate.h.
 *
 * Two steps, block by block [RFC 1951]. First the bytes become symbols: wherever the coming bytes occurred within
 * the last 32 KiB, a (length, distance) pair stands for them [Ziv and Lempel 1977]; earlier places are found
 * through hash chains over three bytes. Then the symbols are written in Huffman codes made for the block
 * [Huffman 1952].
 */
#include "image/deflate.h"

#include <assert.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "image/checksum.h"
#include "image/inflate.h"
#include "base/mem.h"

enum {
    WINDOW = 32768, /* farthest copy, and size of the chain arrays */
    HASH_SIZE = 32768,
    SHORTEST = 3, /* copies, in bytes */
    LONGEST = 258,
    NEAR = 4096, /* a copy of 3 bytes from farther away costs more than the bytes */
    CHAIN = 8,   /* places tried for one match */
    GOOD = 32,   /* a match this long is taken without looking for a better one one byte later */
    BLOCK_TOKENS = 32768
};

/* A literal byte (distance 0) or a copy. */
struct token {
    uint16_t value; /* the byte, or the length */
    uint16_t distance;
};

struct deflater {
    const uint8_t *in;
    size_t n;
    size_t hashed;             /* positions before this one are in the chains */
    uint32_t head[HASH_SIZE];  /* last position with this hash, plus 1; 0 for none */
    uint32_t previous[WINDOW]; /* by position modulo WINDOW: the one before it in its chain, plus 1 */
    struct token token[BLOCK_TOKENS];
    int n_tokens;
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

struct code {
    uint8_t length[INFLATE_LITERALS]; /* bits of each symbol's code, 0 for an unused symbol */
    uint16_t bits[INFLATE_LITERALS];  /* the code, first bit lowest */
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
    unsigned weight[2 * INFLATE_LITERALS];
    int parent[2 * INFLATE_LITERALS], level[2 * INFLATE_LITERALS];
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
static void assign_bits(struct code *c, int n)
{
    unsigned next = 0;
    for (unsigned length = 1; length <= INFLATE_MAX_BITS; length++) {
        for (int i = 0; i < n; i++) {
            if (c->length[i] != length)
                continue;
            unsigned reversed = 0;
            for (unsigned b = 0; b < length; b++)
                reversed |= (next >> b & 1) << (length - 1 - b);
            c->bits[i] = (uint16_t)reversed;
            next++;
        }
        next *= 2;
    }
}

/* The code for these frequencies with no length above `limit`. Where Huffman's tree is too deep, the frequencies
 * are flattened and the tree is built again: no longer optimal, but close, and rare. */
static void code_build(struct code *c, const unsigned *frequency, int n, int limit)
{
    memset(c, 0, sizeof *c);
    unsigned f[INFLATE_LITERALS];
    memcpy(f, frequency, (size_t)n * sizeof *f);
    int symbol[INFLATE_LITERALS], depth[INFLATE_LITERALS], used = sort_symbols(f, n, symbol);
    for (int i = 0; used < 2; i++) /* every code gets two symbols: then it has no unused bit patterns */
        if (f[i] == 0) {
            f[i] = 1;
            used = sort_symbols(f, n, symbol);
        }
    unsigned weight[INFLATE_LITERALS];
    for (int i = 0; i < used; i++)
        weight[i] = f[symbol[i]];
    while (tree_depths(weight, used, depth) > limit)
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
    unsigned low = 0, high = n; /* base[low] <= value < base[high] */
    while (high - low > 1) {
        unsigned middle = (low + high) / 2;
        if (base[middle] <= value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static unsigned length_class(unsigned length) { return class_of(inflate_length_base, INFLATE_LENGTHS, length); }
static unsigned distance_class(unsigned d) { return class_of(inflate_distance_base, INFLATE_DISTANCES, d); }

static void put_symbol(struct deflater *d, const struct code *c, unsigned symbol)
{
    put(d, c->bits[symbol], c->length[symbol]);
}

/* Code lengths as symbols of the meta alphabet: itself, or a run (16: the last again, 17 and 18: zeros). */
struct meta {
    uint8_t symbol, extra; /* extra: the run's length, less its least */
};

static int describe_lengths(const uint8_t *length, int n, struct meta *out)
{
    int used = 0;
    for (int i = 0; i < n;) {
        int run = 1;
        while (i + run < n && run < 138 && length[i + run] == length[i])
            run++;
        bool again = i > 0 && length[i] == length[i - 1];
        if (length[i] == 0 && run >= 3) {
            out[used].symbol = run > 10 ? 18 : 17;
            out[used++].extra = (uint8_t)(run - (run > 10 ? 11 : 3));
        } else if (again && run >= 3) {
            run = run > 6 ? 6 : run;
            out[used].symbol = 16;
            out[used++].extra = (uint8_t)(run - 3);
        } else {
            run = 1;
            out[used].symbol = length[i];
            out[used++].extra = 0;
        }
        i += run;
    }
    return used;
}

/* State both codes at the block's head [RFC 1951 3.2.7]. */
static void put_codes(struct deflater *d, const struct code *literal, const struct code *distance)
{
    enum { N_LITERALS = 286, N = N_LITERALS + INFLATE_DISTANCES };
    uint8_t length[N];
    struct meta meta[N];
    memcpy(length, literal->length, N_LITERALS);
    memcpy(length + N_LITERALS, distance->length, INFLATE_DISTANCES);
    int used = describe_lengths(length, N, meta);
    unsigned frequency[INFLATE_META] = {0};
    for (int i = 0; i < used; i++)
        frequency[meta[i].symbol]++;
    struct code code;
    code_build(&code, frequency, INFLATE_META, 7);
    unsigned n_meta = INFLATE_META;
    while (n_meta > 4 && code.length[inflate_meta_order[n_meta - 1]] == 0)
        n_meta--;
    put(d, N_LITERALS - 257, 5);
    put(d, INFLATE_DISTANCES - 1, 5);
    put(d, n_meta - 4, 4);
    for (unsigned i = 0; i < n_meta; i++)
        put(d, code.length[inflate_meta_order[i]], 3);
    static const uint8_t EXTRA[INFLATE_META] = {[16] = 2, [17] = 3, [18] = 7};
    for (int i = 0; i < used; i++) {
        put_symbol(d, &code, meta[i].symbol);
        put(d, meta[i].extra, EXTRA[meta[i].symbol]);
    }
}

static void put_token(struct deflater *d, struct token t, const struct code *literal, const struct code *distance)
{
    if (t.distance == 0) {
        put_symbol(d, literal, t.value);
        return;
    }
    unsigned l = length_class(t.value), s = distance_class(t.distance);
    put_symbol(d, literal, 257 + l);
    put(d, t.value - (unsigned)inflate_length_base[l], inflate_length_extra[l]);
    put_symbol(d, distance, s);
    put(d, t.distance - (unsigned)inflate_distance_base[s], inflate_distance_extra[s]);
}

static void put_block(struct deflater *d, bool last)
{
    unsigned literals[INFLATE_LITERALS] = {0}, distances[INFLATE_DISTANCES] = {0};
    literals[INFLATE_END] = 1;
    for (int i = 0; i < d->n_tokens; i++) {
        struct token t = d->token[i];
        if (t.distance == 0) {
            literals[t.value]++;
        } else {
            literals[257 + length_class(t.value)]++;
            distances[distance_class(t.distance)]++;
        }
    }
    struct code literal, distance;
    code_build(&literal, literals, 286, INFLATE_MAX_BITS);
    code_build(&distance, distances, INFLATE_DISTANCES, INFLATE_MAX_BITS);
    put(d, last, 1);
    put(d, 2, 2); /* codes are stated */
    put_codes(d, &literal, &distance);
    for (int i = 0; i < d->n_tokens; i++)
        put_token(d, d->token[i], &literal, &distance);
    put_symbol(d, &literal, INFLATE_END);
    d->n_tokens = 0;
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
static struct token find_copy(struct deflater *d, size_t at)
{
    struct token best = {0, 0};
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
    struct token none = {0, 0};
    return worth ? best : none;
}

static void put_in_block(struct deflater *d, struct token t)
{
    if (d->n_tokens == BLOCK_TOKENS)
        put_block(d, false);
    d->token[d->n_tokens++] = t;
}

/* Cut the input into tokens. A copy is put off by one byte when a longer one begins there. */
static void put_data(struct deflater *d)
{
    struct token copy = find_copy(d, 0);
    for (size_t at = 0; at < d->n;) {
        struct token next = {0, 0}, literal = {d->in[at], 0};
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
