/* compare.c: see compare.h. */
#include "lab/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "image/image.h"
#include "lab/numbers.h"
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
        d.psnr = d.rmse8 > 0 ? 20 * log_ten(255 / d.rmse8) : HUGE_VAL;
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

int compare_block(int width, int height)
{
    int least = width < height ? width : height;
    return least < COMPARE_BLOCK ? least : COMPARE_BLOCK;
}

static double relative_square(const float *x, const float *y, const float *r, long n)
{
    double sum = 0;
    long finite = 0;
    for (long i = 0; i < n; i++) {
        double e = (double)x[i] - (double)y[i], square = e * e / ((double)r[i] * (double)r[i] + 0.01);
        sum += isfinite(square) ? square : 0;
        finite += isfinite(square);
    }
    return finite > 0 ? sum / (double)finite : HUGE_VAL;
}

void compare_squares(const float *x, const float *y, const float *r, int width, int height, double out[N_SQUARES])
{
    int k = compare_block(width, height);
    long n = 3L * width * height;
    const float *picture[3] = {x, y, r};
    float *mean[3];
    double rmse8 = compare_pixels(x, y, n).rmse8;
    for (int i = 0; i < 3; i++)
        mean[i] = sheet_shrink(picture[i], width, height, k);
    out[SQUARE_MSE8] = rmse8 * rmse8;
    out[SQUARE_RELMSE] = relative_square(x, y, r, n);
    out[SQUARE_BLOCKS] = relative_square(mean[0], mean[1], mean[2], 3L * (width / k) * (height / k));
    for (int i = 0; i < 3; i++)
        free(mean[i]);
}

double compare_shown_blocks(const float *x, const float *r, int width, int height)
{
    int k = compare_block(width, height);
    const float *picture[2] = {x, r};
    float *mean[2];
    for (int i = 0; i < 2; i++) {
        float *shown = clipped(picture[i], 3L * width * height);
        mean[i] = sheet_shrink(shown, width, height, k);
        free(shown);
    }
    double rmse8 = compare_pixels(mean[0], mean[1], 3L * (width / k) * (height / k)).rmse8;
    free(mean[0]);
    free(mean[1]);
    return rmse8;
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

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double picture_percentile(const float *error, long n, double percent)
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
