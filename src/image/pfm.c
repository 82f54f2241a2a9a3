/* pfm.c: see pfm.h. */
#include "image/pfm.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static bool is_blank(int c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

bool pfm_matches(const uint8_t *data, size_t size)
{
    return size >= 3 && data[0] == 'P' && (data[1] == 'F' || data[1] == 'f') && is_blank(data[2]);
}

/* The next word of the header and the one blank after it. Returns false if it is missing or does not fit. */
static bool next_word(const uint8_t *data, size_t size, size_t *at, char *word, size_t room)
{
    while (*at < size && is_blank(data[*at]))
        ++*at;
    size_t n = 0;
    while (*at < size && !is_blank(data[*at]) && n + 1 < room)
        word[n++] = (char)data[(*at)++];
    word[n] = '\0';
    if (n == 0 || *at >= size || !is_blank(data[*at]))
        return false;
    ++*at;
    return true;
}

/* A whole word as a decimal count; 0 if it is none. Beyond 2^28 the value is not exact. */
static unsigned long to_count(const char *word)
{
    unsigned long value = 0;
    for (; *word >= '0' && *word <= '9'; word++)
        if (value <= PICTURE_MAX_PIXELS)
            value = value * 10 + (unsigned long)(*word - '0');
    return *word == '\0' ? value : 0;
}

static float to_float(const uint8_t *b, bool big_endian)
{
    uint32_t bits = big_endian ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3]
                               : (uint32_t)b[3] << 24 | (uint32_t)b[2] << 16 | (uint32_t)b[1] << 8 | b[0];
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool pfm_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    if (!pfm_matches(data, size))
        return error_set(err, "not a PFM file: it does not begin with PF or Pf");
    char word[3][64];
    size_t at = 2;
    for (int i = 0; i < 3; i++)
        if (!next_word(data, size, &at, word[i], sizeof word[i]))
            return error_set(err, "the PFM header (PF, width height, scale) is incomplete");
    unsigned long width = to_count(word[0]), height = to_count(word[1]);
    char *end;
    double scale = strtod(word[2], &end);
    if (*end != '\0' || !(fabs(scale) > 0 && fabs(scale) <= FLT_MAX))
        return error_set(err, "the scale in the PFM header is \"%s\"; it must be a number other than 0", word[2]);
    if (!picture_size_ok(width, height, err))
        return false;
    int channels = data[1] == 'F' ? 3 : 1;
    size_t row = (size_t)width * (size_t)channels; /* samples */
    if ((size - at) / 4 / row < height)
        return error_set(err, "the file is truncated: %lu x %lu pixels do not fit in it", width, height);
    picture_alloc_f32(out, (int)width, (int)height, channels);
    float factor = (float)fabs(scale);
    for (size_t y = 0; y < height; y++)
        for (size_t i = 0; i < row; i++)
            out->f32[(height - 1 - y) * row + i] = factor * to_float(data + at + (y * row + i) * 4, scale > 0);
    return true;
}

void pfm_write(FILE *f, int width, int height, const float *pixels)
{
    size_t row = 3 * (size_t)width;
    uint8_t *bytes = mem_alloc(row, 4);
    fprintf(f, "PF\n%d %d\n-1.000000\n", width, height);
    for (int y = height - 1; y >= 0; y--) {
        for (size_t i = 0; i < row; i++) {
            uint32_t bits;
            memcpy(&bits, &pixels[(size_t)y * row + i], sizeof bits);
            for (int k = 0; k < 4; k++)
                bytes[4 * i + (size_t)k] = (uint8_t)(bits >> 8 * k & 255);
        }
        fwrite(bytes, 4, row, f);
    }
    free(bytes);
}
