/* noise_estimate.c: see noise_estimate.h. */
#include "render/noise_estimate.h"

#include <limits.h>

#include "base/maths.h"
#include "base/number.h"
#include "image/image.h"
#include "transport/tile_pass.h"

enum { FEWEST_BLOCKS = 4 }; /* along each side, of a picture with room for no more of the largest tiles */

/* Sums over blocks of pixels, in their order. */
struct blocks {
    double n, sum, last, steps; /* of blocks, of values, the last one, of squared differences from one to the next */
};

static void add_block(struct blocks *b, double value)
{
    b->steps += b->n > 0 ? sqr(value - b->last) : 0;
    b->sum += value;
    b->last = value;
    b->n++;
}

/* The root of the mean of so many values, the sum of all blocks being theirs. */
static struct noise_estimate root_mean(const struct blocks *b, double count)
{
    struct noise_estimate e = {sqrt(b->sum / count), INFINITY};
    double error = b->n > 1 ? sqrt(b->steps / 2 * b->n / (b->n - 1)) / count : INFINITY;
    e.error = e.value > 0 ? error / (2 * e.value) : error;
    return e;
}

static double level(double linear) { return 255 * srgb_encode(clamp(linear, 0, 1)); }

/* The squares of the values of pixels [x0,x1) x [y0,y1) of the film's rectangle, one block. */
static void add_pixels(const struct film *f, double scale, struct pixel_rect r, struct blocks b[N_NOISE_SCALES])
{
    double of_half = 2 * scale / (double)f->iterations, square = 0, square8 = 0, sum = 0;
    for (int y = r.y0; y < r.y1; y++)
        for (int x = 3 * r.x0; x < 3 * r.x1; x++) {
            size_t i = (size_t)y * 3 * (size_t)rect_width(f->rect) + (size_t)x;
            double first = exact_value(&f->half[i]) * of_half, second = film_value(f, i) * of_half - first;
            sum += (first + second) / 2;
            square += sqr((first - second) / 2);
            square8 += sqr((level(first) - level(second)) / 2);
        }
    add_block(&b[NOISE_RELATIVE], square / (sqr(sum / (3.0 * (double)rect_pixels(r))) + 0.01));
    add_block(&b[NOISE_8_BIT], square8);
}

static int block_count(int pixels)
{
    int n = pixels / MAX_TILE_SIZE > FEWEST_BLOCKS ? pixels / MAX_TILE_SIZE : FEWEST_BLOCKS;
    return n < pixels ? n : pixels;
}

int noise_run(int block) { return block * ((LONGEST_BLOCK - 1) / block + 1); }

long noise_every(const struct film *f) { return f->run < INT_MAX / 2 ? 2L * f->run : INT_MAX; }

bool noise_measure(struct film *f, double scale)
{
    if (f->half == NULL || f->passes > 0 || f->iterations == 0 || f->iterations % noise_every(f) != 0)
        return false;
    int width = rect_width(f->rect), height = rect_height(f->rect), nx = block_count(width), ny = block_count(height);
    struct blocks blocks[N_NOISE_SCALES] = {{0, 0, 0, 0}};
    for (int64_t i = 0; i < (int64_t)nx * ny; i++) {
        int64_t column = i % nx, row = i / nx;
        struct pixel_rect r = {(int)(width * column / nx), (int)(height * row / ny), (int)(width * (column + 1) / nx),
                               (int)(height * (row + 1) / ny)};
        add_pixels(f, scale, r, blocks);
    }
    for (int s = 0; s < N_NOISE_SCALES; s++)
        f->noise[s] = root_mean(&blocks[s], 3.0 * width * height);
    return true;
}
