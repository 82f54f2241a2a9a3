/* compare.c: see compare.h. */
#include "look/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "look/colormap.h"
#include "image/image.h"
#include "look/sheet.h"

struct difference compare_pixels(const float *x, const float *r, long n)
{
    struct difference d = {HUGE_VAL, HUGE_VAL, HUGE_VAL, NAN, 0, -HUGE_VAL};
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
        d.psnr = d.rmse8 > 0 ? 20 * m_log10(255 / d.rmse8) : HUGE_VAL;
        d.relmse = relative / count;
        d.mean_ratio = sum_r != 0 || sum_x != 0 ? sum_x / sum_r : 1;
    }
    return d;
}

double compare_blocks(const float *x, const float *r, int width, int height)
{
    int least = width < height ? width : height, k = least < COMPARE_BLOCK ? least : COMPARE_BLOCK;
    float *mean_x = sheet_shrink(x, width, height, k), *mean_r = sheet_shrink(r, width, height, k);
    double relmse = compare_pixels(mean_x, mean_r, 3L * (width / k) * (height / k)).relmse;
    free(mean_x);
    free(mean_r);
    return relmse;
}

void compare_errors(const float *x, const float *r, long pixels, float *out)
{
    for (long i = 0; i < pixels; i++) {
        double sum = 0;
        for (long k = 3 * i; k < 3 * i + 3; k++) {
            double e = (double)x[k] - (double)r[k];
            sum += e * e;
        }
        out[i] = isfinite(sum) ? (float)sqrt(sum / 3) : INFINITY;
    }
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double compare_percentile(const float *error, long n, double percent)
{
    float *sorted = mem_alloc((size_t)n, sizeof *sorted);
    memcpy(sorted, error, (size_t)n * sizeof *sorted);
    qsort(sorted, (size_t)n, sizeof *sorted, by_size);
    /* The nearest rank, from 1; n at most. Divided last: 7 % of 100 are 7.000000000000001 the other way round. */
    long rank = (long)ceil(percent * (double)n / 100);
    long at = rank > 0 ? rank - 1 : 0;
    while (at > 0 && isinf(sorted[at]))
        at--;
    double found = n > 0 && isfinite(sorted[at]) ? (double)sorted[at] : 0;
    free(sorted);
    return found;
}

void compare_heatmap(const float *error, long pixels, double most, float *out)
{
    for (long i = 0; i < pixels; i++)
        viridis(most > 0 ? (double)error[i] / most : 0, out + 3 * i);
}

static float linear_value(const struct image *img, size_t i)
{
    if (img->u8 != NULL)
        return img->decode[img->u8[i]];
    return img->linear ? img->f32[i] : (float)srgb_decode((double)img->f32[i]);
}

float *load_linear(const char *path, int *width, int *height, struct image *about, struct error *err)
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
    if (about != NULL)
        *about = img;
    return out;
}
