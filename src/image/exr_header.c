/* exr_header.c: what an OpenEXR file says before its pixels, see exr.h. [OpenEXR]
 *
 * Read are single pictures with full-resolution channels. Of the attributes only those that say where the pixels are
 * matter here. Like pbrt-v3, this program takes the data window for the picture; the display window is the whole of
 * which that is a part. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/exr.h"
#include "image/formats.h"

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
    return (version & ~(uint32_t)(TILED | LONG_NAMES)) == VERSION ||
           error_set(e->err, "OpenEXR files of several parts, deep ones and other versions than 2 are not read (this "
                             "is of kind %lx); save it as one flat picture", (unsigned long)version);
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
    e->compression = number < EXR_READ ? (enum exr_compression)number : EXR_READ;
    return number < EXR_READ || error_set(e->err, "OpenEXR compression %u (PXR24, B44, DWA or the like) is not read; "
                                                  "save it with ZIP or PIZ", number);
}

/* The value of an attribute, n bytes at e->at. */
static bool read_value(struct exr *e, const char *name, size_t n)
{
    const uint8_t *p = e->data + e->at;
    if (strcmp(name, "channels") == 0)
        return read_channels(e, e->at + n);
    if (strcmp(name, "compression") == 0 && n == 1)
        return read_compression(e, p[0]);
    int64_t *window = strcmp(name, "dataWindow") == 0 ? e->data_window : e->display;
    if ((window == e->data_window || strcmp(name, "displayWindow") == 0) && n == 16)
        for (size_t i = 0; i < 4; i++)
            window[i] = exr_i32(p + 4 * i);
    for (size_t i = 0; i < 2 && e->tiled && strcmp(name, "tiles") == 0 && n == 9; i++)
        e->block[i] = exr_u32(p + 4 * i);
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

bool exr_read_header(struct exr *e)
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
        e->block[0] = e->width;
        e->block[1] = e->compression == EXR_ZIP ? EXR_ZIP_ROWS : e->compression == EXR_PIZ ? EXR_PIZ_ROWS : 1;
    }
    if (e->n_channels == 0 || e->compression == EXR_READ || e->block[0] == 0 || e->block[1] == 0)
        return damaged(e);
    e->block[0] = e->block[0] < e->width ? e->block[0] : e->width;
    e->block[1] = e->block[1] < e->height ? e->block[1] : e->height;
    return true;
}
