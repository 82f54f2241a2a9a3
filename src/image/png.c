/* png.c: PNG files, see image.h. Format: [PNG].
 *
 * A file is a signature and chunks (length, name, data, CRC). The data of all IDAT chunks together are a zlib
 * stream of rows, each a filter's number and the row's bytes less what a filter predicts from their neighbours [PNG 9].
 * An interlaced picture is seven smaller ones, one after the other [PNG 8.2].
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "image/image.h"
#include "image/zlib.h"

static const uint8_t SIGNATURE[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

enum colour { GREY = 0, RGB = 2, PALETTE = 3, GREY_ALPHA = 4, RGB_ALPHA = 6 };             /* [PNG 11.2.2] */
enum row_filter { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH, FILTERS }; /* [PNG 9.2] */

bool png_matches(const uint8_t *data, size_t size)
{
    return size >= sizeof SIGNATURE && memcmp(data, SIGNATURE, sizeof SIGNATURE) == 0;
}

/* --- filters ----------------------------------------------------------------------------------------- */

/* The neighbour (left a, above b, above left c) nearest to a + b - c [PNG 9.4]. */
static uint8_t paeth(int a, int b, int c)
{
    int pa = abs(b - c), pb = abs(a - c), pc = abs(a + b - 2 * c);
    return (uint8_t)(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

/* What a filter predicts for byte i of a row from its neighbours; bytes outside the picture are 0.
 *   step  bytes of a pixel, at least 1 */
static inline uint8_t predict(enum row_filter f, const uint8_t *row, const uint8_t *above, size_t i, size_t step)
{
    int left = i < step ? 0 : row[i - step], above_left = i < step ? 0 : above[i - step];
    switch (f) {
    case FILTER_SUB: return (uint8_t)left;
    case FILTER_UP: return above[i];
    case FILTER_AVERAGE: return (uint8_t)((left + above[i]) / 2);
    case FILTER_PAETH: return paeth(left, above[i], above_left);
    case FILTER_NONE:
    case FILTERS: break;
    }
    return 0;
}

/* --- reading ----------------------------------------------------------------------------------------- */

struct png {
    const uint8_t *data;
    size_t size, at;
    size_t width, height;
    bool interlaced;
    unsigned depth; /* bits of a sample */
    enum colour colour;
    unsigned samples; /* of a pixel as stored */
    const uint8_t *palette; /* [n_palette][3], or NULL */
    size_t n_palette;
    uint8_t *packed; /* [n_packed] the zlib stream; owned */
    size_t n_packed, packed_capacity;
    const struct budget *memory;
    struct error *err;
};

struct png_chunk {
    char name[5]; /* four bytes, and a zero */
    const uint8_t *data; /* [size] */
    size_t size;
};

static uint32_t u32(const uint8_t *p) { return (uint32_t)bits_of_bytes(p, 4, true); }

static bool damaged(const struct png *p) { return error_set(p->err, "the PNG file is damaged or truncated"); }

static bool next_chunk(struct png *p, struct png_chunk *c)
{
    size_t left = p->size - p->at;
    if (left < 12 || u32(p->data + p->at) > left - 12)
        return damaged(p);
    const uint8_t *start = p->data + p->at;
    c->size = u32(start);
    c->data = start + 8;
    memcpy(c->name, start + 4, 4);
    c->name[4] = '\0';
    p->at += c->size + 12;
    return checksum_crc32(0, start + 4, c->size + 4) == u32(c->data + c->size) || damaged(p);
}

/* Samples of a pixel; 0 for a colour type or depth that does not exist [PNG 11.2.2]. */
static unsigned samples_of(unsigned colour, unsigned depth)
{
    static const unsigned SAMPLES[] = {[GREY] = 1, [RGB] = 3, [PALETTE] = 1, [GREY_ALPHA] = 2, [RGB_ALPHA] = 4};
    unsigned n = colour <= RGB_ALPHA ? SAMPLES[colour] : 0;
    bool exists = depth == 8 || (depth == 16 && colour != PALETTE) ||
                  (n == 1 && (depth == 1 || depth == 2 || depth == 4));
    return exists ? n : 0;
}

static bool read_header(struct png *p)
{
    struct png_chunk c;
    if (!next_chunk(p, &c))
        return false;
    if (strcmp(c.name, "IHDR") != 0 || c.size != 13)
        return damaged(p);
    p->width = u32(c.data);
    p->height = u32(c.data + 4);
    p->depth = c.data[8];
    p->samples = samples_of(c.data[9], p->depth);
    if (p->samples == 0 || c.data[10] != 0 || c.data[11] != 0 || c.data[12] > 1)
        return error_set(p->err, "unknown kind of PNG file (colour type %u, %u bits)", (unsigned)c.data[9], p->depth);
    p->interlaced = c.data[12] == 1;
    p->colour = (enum colour)c.data[9];
    return picture_size_ok(p->width, p->height, p->err);
}

/* Collect what the chunks say until IEND. */
static bool read_chunks(struct png *p)
{
    struct png_chunk c;
    while (next_chunk(p, &c)) {
        if (strcmp(c.name, "IEND") == 0)
            return p->colour != PALETTE || p->palette != NULL || damaged(p);
        if (strcmp(c.name, "IDAT") == 0) {
            p->packed = mem_grow(p->packed, &p->packed_capacity, p->n_packed + c.size, 1);
            if (c.size > 0)
                memcpy(p->packed + p->n_packed, c.data, c.size);
            p->n_packed += c.size;
        } else if (strcmp(c.name, "PLTE") == 0) {
            p->palette = c.data;
            p->n_palette = c.size / 3;
        } else if (c.name[0] <= 'Z') { /* a capital: cannot be ignored [PNG 5.4] */
            return error_set(p->err, "unknown PNG chunk %s", c.name);
        }
    }
    return false;
}

/* Every `step`th pixel from `first` on, across and down: a picture of this size. [PNG 8.2] */
struct pass {
    size_t first[2], step[2], width, height;
};

enum { PASSES = 7 };

/* A picture that is not interlaced has one pass with all of it. */
static struct pass pass_of(const struct png *p, int number)
{
    static const uint8_t ADAM7[PASSES][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                             {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    const uint8_t *a = ADAM7[number];
    struct pass s = {{0, 0}, {1, 1}, p->width, p->height};
    if (p->interlaced)
        s = (struct pass){{a[0], a[1]}, {a[2], a[3]}, (p->width + a[2] - a[0] - 1u) / a[2],
                          (p->height + a[3] - a[1] - 1u) / a[3]};
    return s;
}

static int passes(const struct png *p) { return p->interlaced ? PASSES : 1; }

/* Bytes of a row of so many pixels without the filter's number. */
static size_t row_bytes(const struct png *p, size_t width)
{
    return (size_t)(((uint64_t)width * p->samples * p->depth + 7) / 8);
}

/* All rows of a pass with their filters' numbers. */
static size_t pass_bytes(const struct png *p, const struct pass *s)
{
    return s->width == 0 ? 0 : s->height * (1 + row_bytes(p, s->width));
}

/* Sample number `i` of a row. */
static unsigned sample(const uint8_t *row, size_t i, unsigned depth)
{
    if (depth == 8)
        return row[i];
    if (depth == 16)
        return (unsigned)row[2 * i] << 8 | row[2 * i + 1];
    size_t bit = i * depth; /* the first sample in the highest bits [PNG 7.2] */
    return (unsigned)row[bit / 8] >> (8 - depth - bit % 8) & ((1u << depth) - 1);
}

/* Put pixel `i` of a row at its place, dropping alpha. */
static bool put_pixel(const struct png *p, const uint8_t *row, size_t i, struct image *out, size_t place)
{
    size_t to = place * (size_t)out->channels;
    if (p->colour == PALETTE) {
        unsigned index = sample(row, i, p->depth);
        if (index >= p->n_palette)
            return damaged(p);
        memcpy(out->u8 + to, p->palette + 3 * (size_t)index, 3);
        return true;
    }
    for (size_t k = 0; k < (size_t)out->channels; k++) {
        unsigned value = sample(row, i * p->samples + k, p->depth);
        if (p->depth == 16)
            out->f32[to + k] = (float)(value / 65535.0);
        else
            out->u8[to + k] = (uint8_t)(value * 255 / ((1u << p->depth) - 1));
    }
    return true;
}

/* Undo the filters of a pass and put its pixels in place. `above`: a row of zeros. */
static bool place_pass(const struct png *p, const struct pass *s, const uint8_t *above, uint8_t *bytes,
                       struct image *out)
{
    size_t n = row_bytes(p, s->width), step = p->samples * p->depth < 8 ? 1 : p->samples * p->depth / 8;
    for (size_t y = 0; s->width > 0 && y < s->height; y++) {
        uint8_t *row = bytes + y * (n + 1);
        if (row[0] >= FILTERS)
            return damaged(p);
        enum row_filter f = (enum row_filter)*row++;
        for (size_t i = 0; i < n; i++)
            row[i] = (uint8_t)(row[i] + predict(f, row, above, i, step));
        above = row;
        size_t line = (s->first[1] + y * s->step[1]) * p->width + s->first[0];
        for (size_t x = 0; x < s->width; x++)
            if (!put_pixel(p, row, x, out, line + x * s->step[0]))
                return false;
    }
    return true;
}

static bool place_pixels(const struct png *p, const uint8_t *zeros, uint8_t *bytes, struct image *out)
{
    int channels = p->colour == GREY || p->colour == GREY_ALPHA ? 1 : 3;
    bool ok = true;
    if (p->depth == 16)
        picture_alloc_f32(out, p->width, p->height, channels);
    else
        picture_alloc_u8(out, p->width, p->height, channels);
    out->linear = false;
    for (int i = 0; ok && i < passes(p); i++) {
        const struct pass s = pass_of(p, i);
        ok = place_pass(p, &s, zeros, bytes, out);
        bytes += pass_bytes(p, &s);
    }
    return ok;
}

static bool read_pixels(const struct png *p, struct image *out)
{
    size_t total = 0;
    for (int i = 0; i < passes(p); i++) {
        const struct pass s = pass_of(p, i);
        total += pass_bytes(p, &s);
    }
    if (total / INFLATE_MAX_RATIO > p->n_packed)
        return picture_truncated(p->width, p->height, p->err);
    uint64_t samples = (uint64_t)p->width * p->height * 3;
    if (!budget_has(p->memory, (double)(total + samples * (p->depth == 16 ? sizeof *out->f32 : 1)), p->err))
        return false;
    uint8_t *bytes = mem_alloc(total, 1), *zeros = mem_alloc(row_bytes(p, p->width), 1);
    bool ok = inflate_zlib(p->packed, p->n_packed, bytes, total, p->err);
    if (ok && !place_pixels(p, zeros, bytes, out)) {
        image_free(out);
        ok = false;
    }
    free(zeros);
    free(bytes);
    return ok;
}

bool png_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err)
{
    if (!png_matches(data, size))
        return error_set(err, "not a PNG file: its signature is missing");
    struct png p = {.data = data, .size = size, .at = sizeof SIGNATURE, .memory = memory, .err = err};
    bool ok = read_header(&p) && read_chunks(&p) && read_pixels(&p, out);
    free(p.packed);
    return ok;
}

/* --- writing ----------------------------------------------------------------------------------------- */

static void put_u32(uint8_t *p, uint32_t value) { bytes_of_bits(value, p, 4, true); }

static void put_chunk(FILE *f, const char *name, const uint8_t *data, size_t size)
{
    uint8_t head[8], tail[4];
    put_u32(head, (uint32_t)size);
    memcpy(head + 4, name, 4);
    put_u32(tail, checksum_crc32(checksum_crc32(0, head + 4, 4), data, size));
    fwrite(head, 1, sizeof head, f);
    fwrite(data, 1, size, f);
    fwrite(tail, 1, sizeof tail, f);
}

/* Write the filter's number and the filtered row to out[0..n]; returns the sum of the sizes of the residuals, taken as
 * signed numbers. */
static uint64_t filter_row(enum row_filter f, const uint8_t *row, const uint8_t *above, size_t n, size_t step,
                           uint8_t *out)
{
    uint64_t sum = 0;
    *out++ = (uint8_t)f;
    for (size_t i = 0; i < n; i++) {
        out[i] = (uint8_t)(row[i] - predict(f, row, above, i, step));
        sum += out[i] < 128 ? out[i] : 256u - out[i];
    }
    return sum;
}

/* Pixel i of the picture. Of premultiplied light PNG keeps the colour, and what covers the pixel as a share of 255.
 * Enlarged pictures repeat pixels, and a power is slow. */
static void put_rgba(const struct raster *r, size_t i, uint8_t *out)
{
    const struct channel *a = raster_alpha(r);
    double alpha = a == NULL ? 1 : (double)a->value[i * a->step];
    if (a == NULL && i % (size_t)r->width > 0 && memcmp(r->pixels + 3 * i, r->pixels + 3 * (i - 1), 12) == 0) {
        memcpy(out, out - 3, 3);
        return;
    }
    for (size_t c = 0; c < 3; c++)
        out[c] = alpha > 0 ? srgb_byte((double)r->pixels[3 * i + c] / alpha) : 0;
    if (a != NULL)
        out[3] = (uint8_t)(255 * fmin(fmax(alpha, 0), 1) + 0.5);
}

/* All rows filtered, each with what probably packs best: what leaves the least residuals [PNG 12.8]. */
static uint8_t *filter_rows(const struct raster *r, size_t step)
{
    size_t n = step * (size_t)r->width;
    uint8_t *all = mem_alloc((size_t)r->height, n + 1);
    uint8_t *row = mem_alloc(n, 1), *above = mem_alloc(n, 1), *trial = mem_alloc(n + 1, 1);
    for (size_t y = 0; y < (size_t)r->height; y++) {
        for (size_t x = 0; x < (size_t)r->width; x++)
            put_rgba(r, y * (size_t)r->width + x, row + step * x);
        uint64_t least = UINT64_MAX;
        for (int f = FILTER_NONE; f < FILTERS; f++) {
            uint64_t sum = filter_row((enum row_filter)f, row, above, n, step, trial);
            if (sum < least)
                memcpy(all + y * (n + 1), trial, n + 1);
            least = sum < least ? sum : least;
        }
        uint8_t *swap = above;
        above = row;
        row = swap;
    }
    free(row);
    free(above);
    free(trial);
    return all;
}

void png_write(FILE *f, const struct raster *r)
{
    static const uint8_t INTENT[1] = {0}; /* of chunk sRGB: perceptual */
    uint8_t header[13] = {0};
    bool alpha = raster_alpha(r) != NULL;
    size_t step = alpha ? 4 : 3;
    put_u32(header, (uint32_t)r->width);
    put_u32(header + 4, (uint32_t)r->height);
    header[8] = 8;
    header[9] = alpha ? RGB_ALPHA : RGB;
    uint8_t *rows = filter_rows(r, step);
    size_t packed_size;
    uint8_t *packed = deflate_zlib(rows, (size_t)r->height * (step * (size_t)r->width + 1), &packed_size);
    free(rows);
    fwrite(SIGNATURE, 1, sizeof SIGNATURE, f);
    put_chunk(f, "IHDR", header, sizeof header);
    put_chunk(f, "sRGB", INTENT, sizeof INTENT);
    put_chunk(f, "IDAT", packed, packed_size);
    put_chunk(f, "IEND", header, 0);
    free(packed);
}
