/* picture.c: see picture.h. */
#include "image/picture.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/srgb.h"

bool picture_size_ok(unsigned long width, unsigned long height, struct error *err)
{
    if (width == 0 || height == 0)
        return error_set(err, "the picture is empty (%lu x %lu)", width, height);
    if (width > PICTURE_MAX_PIXELS / height)
        return error_set(err, "%lu x %lu pixels are too many (at most %d)", width, height, PICTURE_MAX_PIXELS);
    return true;
}

/* Everything but the pixels; returns the number of samples. */
static size_t describe(struct image *out, int width, int height, int channels, bool linear)
{
    memset(out, 0, sizeof *out);
    out->width = width;
    out->height = height;
    out->channels = channels;
    out->linear = linear;
    for (int i = 0; i < 256; i++)
        out->decode[i] = (float)srgb_decode(i / 255.0);
    return (size_t)width * (size_t)height * (size_t)channels;
}

void picture_alloc_u8(struct image *out, int width, int height, int channels)
{
    size_t n = describe(out, width, height, channels, false);
    out->u8 = mem_alloc(n, sizeof *out->u8);
}

void picture_alloc_f32(struct image *out, int width, int height, int channels)
{
    size_t n = describe(out, width, height, channels, true);
    out->f32 = mem_alloc(n, sizeof *out->f32);
}

void image_free(struct image *img)
{
    free(img->u8);
    free(img->f32);
    img->u8 = NULL;
    img->f32 = NULL;
    img->width = img->height = img->channels = 0;
}
