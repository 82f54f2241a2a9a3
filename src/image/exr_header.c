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
enum { VERSION = 2, TILED = 0x200, LONG_NAMES = 0x400, DEEP = 0x800, MULTI_PART = 0x1000, LONGEST_NAME = 255 };

bool exr_matches(const uint8_t *data, size_t size)
{
    return size >= sizeof MAGIC && memcmp(data, MAGIC, sizeof MAGIC) == 0;
}

static bool damaged(const struct exr *e, const char *what)
{
    return error_set(e->err, "the OpenEXR header is damaged: %s", what);
}

static bool read_version(struct exr *e)
{
    if (e->size < 8)
        return damaged(e, "it is truncated");
    uint32_t version = exr_u32(e->data + 4), flags = version & ~255u;
    e->at = 8;
    if ((version & 255) != VERSION)
        return error_set(e->err, "OpenEXR version %u is not read (known: %d)", (unsigned)(version & 255), VERSION);
    if ((flags & DEEP) != 0)
        return error_set(e->err, "deep OpenEXR pictures are not read; flatten it");
    if ((flags & MULTI_PART) != 0)
        return error_set(e->err, "multi-part OpenEXR files are not read; take one part, e.g. with `exrmultipart "
                                 "-separate`");
    if ((flags & ~(uint32_t)(TILED | LONG_NAMES)) != 0)
        return error_set(e->err, "the OpenEXR file is of an unknown kind (flags %lx)", (unsigned long)flags);
    e->tiled = (flags & TILED) != 0;
    return true;
}

/* The next text before `end`, stepping over it; NULL if it is too long or has no end. */
static const char *next_text(struct exr *e, size_t end)
{
    size_t room = end - e->at < LONGEST_NAME + 1 ? end - e->at : LONGEST_NAME + 1;
    const uint8_t *text = e->data + e->at, *zero = room > 0 ? memchr(text, 0, room) : NULL;
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
        if (name == NULL)
            return damaged(e, "the list of channels has no end");
        if (name[0] == '\0')
            break;
        if (end - e->at < 16)
            return damaged(e, "the list of channels is truncated");
        const uint8_t *p = e->data + e->at;
        e->at += 16;
        if (exr_u32(p) > EXR_FLOAT)
            return error_set(e->err, "channel \"%s\" is of unknown type %lu", name, (unsigned long)exr_u32(p));
        if (exr_u32(p + 8) != 1 || exr_u32(p + 12) != 1)
            return error_set(e->err, "channel \"%s\" is subsampled, which is not read (luminance and chroma?); save it "
                                     "as R, G, B", name);
        e->channel = mem_grow(e->channel, &e->capacity, e->n_channels + 1, sizeof *e->channel);
        struct exr_channel c = {name, (enum exr_type)exr_u32(p), e->pixel_bytes};
        e->channel[e->n_channels++] = c;
        e->pixel_bytes += exr_type_bytes(c.type);
    }
    return e->n_channels > 0 || damaged(e, "it names no channel");
}

static bool read_compression(struct exr *e)
{
    static const char *const OTHERS[] = {"PXR24", "B44", "B44A", "DWAA", "DWAB", "HTJ2K256", "HTJ2K32"};
    unsigned number = e->data[e->at];
    if (number < EXR_READ) {
        e->compression = (enum exr_compression)number;
        return true;
    }
    unsigned other = number - EXR_READ;
    if (other < sizeof OTHERS / sizeof OTHERS[0])
        return error_set(e->err, "OpenEXR compression %s is not read; save it with ZIP or PIZ", OTHERS[other]);
    return error_set(e->err, "unknown OpenEXR compression %u", number);
}

static bool read_window(struct exr *e)
{
    const uint8_t *p = e->data + e->at;
    e->left = exr_i32(p);
    e->top = exr_i32(p + 4);
    int64_t width = exr_i32(p + 8) - e->left + 1, height = exr_i32(p + 12) - e->top + 1;
    if (width < 1 || height < 1)
        return error_set(e->err, "the picture is empty: its data window holds no pixel");
    e->width = (size_t)width;
    e->height = (size_t)height;
    return picture_size_ok((uint64_t)width, (uint64_t)height, e->err);
}

static bool read_display(struct exr *e)
{
    for (size_t i = 0; i < 4; i++)
        e->display[i] = exr_i32(e->data + e->at + 4 * i);
    return true;
}

static bool read_tile_size(struct exr *e)
{
    e->tile[0] = exr_u32(e->data + e->at);
    e->tile[1] = exr_u32(e->data + e->at + 4);
    return (e->tile[0] > 0 && e->tile[1] > 0) || damaged(e, "its tiles are empty");
}

/* The attributes that are used; of these sizes, but for the list of channels. A file must have all up to TILES. */
enum attribute { CHANNELS, COMPRESSION, DATA_WINDOW, TILES, DISPLAY_WINDOW, ATTRIBUTES };
static const struct {
    const char *name, *type;
    size_t size;
} ATTRIBUTE[ATTRIBUTES] = {
    {"channels", "chlist", 0}, {"compression", "compression", 1}, {"dataWindow", "box2i", 16},
    {"tiles", "tiledesc", 9},  {"displayWindow", "box2i", 16}};

static bool read_value(struct exr *e, enum attribute a, size_t end)
{
    switch (a) {
    case CHANNELS: return read_channels(e, end);
    case COMPRESSION: return read_compression(e);
    case DATA_WINDOW: return read_window(e);
    case TILES: return read_tile_size(e);
    case DISPLAY_WINDOW: return read_display(e);
    case ATTRIBUTES: break;
    }
    return true;
}

/* One attribute: name, type, size, value. */
static bool read_attribute(struct exr *e, const char *name, bool *seen)
{
    const char *type = next_text(e, e->size);
    if (type == NULL || e->size - e->at < 4)
        return damaged(e, "it is truncated");
    size_t n = exr_u32(e->data + e->at);
    e->at += 4;
    if (n > e->size - e->at)
        return error_set(e->err, "the OpenEXR header is damaged or truncated in its attribute \"%s\"", name);
    size_t end = e->at + n;
    for (int a = 0; a < ATTRIBUTES; a++)
        if (strcmp(name, ATTRIBUTE[a].name) == 0) {
            if (strcmp(type, ATTRIBUTE[a].type) != 0 || (n != ATTRIBUTE[a].size && a != CHANNELS))
                return error_set(e->err, "the OpenEXR header is damaged: attribute \"%s\" is of another type", name);
            seen[a] = true;
            if (!read_value(e, (enum attribute)a, end))
                return false;
        }
    e->at = end;
    return true;
}

bool exr_read_header(struct exr *e)
{
    bool seen[ATTRIBUTES] = {false};
    if (!exr_matches(e->data, e->size))
        return error_set(e->err, "not an OpenEXR file: its signature is missing");
    if (!read_version(e))
        return false;
    for (;;) {
        const char *name = next_text(e, e->size);
        if (name == NULL)
            return damaged(e, "it is truncated");
        if (name[0] == '\0')
            break;
        if (!read_attribute(e, name, seen))
            return false;
    }
    for (int a = 0; a <= TILES; a++)
        if (!seen[a] && (a != TILES || e->tiled))
            return error_set(e->err, "the OpenEXR header is damaged: it has no attribute \"%s\"", ATTRIBUTE[a].name);
    return true;
}
