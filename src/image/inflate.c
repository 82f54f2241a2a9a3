/* inflate.c: unpacks zlib data, see zlib.h.
 *
 * A stream is a row of blocks: stored bytes, or symbols in Huffman codes that are either fixed or stated at the
 * block's head. A symbol is a byte to append, or a length, which with the distance after it says what to repeat of
 * the output so far. Codes are read most significant bit first, everything else least significant bit first.
 */
#include "image/zlib.h"

#include <string.h>

#include "base/bits.h"

/* --- bits -------------------------------------------------------------------------------------------- */

struct bit_reader {
    const uint8_t *data;
    size_t n, next; /* bytes, and how many of them are in `bits` or used */
    uint64_t bits;  /* bits read ahead, the next one lowest; zero above `count` */
    unsigned count; /* number of them */
    bool exhausted; /* more bits were taken than there are */
};

/* Read ahead: afterwards at least 56 bits are there, unless the data end. */
static void refill(struct bit_reader *in)
{
    while (in->count <= 56 && in->next < in->n) {
        in->bits |= (uint64_t)in->data[in->next++] << in->count;
        in->count += 8;
    }
}

static void skip_bits(struct bit_reader *in, unsigned count)
{
    if (count > in->count) {
        in->exhausted = true;
        count = in->count;
    }
    in->bits >>= count;
    in->count -= count;
}

/* The next `count` <= 16 bits as a number; what is missing at the end of the data reads as zeros. */
static unsigned read_bits(struct bit_reader *in, unsigned count)
{
    if (in->count < count)
        refill(in);
    unsigned value = (unsigned)(in->bits & ((1u << count) - 1));
    skip_bits(in, count);
    return value;
}

/* --- Huffman codes ----------------------------------------------------------------------------------- */

enum { FAST_BITS = 10, INVALID = 0xffff };

/* A canonical code: codes of one length are consecutive numbers in the order of their symbols. */
struct decoder {
    uint16_t fast[1 << FAST_BITS];        /* by the next bits: symbol * 16 + length, 0 if the code is longer */
    uint16_t count[DEFLATE_MAX_BITS + 1]; /* number of codes of each length */
    uint16_t symbol[DEFLATE_LITERALS];    /* symbols in the order of their codes */
};

/* Build a code from the lengths of its symbols. Returns false if the lengths make no prefix code. A code that
 * leaves bit patterns unused is accepted only with at most one symbol, as zlib does. */
static bool code_build(struct decoder *c, const uint8_t *length, unsigned n)
{
    memset(c, 0, sizeof *c);
    for (unsigned i = 0; i < n; i++)
        c->count[length[i]]++;
    bool single = n - c->count[0] <= 1;
    c->count[0] = 0;
    unsigned first[DEFLATE_MAX_BITS + 2], offset[DEFLATE_MAX_BITS + 2]; /* first code and its place in symbol[] */
    first[1] = offset[1] = 0;
    for (unsigned bits = 1; bits <= DEFLATE_MAX_BITS; bits++) {
        unsigned end = first[bits] + c->count[bits];
        if (end > 1u << bits)
            return false;
        first[bits + 1] = end * 2;
        offset[bits + 1] = offset[bits] + c->count[bits];
    }
    if (first[DEFLATE_MAX_BITS + 1] != 1u << (DEFLATE_MAX_BITS + 1) && !single)
        return false;
    for (unsigned i = 0; i < n; i++) {
        unsigned bits = length[i];
        if (bits == 0)
            continue;
        c->symbol[offset[bits]++] = (uint16_t)i;
        unsigned code = reverse_bits(first[bits]++) >> (32 - bits);
        for (; bits <= FAST_BITS && code < 1 << FAST_BITS; code += 1u << bits)
            c->fast[code] = (uint16_t)(i * 16 + bits);
    }
    return true;
}

