/* inflate.c: unpacks zlib data, see zlib.h.
 *
 * A stream is a row of blocks: stored bytes, or symbols in Huffman codes that are either fixed or stated at the
 * block's head. A symbol is a byte to append, or a length, which with the distance after it says what to repeat of
 * the output so far. Codes are read most significant bit first, everything else least significant bit first.
 */
#include "image/zlib.h"

#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"

/* --- bits -------------------------------------------------------------------------------------------- */

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

/* The next `count` <= 16 bits as a number. */
static unsigned read_bits(struct bit_reader *in, unsigned count)
{
    if (in->count < count)
        refill(in);
    unsigned value = (unsigned)(in->bits & ((1u << count) - 1));
    skip_bits(in, count);
    return value;
}

/* --- Huffman codes ----------------------------------------------------------------------------------- */

enum { TABLE_SIZE = 1 << DEFLATE_MAX_BITS, INVALID = 0xffff };

/* Make the table of a code from the lengths of its symbols: by the next DEFLATE_MAX_BITS bits, symbol * 16 + length of
 * the code that they begin with, or 0. Shorter codes are smaller, those of one length consecutive numbers in the order
 * of their symbols. Returns false if the lengths make no prefix code. A code that leaves bit patterns unused is
 * accepted only with at most one symbol, as zlib does. */
static bool make_table(uint16_t *table, const uint8_t *length, unsigned n)
{
    unsigned used = 0, code = 0; /* the next code, filled up with zeros to DEFLATE_MAX_BITS */
    memset(table, 0, TABLE_SIZE * sizeof *table);
    for (unsigned bits = 1; bits <= DEFLATE_MAX_BITS; bits++)
        for (unsigned i = 0; i < n; i++) {
            if (length[i] != bits)
                continue;
            if (code == TABLE_SIZE)
                return false;
            unsigned at = reverse_bits(code) >> (32 - DEFLATE_MAX_BITS);
            for (; at < TABLE_SIZE; at += 1u << bits) /* whatever bits follow */
                table[at] = (uint16_t)(i * 16 + bits);
            code += 1u << (DEFLATE_MAX_BITS - bits);
            used++;
        }
    return code == TABLE_SIZE || used <= 1;
}

/* The next symbol; INVALID if the bits are no code. */
static unsigned decode(const uint16_t *table, struct bit_reader *in)
{
    if (in->count < DEFLATE_MAX_BITS)
        refill(in);
    unsigned entry = table[in->bits & (TABLE_SIZE - 1)];
    skip_bits(in, entry & 15);
    return entry != 0 ? entry >> 4 : INVALID;
}

/* --- blocks: all functions return false where the data are damaged ----------------------------------- */

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
    uint8_t length[DEFLATE_LITERALS];
    for (int i = 0; i < DEFLATE_LITERALS; i++)
        length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    make_table(z->literal, length, DEFLATE_LITERALS);
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
    uint8_t meta[DEFLATE_META] = {0}, length[286 + DEFLATE_DISTANCES];
    for (unsigned i = 0; i < n; i++)
        meta[deflate_meta_order[i]] = (uint8_t)read_bits(&z->in, 3);
    /* the distances' table has room for the meta code until theirs is known */
    return literals <= 286 && distances <= DEFLATE_DISTANCES && make_table(z->distance, meta, DEFLATE_META) &&
           read_lengths(&z->in, z->distance, length, literals + distances) && length[DEFLATE_END] != 0 &&
           make_table(z->literal, length, literals) && make_table(z->distance, length + literals, distances);
}

/* Repeat `length` bytes from `distance` before the end of the output; the two may overlap. */
static bool repeat_bytes(struct inflater *z, size_t length, size_t distance)
{
    if (distance > z->done || length > z->size - z->done)
        return false;
    uint8_t *to = z->out + z->done;
    for (size_t i = 0; i < length; i++)
        to[i] = to[i - distance];
    z->done += length;
    return true;
}

static bool coded_block(struct inflater *z)
{
    for (;;) {
        unsigned symbol = decode(z->literal, &z->in);
        if (symbol == DEFLATE_END)
            return true;
        if (symbol < DEFLATE_END) {
            if (z->done == z->size)
                return false;
            z->out[z->done++] = (uint8_t)symbol;
            continue;
        }
        symbol -= DEFLATE_END + 1;
        if (symbol >= DEFLATE_LENGTHS)
            return false;
        size_t length = deflate_length_base[symbol] + (size_t)read_bits(&z->in, deflate_length_extra[symbol]);
        symbol = decode(z->distance, &z->in);
        if (symbol >= DEFLATE_DISTANCES)
            return false;
        size_t distance = deflate_distance_base[symbol] + (size_t)read_bits(&z->in, deflate_distance_extra[symbol]);
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
