/* exr.c: OpenEXR files read and written, see exr.h and image.h. [OpenEXR]
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

/* --- files written: rows from the top, compressed as ZIP ------------------------------------------------------ */

static void put(struct bytes *b, const void *data, size_t n)
{
    b->data = mem_grow(b->data, &b->capacity, b->n + n, 1);
    memcpy(b->data + b->n, data, n);
    b->n += n;
}

/* A number in n <= 8 bytes. */
static void put_number(struct bytes *b, uint64_t value, size_t n)
{
    uint8_t byte[8];
    bytes_of_bits(value, byte, n, false);
    put(b, byte, n);
}

static void put_float(struct bytes *b, float x, enum exr_type type)
{
    put_number(b, type == EXR_HALF ? float_to_half(x) : bits_of_float(x), exr_type_bytes(type));
}

/* The head of an attribute whose value has n bytes. */
static void put_attribute(struct bytes *b, const char *name, const char *type, size_t n)
{
    put(b, name, strlen(name) + 1);
    put(b, type, strlen(type) + 1);
    put_number(b, n, 4);
}

static void put_window(struct bytes *b, const char *name, int x, int y, int width, int height)
{
    const int corner[4] = {x, y, x + width - 1, y + height - 1};
    put_attribute(b, name, "box2i", 16);
    for (int i = 0; i < 4; i++)
        put_number(b, (uint64_t)corner[i], 4);
}

static enum exr_type type_of(const struct channel *c, enum exr_type type) { return c->exact ? EXR_FLOAT : type; }

/* All attributes that every file must have.
 *   channel  [n], in the order of the alphabet */
static void put_header(struct bytes *b, const struct raster *r, const struct channel *channel, int n,
                       enum exr_type type)
{
    const struct placement at = r->at;
    size_t list = 1;
    for (int i = 0; i < n; i++)
        list += strlen(channel[i].name) + 17;
    put_number(b, 0x01312f76, 4); /* magic number */
    put_number(b, 2, 4);          /* version */
    put_attribute(b, "channels", "chlist", list);
    for (int i = 0; i < n; i++) {
        put(b, channel[i].name, strlen(channel[i].name) + 1);
        put_number(b, (uint64_t)type_of(&channel[i], type), 4);
        put_number(b, 0, 4); /* of no matter */
        put_number(b, 1, 4); /* every pixel in x */
        put_number(b, 1, 4); /* and y */
    }
    put_number(b, 0, 1);
    put_attribute(b, "compression", "compression", 1);
    put_number(b, EXR_ZIP, 1);
    put_window(b, "dataWindow", at.x, at.y, r->width, r->height);
    put_window(b, "displayWindow", 0, 0, at.width > 0 ? at.width : r->width, at.width > 0 ? at.height : r->height);
    put_attribute(b, "lineOrder", "lineOrder", 1);
    put_number(b, 0, 1); /* from the top */
    put_attribute(b, "pixelAspectRatio", "float", 4);
    put_float(b, 1, EXR_FLOAT);
    put_attribute(b, "screenWindowCenter", "v2f", 8);
    put_number(b, 0, 8);
    put_attribute(b, "screenWindowWidth", "float", 4);
    put_float(b, 1, EXR_FLOAT);
    put_number(b, 0, 1);
}

/* What deflate packs well: the even bytes before the odd ones, each less the one before, plus 128. */
static void make_differences(const uint8_t *in, size_t n, uint8_t *out)
{
    for (size_t i = 0; i < n; i++)
        out[i / 2 + (i % 2 != 0 ? (n + 1) / 2 : 0)] = in[i];
    for (size_t i = n; i-- > 1;)
        out[i] = (uint8_t)(out[i] - out[i - 1] + 128);
}

/* Append the block of rows y to end - 1: y, size, data. */
static void put_block(struct bytes *b, const struct raster *r, const struct channel *channel, int n, size_t y,
                      size_t end, enum exr_type type)
{
    struct bytes raw = {NULL, 0, 0};
    uint64_t first = (uint64_t)r->at.y + y;
    size_t width = (size_t)r->width;
    for (; y < end; y++)
        for (int c = 0; c < n; c++)
            for (size_t x = 0; x < width; x++)
                put_float(&raw, channel[c].value[(y * width + x) * channel[c].step], type_of(&channel[c], type));
    uint8_t *scratch = mem_alloc(raw.n, 1);
    size_t size;
    make_differences(raw.data, raw.n, scratch);
    uint8_t *packed = deflate_zlib(scratch, raw.n, &size);
    bool smaller = size < raw.n;
    put_number(b, first, 4);
    put_number(b, smaller ? size : raw.n, 4);
    put(b, smaller ? packed : raw.data, smaller ? size : raw.n);
    free(packed);
    free(scratch);
    free(raw.data);
}

static int by_name(const void *a, const void *b)
{
    const struct channel *x = a, *y = b;
    return strcmp(x->name, y->name);
}

static void write_file(FILE *f, const struct raster *r, enum exr_type type)
{
    const struct channel rgb[3] = {{"R", r->pixels, 3, false}, {"G", r->pixels + 1, 3, false},
                                   {"B", r->pixels + 2, 3, false}};
    size_t rows = (size_t)r->height, n = (rows + EXR_ZIP_ROWS - 1) / EXR_ZIP_ROWS;
    int n_channels = 3 + r->n_more;
    struct channel *channel = mem_alloc((size_t)n_channels, sizeof *channel);
    struct bytes head = {NULL, 0, 0}, blocks = {NULL, 0, 0};
    for (int i = 0; i < n_channels; i++)
        channel[i] = i < 3 ? rgb[i] : r->more[i - 3];
    qsort(channel, (size_t)n_channels, sizeof *channel, by_name);
    put_header(&head, r, channel, n_channels, type);
    size_t start = head.n + 8 * n;
    for (size_t y = 0; y < rows; y += EXR_ZIP_ROWS) {
        put_number(&head, start + blocks.n, 8); /* the table of offsets */
        put_block(&blocks, r, channel, n_channels, y, y + EXR_ZIP_ROWS < rows ? y + EXR_ZIP_ROWS : rows, type);
    }
    fwrite(head.data, 1, head.n, f);
    fwrite(blocks.data, 1, blocks.n, f);
    free(head.data);
    free(blocks.data);
    free(channel);
}

void exr_write_half(FILE *f, const struct raster *r) { write_file(f, r, EXR_HALF); }
void exr_write_float(FILE *f, const struct raster *r) { write_file(f, r, EXR_FLOAT); }

/* Halfs end at HALF_MAX. */
void exr_warn_half(const char *path, const struct raster *r)
{
    long cut = 0;
    for (size_t i = 0; i < 3 * (size_t)r->width * (size_t)r->height; i++)
        cut += isfinite(r->pixels[i]) && fabsf(r->pixels[i]) > HALF_MAX;
    if (cut > 0)
        say_line("asbdpt: warning: %s: %ld values are beyond %d, the most that half floats hold, and were cut to it; a "
                 "name that ends in .float.exr keeps them", path, cut, HALF_MAX);
}
