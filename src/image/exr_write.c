/* exr_write.c: OpenEXR files written, see exr.h and formats.h: rows from the top, compressed as ZIP. [OpenEXR] */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"
#include "image/formats.h"
#include "image/half.h"

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
    for (size_t i = 0; i < 8; i++)
        byte[i] = (uint8_t)(value >> 8 * i & 255);
    put(b, byte, n);
}

static void put_float(struct bytes *b, float x, enum exr_type type)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_number(b, type == EXR_HALF ? float_to_half(x) : bits, exr_type_bytes(type));
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
    put_attribute(b, name, "box2i", 16);
    put_number(b, (uint64_t)x, 4);
    put_number(b, (uint64_t)y, 4);
    put_number(b, (uint64_t)(x + width - 1), 4);
    put_number(b, (uint64_t)(y + height - 1), 4);
}

/* All attributes that every file must have. */
static void put_header(struct bytes *b, struct placement at, int width, int height, enum exr_type type)
{
    put_number(b, 0x01312f76, 4); /* magic number */
    put_number(b, 2, 4);          /* version */
    put_attribute(b, "channels", "chlist", 3 * 18 + 1);
    for (const char *name = "BGR"; *name != '\0'; name++) { /* in the order of the alphabet */
        put_number(b, (uint64_t)*name, 2);
        put_number(b, (uint64_t)type, 4);
        put_number(b, 0, 4); /* of no matter */
        put_number(b, 1, 4); /* every pixel in x */
        put_number(b, 1, 4); /* and y */
    }
    put_number(b, 0, 1);
    put_attribute(b, "compression", "compression", 1);
    put_number(b, EXR_ZIP, 1);
    put_window(b, "dataWindow", at.x, at.y, width, height);
    put_window(b, "displayWindow", 0, 0, at.width > 0 ? at.width : width, at.width > 0 ? at.height : height);
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

/* Append the block of rows y to end - 1 of a picture whose first is `top`: y, size, data. */
static void put_block(struct bytes *b, int top, size_t width, size_t y, size_t end, const float *pixels,
                      enum exr_type type)
{
    struct bytes raw = {NULL, 0, 0};
    uint64_t first = (uint64_t)top + y;
    for (; y < end; y++)
        for (int c = 2; c >= 0; c--)
            for (size_t x = 0; x < width; x++)
                put_float(&raw, pixels[(y * width + x) * 3 + (size_t)c], type);
    uint8_t *scratch = mem_alloc(raw.n, 1);
    size_t size;
    uint8_t *packed = exr_pack_zip(raw.data, raw.n, scratch, &size);
    put_number(b, first, 4);
    if (size < raw.n) {
        put_number(b, size, 4);
        put(b, packed, size);
    } else {
        put_number(b, raw.n, 4);
        put(b, raw.data, raw.n);
    }
    free(packed);
    free(scratch);
    free(raw.data);
}

static void write_file(FILE *f, struct placement at, int width, int height, const float *pixels, enum exr_type type)
{
    size_t rows = (size_t)height, n = (rows + EXR_ZIP_ROWS - 1) / EXR_ZIP_ROWS;
    struct bytes head = {NULL, 0, 0}, blocks = {NULL, 0, 0};
    put_header(&head, at, width, height, type);
    size_t start = head.n + 8 * n;
    for (size_t y = 0; y < rows; y += EXR_ZIP_ROWS) {
        put_number(&head, start + blocks.n, 8); /* the table of offsets */
        put_block(&blocks, at.y, (size_t)width, y, y + EXR_ZIP_ROWS < rows ? y + EXR_ZIP_ROWS : rows, pixels, type);
    }
    fwrite(head.data, 1, head.n, f);
    fwrite(blocks.data, 1, blocks.n, f);
    free(head.data);
    free(blocks.data);
}

void exr_write_half(FILE *f, struct placement at, int width, int height, const float *pixels)
{
    write_file(f, at, width, height, pixels, EXR_HALF);
}

void exr_write_float(FILE *f, struct placement at, int width, int height, const float *pixels)
{
    write_file(f, at, width, height, pixels, EXR_FLOAT);
}
