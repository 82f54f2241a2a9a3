/* tga.c: TGA files, see formats.h. [TGA] */
#include <stdlib.h>

#include "base/bits.h"
#include "base/mem.h"
#include "image/formats.h"

enum tga_kind { TGA_MAPPED = 1, TGA_COLOUR = 2, TGA_GREY = 3 };
enum { HEADER = 18, RUN_LENGTH = 8, RIGHT_TO_LEFT = 0x10, TOP_TO_BOTTOM = 0x20 };

struct tga {
    const uint8_t *data;
    size_t size, at; /* bytes, and how many are read */
    enum tga_kind kind;
    bool run_length;
    size_t width, height, depth; /* depth: bytes of a pixel as stored */
    bool flip_x, flip_y;
    const uint8_t *map; /* colour map entries from index map_first, or NULL */
    size_t map_first, map_length, map_depth;
    struct error *err;
};

static size_t u16(const uint8_t *p) { return (size_t)bits_of_bytes(p, 2, false); }

/* Check that a stored pixel has a size this reader knows. */
static bool check_depth(struct tga *t, unsigned bits)
{
    bool ok = false;
    switch (t->kind) {
    case TGA_COLOUR: ok = bits == 24 || bits == 32; break;
    case TGA_GREY:
    case TGA_MAPPED: ok = bits == 8; break;
    }
    t->depth = bits / 8;
    return ok || error_set(t->err, "TGA pixels of %u bits are not supported for image type %d; convert to 24 bits",
                           bits, (int)t->kind);
}

/* Step over the colour map, keeping it if it is used. */
static bool read_map(struct tga *t)
{
    const uint8_t *d = t->data;
    size_t length = u16(d + 5), bits = d[7];
    if (d[1] > 1 || (d[1] == 0 && t->kind == TGA_MAPPED))
        return error_set(t->err, "the TGA header names no valid colour map");
    if (d[1] == 0)
        return true;
    size_t depth = (bits + 7) / 8;
    if (length * depth > t->size - t->at)
        return error_set(t->err, "the file is truncated in its colour map");
    if (t->kind == TGA_MAPPED && bits != 24 && bits != 32)
        return error_set(t->err, "TGA colour maps of %u bits are not supported; convert to 24 bits",
                         (unsigned)bits);
    t->map = t->kind == TGA_MAPPED ? d + t->at : NULL;
    t->map_first = u16(d + 3);
    t->map_length = length;
    t->map_depth = depth;
    t->at += length * depth;
    return true;
}

static bool read_header(struct tga *t)
{
    const uint8_t *d = t->data;
    if (t->size < HEADER)
        return error_set(t->err, "the file is truncated in its TGA header");
    unsigned type = d[2];
    t->run_length = (type & RUN_LENGTH) != 0;
    type &= ~(unsigned)RUN_LENGTH;
    if (type < TGA_MAPPED || type > TGA_GREY)
        return error_set(t->err, "TGA image type %u is not supported (known: 1, 2, 3, 9, 10, 11)", (unsigned)d[2]);
    t->kind = type == TGA_MAPPED ? TGA_MAPPED : type == TGA_COLOUR ? TGA_COLOUR : TGA_GREY;
    t->width = u16(d + 12);
    t->height = u16(d + 14);
    t->flip_x = (d[17] & RIGHT_TO_LEFT) != 0;
    t->flip_y = (d[17] & TOP_TO_BOTTOM) == 0;
    if ((d[17] & 0xc0) != 0)
        return error_set(t->err, "interleaved TGA files are not supported");
    if (!check_depth(t, d[16]) || !picture_size_ok(t->width, t->height, t->err))
        return false;
    t->at = HEADER + (size_t)d[0]; /* the name of the picture */
    if (t->at > t->size)
        return error_set(t->err, "the file is truncated in its TGA header");
    return read_map(t);
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
            return error_set(t->err, "a pixel names colour %u, which is not in the colour map", (unsigned)p[0]);
        p = t->map + (p[0] - t->map_first) * t->map_depth;
    }
    to[0] = p[2];
    to[1] = p[1];
    to[2] = p[0];
    return true;
}

/* One packet: a count, then one pixel for all of them or each its own. Files without run-length coding are one long
 * packet. */
static bool read_packet(struct tga *t, struct image *out, size_t *done, size_t count, bool same)
{
    size_t stored = same ? 1 : count;
    if (stored > (t->size - t->at) / t->depth)
        return error_set(t->err, "the file is truncated in its pixels");
    if (count > t->width * t->height - *done)
        return error_set(t->err, "a run of pixels goes beyond the end of the picture");
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
            return error_set(t->err, "the file is truncated in its pixels");
        unsigned packet = t->data[t->at++];
        if (!read_packet(t, out, &done, (packet & 127) + 1, packet >= 128))
            return false;
    }
    return true;
}

bool tga_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    struct tga t = {.data = data, .size = size, .err = err};
    if (!read_header(&t))
        return false;
    size_t left = t.size - t.at, most = t.run_length ? left / (1 + t.depth) * 128 + 128 : left / t.depth;
    if (most < t.width * t.height)
        return picture_truncated(t.width, t.height, err);
    if (!picture_memory_ok((uint64_t)t.width * t.height * 3, size, err))
        return false;
    picture_alloc_u8(out, t.width, t.height, t.kind == TGA_GREY ? 1 : 3);
    if (read_pixels(&t, out))
        return true;
    image_free(out);
    return false;
}
