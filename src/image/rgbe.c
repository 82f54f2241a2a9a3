/* rgbe.c: Radiance's pictures, see formats.h. [Radiance] [Ward 1991]
 *
 * A pixel is four bytes: red, green, blue in units of 2^(e - 136), and e. A row is stored
 *
 *     flat          its pixels
 *     with runs     bytes 2, 2 and the width, then one after the other all reds, greens, blues and exponents: a count
 *                   above 128 and a byte that occurs so often less 128, or a count up to 128 of bytes that follow
 *     with old runs a pixel 1, 1, 1, n repeats the one before it n times; next ones count 256 times as much */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/formats.h"

/* A file whose pixels take less of it than this fraction of a byte each is refused: the old runs know no limit. */
enum { MOST_PIXELS_PER_BYTE = 1024, NARROWEST = 8, WIDEST = 32767 /* row with runs */ };

struct rgbe {
    const uint8_t *data;
    size_t size, at;
    unsigned long width, height;
    bool flip_x, flip_y;
    struct error *err;
};

bool rgbe_matches(const uint8_t *data, size_t size)
{
    return size >= 6 && (memcmp(data, "#?RADI", 6) == 0 || memcmp(data, "#?RGBE", 6) == 0);
}

/* --- the header --------------------------------------------------------------------------------------- */

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

/* A decimal count and what follows it; 0 if there is none or it is too large. */
static unsigned long next_count(const char **text)
{
    unsigned long value = 0;
    for (; isdigit((unsigned char)**text); ++*text)
        value = value <= PICTURE_MAX_PIXELS ? value * 10 + (unsigned long)(**text - '0') : value;
    return value <= PICTURE_MAX_PIXELS ? value : 0;
}

/* "-Y height +X width": rows from the top, pixels from the left. Either sign may be the other. */
static bool read_size(struct rgbe *r, const char *line)
{
    const char *p = line;
    bool known = (p[0] == '-' || p[0] == '+') && p[1] == 'Y' && p[2] == ' ';
    if (known) {
        r->flip_y = p[0] == '+';
        p += 3;
        r->height = next_count(&p);
        known = p[0] == ' ' && (p[1] == '-' || p[1] == '+') && p[2] == 'X' && p[3] == ' ';
    }
    if (known) {
        r->flip_x = p[1] == '-';
        p += 4;
        r->width = next_count(&p);
        known = *p == '\0';
    }
    if (!known)
        return error_set(r->err, "the size \"%s\" of the Radiance picture is not read (known: -Y HEIGHT +X WIDTH)",
                         line);
    return picture_size_ok(r->width, r->height, r->err);
}

/* Lines up to an empty one, of which only FORMAT matters; then the size. */
static bool read_header(struct rgbe *r)
{
    char line[128];
    bool end = false;
    while (!end) {
        if (!next_line(r, line, sizeof line))
            return error_set(r->err, "the Radiance header has no end");
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return error_set(r->err, "Radiance pictures of format \"%s\" are not read (known: 32-bit_rle_rgbe)",
                             line + 7);
        end = line[0] == '\0';
    }
    return next_line(r, line, sizeof line) ? read_size(r, line)
                                           : error_set(r->err, "the Radiance header has no size");
}

/* --- pixels ------------------------------------------------------------------------------------------- */

static bool truncated(struct rgbe *r) { return error_set(r->err, "the file is truncated in its pixels"); }
static bool too_long(struct rgbe *r) { return error_set(r->err, "a run of pixels goes beyond the end of its row"); }

/* One of the four components of a row, every fourth byte of row[]. */
static bool read_component(struct rgbe *r, uint8_t *row)
{
    for (size_t x = 0; x < r->width;) {
        if (r->size - r->at < 2)
            return truncated(r);
        size_t count = r->data[r->at++];
        bool same = count > 128;
        count -= same ? 128 : 0;
        if (count == 0)
            return error_set(r->err, "the file is damaged: an empty run");
        if (count > r->width - x)
            return too_long(r);
        size_t stored = same ? 1 : count;
        if (stored > r->size - r->at)
            return truncated(r);
        for (size_t i = 0; i < count; i++)
            row[4 * x++] = r->data[r->at + (same ? 0 : i)];
        r->at += stored;
    }
    return true;
}

/* A row of whole pixels, with or without old runs. */
static bool read_whole(struct rgbe *r, uint8_t *row)
{
    unsigned shift = 0;
    for (size_t x = 0; x < r->width;) {
        if (r->size - r->at < 4)
            return truncated(r);
        const uint8_t *p = r->data + r->at;
        r->at += 4;
        if (x == 0 || p[0] != 1 || p[1] != 1 || p[2] != 1) {
            memcpy(row + 4 * x++, p, 4);
            shift = 0;
            continue;
        }
        size_t count = shift <= 16 ? (size_t)p[3] << shift : r->width;
        if (count > r->width - x)
            return too_long(r);
        for (; count > 0; count--, x++)
            memcpy(row + 4 * x, row + 4 * x - 4, 4);
        shift += 8;
    }
    return true;
}

static bool read_row(struct rgbe *r, uint8_t *row)
{
    const uint8_t *p = r->data + r->at;
    bool runs = r->size - r->at >= 4 && r->width >= NARROWEST && r->width <= WIDEST && p[0] == 2 && p[1] == 2 &&
                ((unsigned)p[2] << 8 | p[3]) == r->width;
    if (!runs)
        return read_whole(r, row);
    r->at += 4;
    for (int c = 0; c < 4; c++)
        if (!read_component(r, row + c))
            return false;
    return true;
}

bool rgbe_read(const uint8_t *data, size_t size, struct image *out, struct error *err)
{
    struct rgbe r = {.data = data, .size = size, .err = err};
    if (!rgbe_matches(data, size))
        return error_set(err, "not a Radiance picture: it does not begin with #?RADIANCE");
    if (!read_header(&r))
        return false;
    if (r.width * r.height / MOST_PIXELS_PER_BYTE > size - r.at)
        return picture_truncated(r.width, r.height, err);
    if (!picture_memory_ok((uint64_t)r.width * r.height * 3 * sizeof *out->f32, size, err))
        return false;
    uint8_t *row = mem_alloc(r.width, 4);
    bool ok = true;
    picture_alloc_f32(out, r.width, r.height, 3);
    for (size_t y = 0; ok && y < r.height; y++) {
        ok = read_row(&r, row);
        for (size_t x = 0; ok && x < r.width; x++) {
            size_t place = (r.flip_y ? r.height - 1 - y : y) * r.width + (r.flip_x ? r.width - 1 - x : x);
            for (size_t c = 0; c < 3; c++)
                out->f32[3 * place + c] = row[4 * x + 3] > 0 ? ldexpf(row[4 * x + c], row[4 * x + 3] - 136) : 0;
        }
    }
    free(row);
    if (!ok)
        image_free(out);
    return ok;
}
