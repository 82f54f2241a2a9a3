/* image.c: see image.h. */
#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/maths.h"
#include "base/mem.h"

/* --- pixels ------------------------------------------------------------------------------------------- */

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

/* --- files -------------------------------------------------------------------------------------------- */

struct format {
    const char *extension;
    bool (*matches)(const uint8_t *data, size_t size); /* by content; NULL where the format has no signature */
    bool (*read)(const uint8_t *data, size_t size, const struct budget *memory, struct image *out, struct error *err);
    void (*write)(FILE *f, const struct raster *r); /* NULL where it is not written */
    bool is_8_bit;
    void (*warn)(const char *path, const struct raster *r); /* of what is lost in what was written; or NULL */
};

/* The first whose extension fits counts. */
static const struct format FORMATS[] = {
    {".pfm", pfm_matches, pfm_read, pfm_write, false, NULL},
    {".float.exr", exr_matches, exr_read, exr_write_float, false, NULL},
    {".exr", exr_matches, exr_read, exr_write_half, false, exr_warn_half},
    {".ppm", ppm_matches, ppm_read, ppm_write, true, NULL},
    {".pgm", ppm_matches, ppm_read, NULL, true, NULL},
    {".png", png_matches, png_read, png_write, true, NULL},
    {".tga", NULL, tga_read, NULL, true, NULL},
};
enum { N_FORMATS = sizeof FORMATS / sizeof FORMATS[0] };

static const char *list(bool written, char text[IMAGE_LIST_TEXT])
{
    int n = 0;
    for (int i = 0; i < N_FORMATS; i++)
        if (!written || FORMATS[i].write != NULL)
            n += snprintf(text + n, (size_t)(IMAGE_LIST_TEXT - n), "%s%s", n > 0 ? " " : "", FORMATS[i].extension);
    return text;
}

const char *image_list_read(char text[IMAGE_LIST_TEXT]) { return list(false, text); }
const char *image_list_written(char text[IMAGE_LIST_TEXT]) { return list(true, text); }

static const struct format *format_by_name(const char *path)
{
    for (int i = 0; i < N_FORMATS; i++)
        if (file_has_extension(path, FORMATS[i].extension))
            return &FORMATS[i];
    return NULL;
}

static const struct format *format_by_content(const uint8_t *data, size_t size)
{
    for (int i = 0; i < N_FORMATS; i++)
        if (FORMATS[i].matches != NULL && FORMATS[i].matches(data, size))
            return &FORMATS[i];
    return NULL;
}

static bool read_bytes(const char *path, const uint8_t *data, size_t size, const struct budget *memory,
                       struct image *out, struct error *err)
{
    const struct format *format = format_by_content(data, size);
    if (format == NULL)
        format = format_by_name(path);
    char known[IMAGE_LIST_TEXT];
    if (format == NULL)
        return error_set(err, "unknown image format; known are %s", image_list_read(known));
    return format->read(data, size, memory, out, err);
}

bool image_read(const char *path, const struct budget *memory, struct image *out, struct error *err)
{
    const struct budget usual = budget_new(0, "");
    uint8_t *data;
    size_t size;
    memset(out, 0, sizeof *out);
    if (!file_read(path, &data, &size, err))
        return false;
    struct error reason;
    bool ok = read_bytes(path, data, size, memory != NULL ? memory : &usual, out, &reason);
    out->content = hash_content(data, size);
    out->file_size = size;
    free(data);
    return ok || error_set(err, "%s: %s", path, reason.text);
}

void image_mend(struct image *img, bool negative_too)
{
    size_t n = img->f32 != NULL ? (size_t)img->width * (size_t)img->height * (size_t)img->channels : 0;
    for (size_t i = 0; i < n; i++)
        if (!isfinite(img->f32[i]) || (negative_too && img->f32[i] < 0)) {
            img->f32[i] = 0;
            img->replaced++;
        }
}

/* The format a picture is written in; NULL if there is none. */
static const struct format *format_to_write(const char *path)
{
    const struct format *format = strcmp(path, "-") == 0 ? &FORMATS[0] : format_by_name(path);
    return format != NULL && format->write != NULL ? format : NULL;
}

bool image_writable(const char *path) { return format_to_write(path) != NULL; }

bool image_create(const char *path, struct file_output *out, struct error *err)
{
    char known[IMAGE_LIST_TEXT];
    if (!image_writable(path))
        return error_usage(err, "%s: an image to write ends in one of %s", path, image_list_written(known));
    return file_create(path, out, err);
}

bool image_finish(struct file_output *f, const struct raster *r, struct error *err)
{
    const struct format *format = format_to_write(f->path);
    format->write(f->stream, r);
    if (format->warn != NULL && !r->preview)
        format->warn(f->path, r);
    return file_commit(f, err);
}

bool image_is_8_bit(const char *path)
{
    const struct format *format = format_to_write(path);
    return format != NULL && format->is_8_bit;
}

static float light(const struct image *img, size_t i, bool decode)
{
    if (img->u8 != NULL)
        return decode ? img->decode[img->u8[i]] : (float)(img->u8[i] / 255.0);
    return decode ? (float)srgb_decode((double)img->f32[i]) : img->f32[i];
}

static float *read_floats(const char *path, bool decode, int *width, int *height, struct image *about,
                          struct error *err)
{
    struct image img;
    if (!image_read(path, NULL, &img, err))
        return NULL;
    size_t pixels = (size_t)img.width * (size_t)img.height;
    float *out = mem_alloc(pixels * 3, sizeof *out);
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            out[3 * i + c] = light(&img, img.channels == 3 ? 3 * i + c : i, decode && !img.linear);
    *width = img.width;
    *height = img.height;
    if (about != NULL) {
        *about = img;
        about->u8 = NULL;
        about->f32 = NULL;
    }
    image_free(&img);
    return out;
}

float *image_read_linear(const char *path, int *width, int *height, struct image *about, struct error *err)
{
    return read_floats(path, true, width, height, about, err);
}

float *image_read_values(const char *path, int *width, int *height, struct image *about, struct error *err)
{
    return read_floats(path, false, width, height, about, err);
}
