/* exr_write.c: OpenEXR files written, see exr.h and image.h: rows from the top, compressed as ZIP. [OpenEXR] */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"
#include "image/image.h"
#include "image/zlib.h"

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
