/* rgbe.c: Radiance's pictures, see formats.h. [Radiance] [Ward 1991]
 *
 * A pixel is four bytes: red, green, blue in units of 2^(e - 136), and e. A row is stored
 *
 *     flat          its pixels
 *     with runs     bytes 2, 2 and the width, then one after the other all reds, greens, blues and exponents: a count
 *                   above 128 and a byte that occurs so often less 128, or a count up to 128 of bytes that follow
 *     with old runs a pixel 1, 1, 1, n repeats the one before it; this is not read */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/formats.h"

/* Runs are at most 127 pixels long, which take 8 bytes. */
enum { MOST_PIXELS_PER_BYTE = 16, NARROWEST = 8, WIDEST = 32767 /* row with runs */ };

struct rgbe {
    const uint8_t *data;
    size_t size, at;
    unsigned long width, height;
};

bool rgbe_matches(const uint8_t *data, size_t size)
{
    return size >= 6 && (memcmp(data, "#?RADI", 6) == 0 || memcmp(data, "#?RGBE", 6) == 0);
}

/* The next line, cut to fit. Returns false if it has no end. */
static bool next_line(struct rgbe *r, char *line, size_t room)
{
    const uint8_t *start = r->data + r->at, *end = memchr(start, '\n', r->size - r->at);
    if (end == NULL)
        return false;
    size_t n = (size_t)(end - start), kept = n < room ? n : room - 1;
    memcpy(line, start, kept);
    line[kept] = '\0';
    line[strcspn(line, "\r")] = '\0';
    r->at += n + 1;
    return true;
}

/* A label and a decimal number, which beyond 2^28 is not exact. Returns false if it is another label. */
static bool next_count(const char **text, const char *label, unsigned long *value)
{
    size_t n = strlen(label);
    if (strncmp(*text, label, n) != 0)
        return false;
    *value = 0;
    for (*text += n; isdigit((unsigned char)**text); ++*text)
        if (*value <= PICTURE_MAX_PIXELS)
            *value = *value * 10 + (unsigned long)(**text - '0');
    return true;
}

/* Lines up to an empty one, of which only FORMAT matters; then the size. */
static bool read_header(struct rgbe *r, struct error *err)
{
    char line[128];
    do {
        if (!next_line(r, line, sizeof line))
            return error_set(err, "the Radiance header has no end");
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return error_set(err, "Radiance images of format \"%s\" are not read (known: 32-bit_rle_rgbe)", line + 7);
    } while (line[0] != '\0');
    const char *p = line;
    if (!next_line(r, line, sizeof line) || !next_count(&p, "-Y ", &r->height) || !next_count(&p, " +X ", &r->width) ||
        *p != '\0')
        return error_set(err, "the size \"%s\" of the Radiance image is not read (known: -Y HEIGHT +X WIDTH)", line);
    return picture_size_ok(r->width, r->height, err);
}

/* One of the four components of a row, every fourth byte of row[]. False if the file is damaged. */
static bool read_component(struct rgbe *r, uint8_t *row)
{
    for (size_t x = 0; x < r->width;) {
        if (r->size - r->at < 2)
            return false;
        size_t count = r->data[r->at++];
        bool same = count > 128;
        count -= same ? 128 : 0;
        size_t stored = same ? 1 : count;
        if (count == 0 || count > r->width - x || stored > r->size - r->at)
            return false;
        for (size_t i = 0; i < count; i++)
            row[4 * x++] = r->data[r->at + (same ? 0 : i)];
        r->at += stored;
    }
    return true;
}

static bool read_row(struct rgbe *r, uint8_t *row)
{
    const uint8_t *p = r->data + r->at;
    size_t left = r->size - r->at;
    if (left >= 4 && r->width >= NARROWEST && r->width <= WIDEST && p[0] == 2 && p[1] == 2 &&
        ((unsigned)p[2] << 8 | p[3]) == r->width) {
        r->at += 4;
        return read_component(r, row) && read_component(r, row + 1) && read_component(r, row + 2) &&
               read_component(r, row + 3);
    }
    if (left / 4 < r->width)
        return false;
    memcpy(row, p, 4 * r->width);
    r->at += 4 * r->width;
    for (size_t x = 1; x < r->width; x++)
        if (p[4 * x] == 1 && p[4 * x + 1] == 1 && p[4 * x + 2] == 1) /* an old run */
            return false;
    return true;
}

bool rgbe_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    struct rgbe r = {.data = data, .size = size};
    if (!rgbe_matches(data, size))
        return error_set(err, "not a Radiance image: it does not begin with #?RADIANCE");
    if (!read_header(&r, err))
        return false;
    if (r.width * r.height / MOST_PIXELS_PER_BYTE > size - r.at)
        return picture_truncated(r.width, r.height, err);
    if (!picture_memory_ok((uint64_t)r.width * r.height * 3 * sizeof *out->f32, size, err))
        return false;
    uint8_t *row = mem_alloc(r.width, 4);
    bool ok = true;
    picture_alloc_f32(out, r.width, r.height, 3);
    for (size_t y = 0; ok && y < r.height; y++) {
        ok = read_row(&r, row) ||
             error_set(err, "the file is truncated, damaged or of the old kind of runs in row %lu", (unsigned long)y);
        for (size_t i = 0; ok && i < 3 * r.width; i++) {
            const uint8_t *pixel = row + i / 3 * 4;
            out->f32[3 * r.width * y + i] = pixel[3] > 0 ? ldexpf(pixel[i % 3], pixel[3] - 136) : 0;
        }
    }
    free(row);
    if (!ok)
        image_free(out);
    return ok;
}
