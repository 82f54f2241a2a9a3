/* compare.c: see compare.h. */
#include "lab/compare.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "image/image.h"

struct difference compare_pixels(const float *x, const float *r, long n)
{
    struct difference d = {0, 0, 0, 1, 0};
    double sum_x = 0, sum_r = 0, square = 0, square8 = 0, relative = 0;
    for (long i = 0; i < n; i++) {
        double a = (double)x[i], b = (double)r[i];
        if (!isfinite(a) || !isfinite(b)) {
            d.nonfinite++;
            continue;
        }
        double e = a - b, e8 = srgb_byte(a) - srgb_byte(b);
        sum_x += a;
        sum_r += b;
        square += e * e;
        square8 += e8 * e8;
        relative += e * e / (b * b + 0.01);
    }
    double count = (double)(n - d.nonfinite);
    if (count > 0) {
        d.rmse = sqrt(square / count);
        d.rmse8 = sqrt(square8 / count);
        d.relmse = relative / count;
    }
    if (sum_r != 0 || sum_x != 0)
        d.mean_ratio = sum_x / sum_r;
    return d;
}

static double pixel_error(const float *x, const float *r)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double e = (double)x[c] - (double)r[c];
        sum += e * e;
    }
    return isfinite(sum) ? sqrt(sum / 3) : 0;
}

void compare_heatmap(const float *x, const float *r, long pixels, float *out)
{
    double largest = 0;
    for (long i = 0; i < pixels; i++)
        largest = fmax(largest, pixel_error(x + 3 * i, r + 3 * i));
    for (long i = 0; i < pixels; i++) {
        double e = largest > 0 ? pixel_error(x + 3 * i, r + 3 * i) / largest : 0;
        out[3 * i] = 0;
        out[3 * i + 1] = (float)srgb_decode(e);
        out[3 * i + 2] = (float)srgb_decode(1 - e);
    }
}

static float linear_value(const struct image *img, size_t i)
{
    if (img->linear)
        return img->f32[i];
    return (float)srgb_decode(img->u8 != NULL ? img->u8[i] / 255.0 : (double)img->f32[i]);
}

float *load_linear(const char *path, int *width, int *height, struct error *err)
{
    struct image img;
    if (!image_read(path, &img, err))
        return NULL;
    size_t pixels = (size_t)img.width * (size_t)img.height;
    float *out = mem_alloc(pixels * 3, sizeof *out);
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            out[3 * i + c] = linear_value(&img, img.channels == 3 ? 3 * i + c : i);
    *width = img.width;
    *height = img.height;
    image_free(&img);
    return out;
}
