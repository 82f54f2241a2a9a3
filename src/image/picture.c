/* picture.c: see picture.h. */
#include "image/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"

bool picture_size_ok(uint64_t width, uint64_t height, struct error *err)
{
    if (width == 0 || height == 0)
        return error_set(err, "the image is empty (%llu x %llu)", (unsigned long long)width,
                         (unsigned long long)height);
    if (width > PICTURE_MAX_PIXELS / height)
        return error_set(err, "%llu x %llu pixels are too many (at most %d)", (unsigned long long)width,
                         (unsigned long long)height, PICTURE_MAX_PIXELS);
    return true;
}

bool picture_truncated(unsigned long width, unsigned long height, struct error *err)
{
    return error_set(err, "the file is truncated: %lu x %lu pixels do not fit in it", width, height);
}

/* Everything but the pixels; returns the number of samples. */
static size_t picture_start(struct image *out, size_t width, size_t height, int channels, bool linear)
{
    memset(out, 0, sizeof *out);
    out->width = (int)width;
    out->height = (int)height;
    out->channels = channels;
    out->linear = linear;
    for (int i = 0; i < 256; i++)
        out->decode[i] = (float)srgb_decode(i / 255.0);
    return width * height * (size_t)channels;
}

void picture_alloc_u8(struct image *out, size_t width, size_t height, int channels)
{
    out->u8 = mem_alloc(picture_start(out, width, height, channels, false), sizeof *out->u8);
}

void picture_alloc_f32(struct image *out, size_t width, size_t height, int channels)
{
    out->f32 = mem_alloc(picture_start(out, width, height, channels, true), sizeof *out->f32);
}

void image_free(struct image *img)
{
    free(img->u8);
    free(img->f32);
    img->u8 = NULL;
    img->f32 = NULL;
    img->width = img->height = img->channels = 0;
}

const struct channel *raster_alpha(const struct raster *r)
{
    for (int i = 0; i < r->n_more; i++)
        if (strcmp(r->more[i].name, "A") == 0)
            return &r->more[i];
    return NULL;
}

double srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * m_pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : m_pow((encoded + 0.055) / 1.055, 2.4);
}

uint8_t srgb_byte(double linear)
{
    if (!(linear > 0)) /* NaN too */
        return 0;
    return linear >= 1 ? 255 : (uint8_t)(255 * srgb_encode(linear) + 0.5);
}
