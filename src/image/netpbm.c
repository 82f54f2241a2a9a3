/* netpbm.c: the formats with a header of words, PFM and PPM, see image.h. isspace is that of the C locale, a
 * program's at first. */
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/bits.h"
#include "base/mem.h"
#include "image/image.h"

struct netpbm {
    const uint8_t *data;
    size_t size, at;
};

/* Read over blanks and comments. */
static void skip(struct netpbm *r)
{
    bool comment = false;
    for (; r->at < r->size; r->at++) {
        int c = r->data[r->at];
        comment = comment ? c != '\n' && c != '\r' : c == '#';
        if (!comment && !isspace(c))
            return;
    }
}

/* The next decimal number. Returns false if there is none; beyond 2^28 its value is not exact. */
static bool next_number(struct netpbm *r, unsigned long *value)
{
    skip(r);
    size_t start = r->at;
    *value = 0;
    for (; r->at < r->size && r->data[r->at] >= '0' && r->data[r->at] <= '9'; r->at++)
        if (*value <= PICTURE_MAX_PIXELS)
            *value = *value * 10 + (unsigned long)(r->data[r->at] - '0');
    return r->at > start;
}

/* Read over the one blank that ends a header, for which CR LF counts; false if there is none. */
static bool end_header(struct netpbm *r)
{
    const uint8_t *p = r->data + r->at;
    size_t left = r->size - r->at;
    r->at += left > 1 && p[0] == '\r' && p[1] == '\n' ? 2 : 1;
    return left > 0 && isspace(p[0]);
}

/* --- PFM ---------------------------------------------------------------------------------------------- */

bool pfm_matches(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == 'F' || data[1] == 'f') && isspace(data[2]);
}

/* The last word of a header. Returns false if it is missing or does not fit. */
static bool last_word(struct netpbm *r, char *word, size_t room)
{
    size_t n = 0;
    for (skip(r); r->at < r->size && !isspace(r->data[r->at]) && n + 1 < room; r->at++)
        word[n++] = (char)r->data[r->at];
    word[n] = '\0';
    return n > 0 && end_header(r);
}

bool pfm_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err)
{
    (void)memory; /* pixels take what the file does */
    if (!pfm_matches(data, size))
        return error_set(err, "not a PFM file: it does not begin with PF or Pf");
    struct netpbm r = {data, size, 2};
    unsigned long width, height;
    char word[64], *end;
    if (!next_number(&r, &width) || !next_number(&r, &height) || !last_word(&r, word, sizeof word))
        return error_set(err, "the PFM header (PF, width height, scale) is incomplete");
    double scale = strtod(word, &end);
    if (*end != '\0' || !(fabs(scale) > 0 && fabs(scale) <= FLT_MAX))
        return error_set(err, "the scale in the PFM header is \"%s\"; it must be a number other than 0", word);
    if (!picture_size_ok(width, height, err))
        return false;
    int channels = data[1] == 'F' ? 3 : 1;
    size_t row = (size_t)width * (size_t)channels; /* samples */
    if ((size - r.at) / 4 / row < height)
        return picture_truncated(width, height, err);
    picture_alloc_f32(out, width, height, channels);
    float factor = (float)fabs(scale);
    for (size_t y = 0; y < height; y++)
        for (size_t i = 0; i < row; i++) {
            uint32_t bits = (uint32_t)bits_of_bytes(data + r.at + (y * row + i) * 4, 4, scale > 0);
            out->f32[(height - 1 - y) * row + i] = factor * float_of_bits(bits);
        }
    return true;
}

void pfm_write(FILE *f, const struct raster *r)
{
    size_t row = 3 * (size_t)r->width;
    uint8_t *bytes = mem_alloc(row, 4);
    fprintf(f, "PF\n%d %d\n-1.000000\n", r->width, r->height);
    for (int y = r->height - 1; y >= 0; y--) {
        for (size_t i = 0; i < row; i++)
            bytes_of_bits(bits_of_float(r->pixels[(size_t)y * row + i]), bytes + 4 * i, 4, false);
        fwrite(bytes, 4, row, f);
    }
    free(bytes);
}

/* --- PPM ---------------------------------------------------------------------------------------------- */

bool ppm_matches(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == '2' || data[1] == '3' || data[1] == '5' || data[1] == '6') &&
           (isspace(data[2]) || data[2] == '#');
}

static bool next_sample(struct netpbm *r, bool text, bool wide, unsigned long *value)
{
    if (text)
        return next_number(r, value);
    if (r->size - r->at < (wide ? 2u : 1u))
        return false;
    *value = r->data[r->at++];
    if (wide)
        *value = *value << 8 | r->data[r->at++];
    return true;
}

static bool read_samples(struct netpbm *r, bool text, unsigned long most, struct image *out, struct error *err)
{
    size_t n = (size_t)out->width * (size_t)out->height * (size_t)out->channels;
    for (size_t i = 0; i < n; i++) {
        unsigned long value;
        if (!next_sample(r, text, most > 255, &value) || value > most)
            return error_set(err, "the file is truncated or damaged: sample %lu of %lu is no number up to %lu",
                             (unsigned long)i + 1, (unsigned long)n, most);
        if (out->u8 != NULL)
            out->u8[i] = (uint8_t)((value * 255 + most / 2) / most);
        else
            out->f32[i] = (float)((double)value / (double)most);
    }
    return true;
}

bool ppm_read(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err)
{
    (void)memory; /* pixels take twice what the file does, at most */
    if (!ppm_matches(data, size))
        return error_set(err, "not a PPM file: it does not begin with P2, P3, P5 or P6");
    struct netpbm r = {data, size, 2};
    unsigned long width, height, most;
    if (!next_number(&r, &width) || !next_number(&r, &height) || !next_number(&r, &most) || !end_header(&r))
        return error_set(err, "the PPM header (width, height, largest value) is incomplete");
    if (!picture_size_ok(width, height, err))
        return false;
    if (most == 0 || most > 65535)
        return error_set(err, "the largest value in the PPM header is %lu; it must be 1 to 65535", most);
    bool text = data[1] <= '3';
    int channels = data[1] == '3' || data[1] == '6' ? 3 : 1;
    size_t n = (size_t)width * (size_t)height * (size_t)channels, left = size - r.at;
    bool fits = text ? (left + 1) / 2 >= n : left / (most > 255 ? 2 : 1) >= n; /* text: a digit and a blank each */
    if (!fits)
        return picture_truncated(width, height, err);
    if (most > 255)
        picture_alloc_f32(out, width, height, channels);
    else
        picture_alloc_u8(out, width, height, channels);
    out->linear = false;
    if (read_samples(&r, text, most, out, err))
        return true;
    image_free(out);
    return false;
}

void ppm_write(FILE *f, const struct raster *r)
{
    size_t row = 3 * (size_t)r->width;
    uint8_t *bytes = mem_alloc(row, 1);
    fprintf(f, "P6\n%d %d\n255\n", r->width, r->height);
    for (size_t y = 0; y < (size_t)r->height; y++) {
        for (size_t i = 0; i < row; i++)
            bytes[i] = srgb_byte(r->pixels[y * row + i]);
        fwrite(bytes, 1, row, f);
    }
    free(bytes);
}
