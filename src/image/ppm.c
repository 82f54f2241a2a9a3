/* ppm.c: see ppm.h. */
#include "image/ppm.h"

#include <stdlib.h>

#include "base/mem.h"
#include "image/srgb.h"

struct reader {
    const uint8_t *data;
    size_t size, at;
};

static bool is_blank(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool ppm_matches(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == '2' || data[1] == '3' || data[1] == '5' || data[1] == '6') &&
           (is_blank(data[2]) || data[2] == '#');
}

/* Read over blanks and comments. */
static void skip(struct reader *r)
{
    bool comment = false;
    for (; r->at < r->size; r->at++) {
        int c = r->data[r->at];
        comment = comment ? c != '\n' && c != '\r' : c == '#';
        if (!comment && !is_blank(c))
            return;
    }
}

/* The next decimal number. Returns false if there is none; beyond 2^28 its value is not exact. */
static bool next_number(struct reader *r, unsigned long *value)
{
    skip(r);
    size_t start = r->at;
    *value = 0;
    for (; r->at < r->size && r->data[r->at] >= '0' && r->data[r->at] <= '9'; r->at++)
        if (*value <= PICTURE_MAX_PIXELS)
            *value = *value * 10 + (unsigned long)(r->data[r->at] - '0');
    return r->at > start;
}

static bool next_sample(struct reader *r, bool text, bool wide, unsigned long *value)
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

static bool read_samples(struct reader *r, bool text, unsigned long most, struct image *out, struct error *err)
{
    size_t n = (size_t)out->width * (size_t)out->height * (size_t)out->channels;
    for (size_t i = 0; i < n; i++) {
        unsigned long value;
        if (!next_sample(r, text, most > 255, &value))
            return error_set(err, "the file is truncated or holds something that is no number: sample %lu of %lu",
                             (unsigned long)i + 1, (unsigned long)n);
        if (value > most)
            return error_set(err, "sample %lu is %lu; the header promises at most %lu", (unsigned long)i + 1, value,
                             most);
        if (out->u8 != NULL)
            out->u8[i] = (uint8_t)((value * 255 + most / 2) / most);
        else
            out->f32[i] = (float)((double)value / (double)most);
    }
    return true;
}

bool ppm_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    if (!ppm_matches(data, size))
        return error_set(err, "not a PPM file: it does not begin with P2, P3, P5 or P6");
    struct reader r = {data, size, 2};
    unsigned long width, height, most;
    if (!next_number(&r, &width) || !next_number(&r, &height) || !next_number(&r, &most) || r.at >= size ||
        !is_blank(data[r.at]))
        return error_set(err, "the PPM header (width, height, largest value) is incomplete");
    r.at++;
    if (!picture_size_ok(width, height, err))
        return false;
    if (most == 0 || most > 65535)
        return error_set(err, "the largest value in the PPM header is %lu; it must be 1 to 65535", most);
    bool text = data[1] <= '3';
    int channels = data[1] == '3' || data[1] == '6' ? 3 : 1;
    size_t n = (size_t)width * (size_t)height * (size_t)channels, left = size - r.at;
    bool fits = text ? (left + 1) / 2 >= n : left / (most > 255 ? 2 : 1) >= n; /* text: a digit and a blank each */
    if (!fits)
        return error_set(err, "the file is truncated: %lu x %lu pixels do not fit in it", width, height);
    if (most > 255)
        picture_alloc_f32(out, (int)width, (int)height, channels);
    else
        picture_alloc_u8(out, (int)width, (int)height, channels);
    out->linear = false;
    if (read_samples(&r, text, most, out, err))
        return true;
    image_free(out);
    return false;
}

void ppm_write(FILE *f, int width, int height, const float *pixels)
{
    size_t row = 3 * (size_t)width;
    uint8_t *bytes = mem_alloc(row, 1);
    fprintf(f, "P6\n%d %d\n255\n", width, height);
    for (size_t y = 0; y < (size_t)height; y++) {
        for (size_t i = 0; i < row; i++)
            bytes[i] = srgb_byte(pixels[y * row + i]);
        fwrite(bytes, 1, row, f);
    }
    free(bytes);
}