/* The symbol of a code longer than FAST_BITS, bit by bit; INVALID if there is none. */
static unsigned decode_slowly(const struct decoder *c, struct bit_reader *in)
{
    unsigned code = 0, first = 0, place = 0;
    for (unsigned bits = 1; bits <= DEFLATE_MAX_BITS; bits++) {
        code |= (unsigned)(in->bits >> (bits - 1)) & 1;
        if (code < first + c->count[bits]) {
            skip_bits(in, bits);
            return c->symbol[place + code - first];
        }
        place += c->count[bits];
        first = (first + c->count[bits]) * 2;
        code *= 2;
    }
    return INVALID;
}

static unsigned decode(const struct decoder *c, struct bit_reader *in)
{
    if (in->count < DEFLATE_MAX_BITS)
        refill(in);
    unsigned entry = c->fast[in->bits & ((1 << FAST_BITS) - 1)];
    if (entry == 0)
        return decode_slowly(c, in);
    skip_bits(in, entry & 15);
    return entry >> 4;
}

/* --- blocks ------------------------------------------------------------------------------------------ */

struct inflater {
    struct bit_reader in;
    uint8_t *out;
    size_t size, done; /* bytes of out, and how many are written */
    struct decoder literal, distance;
    struct error *err;
};

static bool truncated(struct inflater *z) { return error_set(z->err, "compressed data are truncated"); }
static bool too_long(struct inflater *z)
{
    return error_set(z->err, "compressed data hold more than the header says");
}

static bool stored_block(struct inflater *z)
{
    skip_bits(&z->in, z->in.count % 8);
    unsigned length = read_bits(&z->in, 16), complement = read_bits(&z->in, 16);
    if (z->in.exhausted)
        return truncated(z);
    if ((length ^ complement) != 0xffff)
        return error_set(z->err, "compressed data are damaged: a stored block's length contradicts itself");
    z->in.next -= z->in.count / 8; /* give back what was read ahead */
    z->in.bits = 0;
    z->in.count = 0;
    if (length > z->in.n - z->in.next)
        return truncated(z);
    if (length > z->size - z->done)
        return too_long(z);
    memcpy(z->out + z->done, z->in.data + z->in.next, length);
    z->in.next += length;
    z->done += length;
    return true;
}

static void fixed_codes(struct inflater *z)
{
    uint8_t length[DEFLATE_LITERALS];
    for (int i = 0; i < DEFLATE_LITERALS; i++)
        length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    code_build(&z->literal, length, DEFLATE_LITERALS);
    memset(length, 5, 32);
    code_build(&z->distance, length, 32);
}

/* Read `n` code lengths that are themselves coded: 0..15 a length, 16 a repetition of the last, 17 and 18 zeros. */
static bool read_lengths(struct inflater *z, const struct decoder *meta, uint8_t *length, unsigned n)
{
    for (unsigned i = 0; i < n;) {
        unsigned symbol = decode(meta, &z->in), repeat = 1, value = 0;
        if (z->in.exhausted)
            return truncated(z);
        if (symbol < 16) {
            value = symbol;
        } else if (symbol == 16 && i > 0) {
            value = length[i - 1];
            repeat = 3 + read_bits(&z->in, 2);
        } else if (symbol == 17) {
            repeat = 3 + read_bits(&z->in, 3);
        } else if (symbol == 18) {
            repeat = 11 + read_bits(&z->in, 7);
        } else {
            return error_set(z->err, "compressed data are damaged: no such code length");
        }
        if (repeat > n - i)
            return error_set(z->err, "compressed data are damaged: too many code lengths");
        memset(length + i, (int)value, repeat);
        i += repeat;
    }
    return true;
}

static bool stated_codes(struct inflater *z)
{
    unsigned n_literals = 257 + read_bits(&z->in, 5), n_distances = 1 + read_bits(&z->in, 5);
    unsigned n_meta = 4 + read_bits(&z->in, 4);
    if (n_literals > 286 || n_distances > DEFLATE_DISTANCES)
        return error_set(z->err, "compressed data are damaged: too many codes");
    uint8_t length[286 + DEFLATE_DISTANCES] = {0};
    for (unsigned i = 0; i < n_meta; i++)
        length[deflate_meta_order[i]] = (uint8_t)read_bits(&z->in, 3);
    struct decoder *meta = &z->distance; /* its room is free until the distance code is known */
    if (!code_build(meta, length, DEFLATE_META))
        return error_set(z->err, "compressed data are damaged: impossible code lengths");
    if (!read_lengths(z, meta, length, n_literals + n_distances))
        return false;
    if (length[DEFLATE_END] == 0)
        return error_set(z->err, "compressed data are damaged: a block has no end");
    if (!code_build(&z->literal, length, n_literals) || !code_build(&z->distance, length + n_literals, n_distances))
        return error_set(z->err, "compressed data are damaged: impossible code lengths");
    return true;
}

