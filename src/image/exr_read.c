/* exr_read.c: OpenEXR files read, see exr.h and image.h. [OpenEXR]
 *
 * Read are single pictures with full-resolution channels, in rows or in tiles, of which only the finest level counts.
 * Of the attributes only those that say where the pixels are matter here. Like pbrt-v3, this program takes the data
 * window for the picture; the display window is the whole of which that is a part. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"
#include "image/image.h"
#include "image/zlib.h"

/* --- the header --------------------------------------------------------------------------------------- */

static const uint8_t MAGIC[4] = {0x76, 0x2f, 0x31, 0x01};
enum { VERSION = 2, TILED = 0x200, LONG_NAMES = 0x400 };

bool exr_matches(const uint8_t *data, size_t size)
{
    return size >= sizeof MAGIC && memcmp(data, MAGIC, sizeof MAGIC) == 0;
}

static bool damaged(const struct exr *e) { return error_set(e->err, "the OpenEXR header is damaged or truncated"); }

static bool read_version(struct exr *e)
{
    if (!exr_matches(e->data, e->size) || e->size < 8)
        return damaged(e);
    uint32_t version = exr_u32(e->data + 4);
    e->at = 8;
    e->tiled = (version & TILED) != 0;
    return (version & ~(uint32_t)(LONG_NAMES | TILED)) == VERSION ||
           error_set(e->err, "OpenEXR files in several parts, deep ones and other versions than 2 are not read (this is "
                             "of kind %lx); save it as one flat image", (unsigned long)version);
}

/* The next text before `end`, stepping over it; NULL if it has no end. */
static const char *next_text(struct exr *e, size_t end)
{
    const uint8_t *text = e->data + e->at, *zero = memchr(text, 0, end - e->at);
    if (zero == NULL)
        return NULL;
    e->at += (size_t)(zero - text) + 1;
    return (const char *)text;
}

/* The list of channels, which ends at `end`: name, type, 4 bytes of no matter here, sampling in x and y. */
static bool read_channels(struct exr *e, size_t end)
{
    e->n_channels = 0;
    e->pixel_bytes = 0;
    for (;;) {
        const char *name = next_text(e, end);
        if (name != NULL && name[0] == '\0')
            return true;
        if (name == NULL || end - e->at < 16 || exr_u32(e->data + e->at) > EXR_FLOAT)
            return damaged(e);
        const uint8_t *p = e->data + e->at;
        e->at += 16;
        if (exr_u32(p + 8) != 1 || exr_u32(p + 12) != 1)
            return error_set(e->err, "channel \"%s\" is subsampled, which is not read (luminance and chroma?); save it "
                                     "as R, G, B", name);
        e->channel = mem_grow(e->channel, &e->capacity, e->n_channels + 1, sizeof *e->channel);
        struct exr_channel c = {name, (enum exr_type)exr_u32(p), e->pixel_bytes};
        e->channel[e->n_channels++] = c;
        e->pixel_bytes += exr_type_bytes(c.type);
    }
}

