/* exr_read.c: OpenEXR files, from blocks to pixels; see exr.h and formats.h. [OpenEXR] */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"
#include "image/formats.h"
#include "image/half.h"
#include "image/zlib.h"

enum { RED, GREEN, BLUE, GREY, COLOURS }; /* channels "R", "G", "B", "Y" */

/* Find the colours: COLOURS of them; NULL where there is none. */
static bool find_colours(const struct exr *e, const struct exr_channel **colour)
{
    bool any = false;
    for (int c = 0; c < COLOURS; c++) {
        colour[c] = NULL;
        for (size_t i = 0; i < e->n_channels; i++)
            if (e->channel[i].name[0] == "RGBY"[c] && e->channel[i].name[1] == '\0')
                colour[c] = &e->channel[i];
        any = any || colour[c] != NULL;
    }
    return any || error_set(e->err, "the file has no channels R, G, B or Y, but e.g. \"%s\"; save one layer of it",
                            e->channel[0].name);
}

/* --- where the pixels are ----------------------------------------------------------------------------- */

/* A block's place in the picture, in pixels from the top left. */
struct block {
    size_t x, y, width, height;
};

static size_t ceil_div(size_t a, size_t b) { return (a - 1) / b + 1; } /* a > 0; no sum that could overflow */

static struct block block_at(const struct exr *e, size_t i)
{
    size_t columns = ceil_div(e->width, e->block[0]);
    struct block b = {i % columns * e->block[0], i / columns * e->block[1], e->block[0], e->block[1]};
    b.width = b.width < e->width - b.x ? b.width : e->width - b.x;
    b.height = b.height < e->height - b.y ? b.height : e->height - b.y;
    return b;
}

/* Does the head of a stored block, before its size, name this block? Rows: y. Tiles: column, row, level in x and y; the
 * blocks of level 0 come first in the table of offsets. */
static bool names_block(const struct exr *e, const uint8_t *head, const struct block *b)
{
    if (!e->tiled)
        return exr_i32(head) == e->data_window[1] + (int64_t)b->y;
    return exr_u32(head) == b->x / e->block[0] && exr_u32(head + 4) == b->y / e->block[1] && exr_u32(head + 8) == 0 &&
           exr_u32(head + 12) == 0;
}

/* Find block i by the table of offsets at e->at and unpack it. False if it is not there, or damaged. */
static bool read_block(const struct exr *e, size_t i, const struct block *b, uint8_t *scratch, uint8_t *out)
{
    uint64_t offset = bits_of_bytes(e->data + e->at + 8 * i, 8, false);
    size_t head = e->tiled ? 20 : 8, bytes = b->width * b->height * e->pixel_bytes;
    if (offset > e->size || e->size - offset < head)
        return false;
    const uint8_t *p = e->data + offset;
    size_t n = exr_u32(p + head - 4), left = e->size - (size_t)offset - head;
    if (!names_block(e, p, b) || n > left || n > bytes || (n < bytes && e->compression == EXR_NONE))
        return false;
    if (n < bytes)
        return exr_unpack(e, p + head, n, b->width, b->height, scratch, out, bytes);
    memcpy(out, p + head, n);
    return true;
}

/* --- pixels ------------------------------------------------------------------------------------------- */

/* Put one channel of a block in its place, or leave it 0 where there is none. */
static void place(const struct exr *e, const struct block *b, const uint8_t *bytes, const struct exr_channel *c,
                  struct image *out, size_t k)
{
    if (c == NULL)
        return;
    size_t step = exr_type_bytes(c->type), channels = (size_t)out->channels;
    for (size_t y = 0; y < b->height; y++) {
        const uint8_t *from = bytes + (y * e->pixel_bytes + c->start) * b->width;
        float *to = out->f32 + ((b->y + y) * e->width + b->x) * channels + k;
        for (size_t x = 0; x < b->width; x++) {
            uint32_t bits = (uint32_t)bits_of_bytes(from + x * step, step, false);
            to[x * channels] = c->type == EXR_HALF ? half_to_float((uint16_t)bits)
                             : c->type == EXR_FLOAT ? float_of_bits(bits) : (float)bits;
        }
    }
}

static bool read_blocks(const struct exr *e, size_t n_blocks, const struct exr_channel *const *colour,
                        struct image *out)
{
    bool grey = colour[RED] == NULL && colour[GREEN] == NULL && colour[BLUE] == NULL, ok = true;
    size_t pixels = e->block[0] * e->block[1];
    uint64_t blocks = 2 * (uint64_t)pixels * e->pixel_bytes;
    if (!picture_memory_ok(blocks + (uint64_t)e->width * e->height * 3 * sizeof *out->f32, e->size, e->err))
        return false;
    uint8_t *bytes = mem_alloc(pixels, e->pixel_bytes), *scratch = mem_alloc(pixels, e->pixel_bytes);
    picture_alloc_f32(out, e->width, e->height, grey ? 1 : 3);
    out->dropped = (int)e->n_channels;
    for (int c = 0; c < COLOURS; c++)
        out->dropped -= colour[c] != NULL && (c == GREY) == grey;
    for (size_t i = 0; ok && i < n_blocks; i++) {
        struct block b = block_at(e, i);
        ok = read_block(e, i, &b, scratch, bytes) ||
             error_set(e->err, "the file is incomplete, truncated or damaged in block %lu", (unsigned long)i);
        for (size_t k = 0; ok && k < (size_t)out->channels; k++)
            place(e, &b, bytes, grey ? colour[GREY] : colour[k], out, k);
    }
    free(scratch);
    free(bytes);
    if (!ok)
        image_free(out);
    return ok;
}

/* Memory is asked for when the file is long enough for what it announces: its table of offsets must be there, and no
 * compression packs tighter than deflate's INFLATE_MAX_RATIO. */
static bool read_picture(struct exr *e, struct image *out)
{
    const struct exr_channel *colour[COLOURS];
    if (!exr_read_header(e) || !find_colours(e, colour))
        return false;
    size_t left = e->size - e->at;
    uint64_t blocks = (uint64_t)ceil_div(e->width, e->block[0]) * ceil_div(e->height, e->block[1]);
    uint64_t bytes = (uint64_t)e->width * e->height * e->pixel_bytes;
    if (blocks > left / 8 || bytes / INFLATE_MAX_RATIO > left || bytes > SIZE_MAX / 2)
        return picture_truncated((unsigned long)e->width, (unsigned long)e->height, e->err);
    return read_blocks(e, (size_t)blocks, colour, out);
}

/* The data window within the display window, unless that is empty or far away. */
static struct placement place_of(const struct exr *e)
{
    const int64_t far = 1 << 30, *data = e->data_window, *whole = e->display;
    int64_t x = data[0] - whole[0], y = data[1] - whole[1];
    int64_t width = whole[2] - whole[0] + 1, height = whole[3] - whole[1] + 1;
    struct placement place = {0, 0, 0, 0};
    if (width > 0 && width < far && height > 0 && height < far && x > -far && x < far && y > -far && y < far)
        place = (struct placement){(int)x, (int)y, (int)width, (int)height};
    return place;
}

bool exr_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    struct exr e = {.data = data, .size = size, .err = err};
    bool ok = read_picture(&e, out);
    if (ok)
        out->place = place_of(&e);
    free(e.channel);
    return ok;
}