/* Repeat `length` bytes from `distance` before the end of the output; the two may overlap. */
static bool repeat_bytes(struct inflater *z, size_t length, size_t distance)
{
    if (distance > z->done)
        return error_set(z->err, "compressed data are damaged: a copy from before the beginning");
    if (length > z->size - z->done)
        return too_long(z);
    uint8_t *to = z->out + z->done;
    const uint8_t *from = to - distance;
    z->done += length;
    if (distance >= length) {
        memcpy(to, from, length);
        return true;
    }
    for (size_t i = 0; i < length; i++)
        to[i] = from[i];
    return true;
}

static bool coded_block(struct inflater *z)
{
    for (;;) {
        unsigned symbol = decode(&z->literal, &z->in);
        if (z->in.exhausted)
            return truncated(z);
        if (symbol < DEFLATE_END) {
            if (z->done == z->size)
                return too_long(z);
            z->out[z->done++] = (uint8_t)symbol;
            continue;
        }
        if (symbol == DEFLATE_END)
            return true;
        symbol -= DEFLATE_END + 1;
        if (symbol >= DEFLATE_LENGTHS)
            return error_set(z->err, "compressed data are damaged: no such length");
        size_t length = deflate_length_base[symbol] + (size_t)read_bits(&z->in, deflate_length_extra[symbol]);
        symbol = decode(&z->distance, &z->in);
        if (symbol >= DEFLATE_DISTANCES)
            return z->in.exhausted ? truncated(z)
                                   : error_set(z->err, "compressed data are damaged: no such distance");
        size_t distance = deflate_distance_base[symbol] + (size_t)read_bits(&z->in, deflate_distance_extra[symbol]);
        if (z->in.exhausted)
            return truncated(z);
        if (!repeat_bytes(z, length, distance))
            return false;
    }
}

static bool read_block(struct inflater *z, bool *last)
{
    *last = read_bits(&z->in, 1) == 1;
    unsigned kind = read_bits(&z->in, 2);
    if (z->in.exhausted)
        return truncated(z);
    if (kind == 0)
        return stored_block(z);
    if (kind == 3)
        return error_set(z->err, "compressed data are damaged: no such block");
    if (kind == 1)
        fixed_codes(z);
    else if (!stated_codes(z))
        return false;
    return coded_block(z);
}

bool inflate_zlib(const uint8_t *in, size_t n, uint8_t *out, size_t out_size, struct error *err)
{
    struct inflater z = {.in = {in, n, 0, 0, 0, false}, .out = out, .size = out_size, .err = err};
    unsigned method = read_bits(&z.in, 8), flags = read_bits(&z.in, 8);
    if (z.in.exhausted)
        return truncated(&z);
    if ((method & 15) != 8 || method >> 4 > 7 || (method * 256 + flags) % 31 != 0 || (flags & 32) != 0)
        return error_set(err, "compressed data have no valid zlib header");
    for (bool last = false; !last;)
        if (!read_block(&z, &last))
            return false;
    if (z.done != out_size)
        return error_set(err, "compressed data hold less than the header says");
    skip_bits(&z.in, z.in.count % 8);
    uint32_t sum = 0;
    for (int i = 0; i < 4; i++)
        sum = sum << 8 | read_bits(&z.in, 8);
    if (z.in.exhausted)
        return truncated(&z);
    if (sum != checksum_adler32(out, out_size))
        return error_set(err, "compressed data are damaged: wrong checksum");
    return true;
}
