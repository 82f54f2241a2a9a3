/* tga.c: TGA files, see image.h. [TGA] */
#include <stdlib.h>

#include "base/bits.h"
#include "base/mem.h"
#include "image/image.h"

enum tga_kind { TGA_MAPPED = 1, TGA_COLOUR = 2, TGA_GREY = 3 };
enum { HEADER = 18, RUN_LENGTH = 8, RIGHT_TO_LEFT = 0x10, TOP_TO_BOTTOM = 0x20, INTERLEAVED = 0xc0 };

struct tga {
    const uint8_t *data;
    size_t size, at; /* bytes, and how many are read */
    enum tga_kind kind;
    bool run_length;
    size_t width, height, depth; /* depth: bytes of a pixel as stored */
    bool flip_x, flip_y;
    const uint8_t *map; /* colours, from index map_first */
    size_t map_first, map_length, map_depth;
};

static size_t u16(const uint8_t *p) { return (size_t)bits_of_bytes(p, 2, false); }
static bool of_bytes(unsigned bits) { return bits == 24 || bits == 32; }

/* The header, the picture's name and the colour map. */
static bool read_header(struct tga *t, struct error *err)
{
    const uint8_t *d = t->data;
    if (t->size < HEADER)
        return error_set(err, "the file is truncated in its TGA header");
    unsigned type = d[2] & ~(unsigned)RUN_LENGTH;
    bool known = (type == TGA_COLOUR && of_bytes(d[16])) || (type == TGA_GREY && d[16] == 8) ||
                 (type == TGA_MAPPED && d[16] == 8 && d[1] == 1 && of_bytes(d[7]));
    if (!known || d[1] > 1 || (d[17] & INTERLEAVED) != 0)
        return error_set(err, "this kind of TGA file (type %u, %u bits, %u in its map) is not read; convert to 24 bits",
                         (unsigned)d[2], (unsigned)d[16], (unsigned)d[7]);
    t->kind = (enum tga_kind)type;
    t->run_length = (d[2] & RUN_LENGTH) != 0;
    t->depth = d[16] / 8u;
    t->width = u16(d + 12);
    t->height = u16(d + 14);
    t->flip_x = (d[17] & RIGHT_TO_LEFT) != 0;
    t->flip_y = (d[17] & TOP_TO_BOTTOM) == 0;
    t->map_first = u16(d + 3);
    t->map_length = d[1] == 1 ? u16(d + 5) : 0;
    t->map_depth = (d[7] + 7u) / 8;
    t->at = HEADER + (size_t)d[0] + t->map_length * t->map_depth;
    if (t->at > t->size)
        return error_set(err, "the file is truncated in its TGA header");
    t->map = d + HEADER + d[0];
    return picture_size_ok(t->width, t->height, err);
}

/* Put one stored pixel at its place, number `i` in the order of the file. */
static bool put_pixel(const struct tga *t, struct image *out, size_t i, const uint8_t *p)
{
    size_t x = i % t->width, y = i / t->width;
    x = t->flip_x ? t->width - 1 - x : x;
    y = t->flip_y ? t->height - 1 - y : y;
    uint8_t *to = out->u8 + (y * t->width + x) * (size_t)out->channels;
    if (t->kind == TGA_GREY) {
        to[0] = p[0];
        return true;
    }
    if (t->kind == TGA_MAPPED) {
        if (p[0] < t->map_first || p[0] - t->map_first >= t->map_length)
            return false;
        p = t->map + (p[0] - t->map_first) * t->map_depth;
    }
    to[0] = p[2];
    to[1] = p[1];
    to[2] = p[0];
    return true;
}

/* One packet: a count, then one pixel for all of them or each its own. Files without run-length coding are one long
 * packet. False if the file is damaged. */
static bool read_packet(struct tga *t, struct image *out, size_t *done, size_t count, bool same)
{
    size_t stored = same ? 1 : count;
    if (stored > (t->size - t->at) / t->depth || count > t->width * t->height - *done)
        return false;
    for (size_t i = 0; i < count; i++)
        if (!put_pixel(t, out, (*done)++, t->data + t->at + (same ? 0 : i) * t->depth))
            return false;
    t->at += stored * t->depth;
    return true;
}

static bool read_pixels(struct tga *t, struct image *out)
{
    size_t pixels = t->width * t->height, done = 0;
    if (!t->run_length)
        return read_packet(t, out, &done, pixels, false);
    while (done < pixels) {
        if (t->at == t->size)
            return false;
        unsigned packet = t->data[t->at++];
        if (!read_packet(t, out, &done, (packet & 127) + 1, packet >= 128))
            return false;
    }
    return true;
}

bool tga_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err)
{
    struct tga t = {.data = data, .size = size};
    if (!read_header(&t, err))
        return false;
    size_t left = t.size - t.at, most = t.run_length ? left / (1 + t.depth) * 128 + 128 : left / t.depth;
    if (most < t.width * t.height)
        return picture_truncated(t.width, t.height, err);
    if (!budget_has(memory, (double)t.width * (double)t.height * 3, err))
        return false;
    picture_alloc_u8(out, t.width, t.height, t.kind == TGA_GREY ? 1 : 3);
    if (read_pixels(&t, out))
        return true;
    image_free(out);
    return error_set(err, "the file is truncated or damaged in its pixels");
}