static bool read_compression(struct exr *e, unsigned number)
{
    static const char *const NAMES[] = {"none", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    enum { N_NAMES = sizeof NAMES / sizeof NAMES[0] };
    bool known = number < EXR_READ && number != EXR_RLE;
    e->compression = known ? (enum exr_compression)number : EXR_READ;
    return known || error_set(e->err, "OpenEXR compression %u (%s) is not read; save it with ZIP or PIZ, as with: "
                                      "oiiotool x.exr --compression zip -o y.exr", number,
                              number < N_NAMES ? NAMES[number] : "unknown");
}

/* The value of an attribute, n bytes at e->at. */
static bool read_value(struct exr *e, const char *name, size_t n)
{
    const uint8_t *p = e->data + e->at;
    if (strcmp(name, "channels") == 0)
        return read_channels(e, e->at + n);
    if (strcmp(name, "compression") == 0 && n == 1)
        return read_compression(e, p[0]);
    if (strcmp(name, "tiles") == 0 && n == 9) { /* and how levels are made, which does not matter here */
        e->columns = exr_u32(p);
        e->rows = exr_u32(p + 4);
    }
    int64_t *window = strcmp(name, "dataWindow") == 0 ? e->data_window : e->display;
    if ((window == e->data_window || strcmp(name, "displayWindow") == 0) && n == 16)
        for (size_t i = 0; i < 4; i++)
            window[i] = exr_i32(p + 4 * i);
    return true;
}

/* Attributes, each a name, a type, a size and a value, up to an empty name. */
static bool read_attributes(struct exr *e)
{
    for (;;) {
        const char *name = next_text(e, e->size);
        if (name != NULL && name[0] == '\0')
            return true;
        if (name == NULL || next_text(e, e->size) == NULL || e->size - e->at < 4)
            return damaged(e);
        size_t n = exr_u32(e->data + e->at);
        e->at += 4;
        if (n > e->size - e->at)
            return damaged(e);
        size_t end = e->at + n;
        if (!read_value(e, name, n))
            return false;
        e->at = end;
    }
}

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

static bool read_header(struct exr *e)
{
    static const int64_t EMPTY[4] = {0, 0, -1, -1};
    memcpy(e->data_window, EMPTY, sizeof EMPTY);
    memcpy(e->display, EMPTY, sizeof EMPTY);
    e->compression = EXR_READ;
    if (!read_version(e) || !read_attributes(e))
        return false;
    const int64_t *w = e->data_window;
    int64_t width = w[2] - w[0] + 1, height = w[3] - w[1] + 1;
    if (!picture_size_ok(width > 0 ? (uint64_t)width : 0, height > 0 ? (uint64_t)height : 0, e->err))
        return false;
    e->width = (size_t)width;
    e->height = (size_t)height;
    if (!e->tiled) {
        e->columns = e->width;
        e->rows = e->compression == EXR_ZIP ? EXR_ZIP_ROWS : e->compression == EXR_PIZ ? EXR_PIZ_ROWS : 1;
    }
    e->columns = smaller(e->columns, e->width);
    e->rows = smaller(e->rows, e->height);
    bool empty = e->columns == 0 || e->rows == 0 || e->n_channels == 0;
    return (!empty && e->compression != EXR_READ) || damaged(e);
}

/* --- compressed blocks -------------------------------------------------------------------------------- */

/* From in[n], which is destroyed, to out[n]. */
static void undo_differences(uint8_t *in, size_t n, uint8_t *out)
{
    for (size_t i = 1; i < n; i++)
        in[i] = (uint8_t)(in[i - 1] + in[i] - 128);
    for (size_t i = 0; i < n; i++)
        out[i] = in[i / 2 + (i % 2 != 0 ? (n + 1) / 2 : 0)];
}

/* A block: where it begins in the picture, and its size. */
struct block {
    size_t x, y, width, height;
};

static size_t blocks_across(const struct exr *e) { return (e->width - 1) / e->columns + 1; }
static size_t blocks_down(const struct exr *e) { return (e->height - 1) / e->rows + 1; }

static struct block block_of(const struct exr *e, size_t number)
{
    size_t x = number % blocks_across(e) * e->columns, y = number / blocks_across(e) * e->rows;
    return (struct block){x, y, smaller(e->columns, e->width - x), smaller(e->rows, e->height - y)};
}

/* The [size] bytes of a compressed block of [n], to out; scratch is as large. False on damage. */
static bool unpack(const struct exr *e, const uint8_t *in, size_t n, const struct block *b, uint8_t *scratch,
                   uint8_t *out, size_t size)
{
    if (e->compression == EXR_PIZ)
        return piz_unpack(e, in, n, b->width, b->height, out, size);
    bool ok = inflate_zlib(in, n, scratch, size, NULL);
    if (ok)
        undo_differences(scratch, size, out);
    return ok;
}

enum { RED, GREEN, BLUE, GREY, COLOURS }; /* channels "R", "G", "B", "Y" */

/* Find the colours: COLOURS of them; NULL where there is none. Some programs write "r", "g", "b". A "y" is no grey: it
 * comes with "x" and "z". */
static bool find_colours(const struct exr *e, const struct exr_channel **colour)
{
    bool any = false;
    for (int c = 0; c < COLOURS; c++) {
        colour[c] = NULL;
        for (size_t i = 0; i < e->n_channels; i++) {
            const char *name = e->channel[i].name;
            bool fits = name[0] == "RGBY"[c] || (c < GREY && colour[c] == NULL && name[0] == "rgb"[c]);
            if (fits && name[1] == '\0')
                colour[c] = &e->channel[i];
        }
        any = any || colour[c] != NULL;
    }
    return any || error_set(e->err, "the file has no channels R, G, B or Y, but e.g. \"%s\"; save one layer of it",
                            e->channel[0].name);
}

/* Does the head of this block say which it is? A tile: its column, its row, and its level, 0 0; else its first row. */
static bool is_head(const struct exr *e, const uint8_t *p, size_t number, const struct block *b)
{
    if (!e->tiled)
        return exr_i32(p) == e->data_window[1] + (int64_t)b->y;
    return exr_u32(p) == number % blocks_across(e) && exr_u32(p + 4) == number / blocks_across(e) &&
           exr_u32(p + 8) == 0 && exr_u32(p + 12) == 0;
}

/* Find a block by the table of offsets at e->at and unpack it: its head, its size, its data. False if it is not there,
 * or damaged. */
static bool read_block(const struct exr *e, size_t number, const struct block *b, uint8_t *scratch, uint8_t *out)
{
    uint64_t offset = bits_of_bytes(e->data + e->at + 8 * number, 8, false);
    size_t bytes = b->width * b->height * e->pixel_bytes, head = e->tiled ? 16 : 4;
    if (offset > e->size || e->size - offset < head + 4)
        return false;
    const uint8_t *p = e->data + offset;
    size_t n = exr_u32(p + head), left = e->size - (size_t)offset - head - 4;
    if (!is_head(e, p, number, b) || n > left || n > bytes || (n < bytes && e->compression == EXR_NONE))
        return false;
    p += head + 4;
    if (n < bytes)
        return unpack(e, p, n, b, scratch, out, bytes);
    memcpy(out, p, n);
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
    for (size_t j = 0; j < b->height; j++) {
        const uint8_t *from = bytes + (j * e->pixel_bytes + c->start) * b->width;
        float *to = out->f32 + ((b->y + j) * e->width + b->x) * channels + k;
        for (size_t x = 0; x < b->width; x++) {
            uint32_t bits = (uint32_t)bits_of_bytes(from + x * step, step, false);
            to[x * channels] = c->type == EXR_HALF ? half_to_float((uint16_t)bits)
                             : c->type == EXR_FLOAT ? float_of_bits(bits) : (float)bits;
        }
    }
}

static bool read_blocks(const struct exr *e, const struct exr_channel *const *colour, struct image *out)
{
    bool grey = colour[RED] == NULL && colour[GREEN] == NULL && colour[BLUE] == NULL, ok = true;
    size_t pixels = e->columns * e->rows;
    uint64_t blocks = 2 * (uint64_t)pixels * e->pixel_bytes;
    if (!budget_has(e->memory, (double)(blocks + (uint64_t)e->width * e->height * 3 * sizeof *out->f32), e->err))
        return false;
    uint8_t *bytes = mem_alloc(pixels, e->pixel_bytes), *scratch = mem_alloc(pixels, e->pixel_bytes);
    picture_alloc_f32(out, e->width, e->height, grey ? 1 : 3);
    for (size_t i = 0; ok && i < blocks_across(e) * blocks_down(e); i++) {
        const struct block b = block_of(e, i);
        ok = read_block(e, i, &b, scratch, bytes) ||
             error_set(e->err, "the file is incomplete, truncated or damaged in row %lu", (unsigned long)b.y);
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
    if (!read_header(e) || !find_colours(e, colour))
        return false;
    size_t left = e->size - e->at;
    uint64_t blocks = (uint64_t)blocks_across(e) * blocks_down(e);
    uint64_t bytes = (uint64_t)e->width * e->height * e->pixel_bytes;
    if (blocks > left / 8 || bytes / INFLATE_MAX_RATIO > left || bytes > SIZE_MAX / 2)
        return picture_truncated((unsigned long)e->width, (unsigned long)e->height, e->err);
    return read_blocks(e, colour, out);
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

bool exr_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err)
{
    struct exr e = {.data = data, .size = size, .memory = memory, .err = err};
    bool ok = read_picture(&e, out);
    if (ok)
        out->place = place_of(&e);
    free(e.channel);
    return ok;
}
