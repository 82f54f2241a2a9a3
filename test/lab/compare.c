/* compare.c: see compare.h. */
#include "lab/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "lab/colormap.h"
#include "image/image.h"
#include "lab/sheet.h"

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

/* As a screen shows it. */
static float *clipped(const float *x, long n)
{
    float *out = mem_alloc((size_t)n, sizeof *out);
    for (long i = 0; i < n; i++)
        out[i] = x[i] > 0 ? fminf(x[i], 1) : 0;
    return out;
}

/* Of means over blocks. */
static struct difference between_blocks(const float *x, const float *r, int width, int height)
{
    int least = width < height ? width : height, k = least < COMPARE_BLOCK ? least : COMPARE_BLOCK;
    float *mean_x = sheet_shrink(x, width, height, k), *mean_r = sheet_shrink(r, width, height, k);
    struct difference d = compare_pixels(mean_x, mean_r, 3L * (width / k) * (height / k));
    free(mean_x);
    free(mean_r);
    return d;
}

double compare_shown_blocks(const float *x, const float *r, int width, int height)
{
    float *shown_x = clipped(x, 3L * width * height), *shown_r = clipped(r, 3L * width * height);
    double rmse8 = between_blocks(shown_x, shown_r, width, height).rmse8;
    free(shown_x);
    free(shown_r);
    return rmse8;
}

double compare_blocks(const float *x, const float *r, int width, int height)
{
    return between_blocks(x, r, width, height).relmse;
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

void compare_heatmap(const float *error, long pixels, double most, float *out)
{
    for (long i = 0; i < pixels; i++)
        viridis(most > 0 ? (double)error[i] / most : 0, out + 3 * i);
}
