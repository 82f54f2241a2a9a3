/* conform.c: see conform.h. */
#include "lab/conform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "image/image.h"
#include "lab/numbers.h"
#include "lab/stats.h"

enum { TILE = 4, BLOCK = 4, MANY = 1000 /* instead of the number of batches of a known error */ };
static const double MOST_ERROR = 0.01;  /* of the mean, relative, that still says something */
static const double MOST_SHARE = 1 / 3.0; /* of all squared noise that one tile of one picture may have */

const struct mistake CONFORM_MISTAKES[] = {
    {.words = "depth is counted one less", .picture = 2},
    {.words = "depth is counted one more", .picture = 3},
    {.words = "a Gaussian filter instead of a box, or the reverse", .picture = 4},
    {.words = "sky map turned by 90 degrees", .picture = 5},
    {.words = "sky map turned by 180 degrees", .picture = 6},
    {.words = "sky map turned by 270 degrees", .picture = 7},
    {.words = "sky map mirrored", .picture = 8},
    {.words = "left and right exchanged", .flip_x = true},
    {.words = "upside down", .flip_y = true},
    {.words = "turned by 180 degrees", .flip_x = true, .flip_y = true},
    {.words = "sRGB instead of linear values", .srgb = true},
    {.words = "scaled by pi", .factor = PI},
    {.words = "scaled by 1/pi", .factor = 1 / PI},
    {.words = "scaled by 2", .factor = 2},
    {.words = "scaled by 1/2", .factor = 0.5},
    {.words = NULL}};

/* --- references -------------------------------------------------------------------------------------- */

bool conform_sheet_read(const char *path, int n, struct conform_sheet *out, struct error *err)
{
    int width, height;
    out->pixels = image_read_linear(path, &width, &height, NULL, err);
    if (out->pixels == NULL)
        return false;
    out->side = width / CONFORM_ACROSS;
    if (width == CONFORM_ACROSS * out->side && height == n * out->side)
        return true;
    free(out->pixels);
    out->pixels = NULL;
    return error_set(err, "%s: %dx%d is no sheet of %d square pictures for each of %d scenes", path, width, height,
                     CONFORM_ACROSS, n);
}

/* Picture k of a row, with errors so many times those of picture 1; without pixels if it is not there. */
static struct side of_sheet(const struct conform_sheet *sheet, int row, int k, double errors)
{
    long side = sheet->side, across = 3 * side * CONFORM_ACROSS;
    const float *first = sheet->pixels + row * side * across, *from = first + 3 * side * k;
    struct side s = {.name = "", .width = sheet->side, .height = sheet->side};
    if (from[0] < 0)
        return s;
    s.pixels = batches_new(1, 3 * side * side, true);
    for (long i = 0; i < s.pixels.n; i++) {
        long at = i / (3 * side) * across + i % (3 * side);
        s.pixels.value[i] = (double)from[at];
        s.pixels.error[i] = errors * (double)first[3 * side + at];
    }
    return s;
}

struct conform_references conform_row(const struct conform_sheet *sheet, int row, bool closed)
{
    struct conform_references r = {.right = of_sheet(sheet, row, 0, closed ? 0 : 1)};
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++)
        if (CONFORM_MISTAKES[i].picture > 0)
            r.wrong[i] = of_sheet(sheet, row, CONFORM_MISTAKES[i].picture, CONFORM_WRONG);
    return r;
}

void conform_free(struct conform_references *r)
{
    batches_free(&r->right.pixels);
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++)
        batches_free(&r->wrong[i].pixels);
}

/* --- batches ----------------------------------------------------------------------------------------- */

int conform_distinct(struct side *pictures)
{
    struct batches *b = &pictures->pixels;
    size_t size = (size_t)b->n * sizeof *b->value;
    int kept = 0, all = b->n_batches;
    for (int k = 0; k < all; k++) {
        bool again = false;
        for (int j = 0; j < kept && !again; j++)
            again = memcmp(b->value + b->n * j, b->value + b->n * k, size) == 0;
        if (!again)
            memmove(b->value + b->n * kept++, b->value + b->n * k, size);
    }
    b->n_batches = kept;
    return all - kept;
}

/* What a picture adds to the reference in the pixels of a tile that lie at (x, y) in their blocks; of the whole tile
 * where there are none. */
static double block_excess(const double *picture, const struct side *r, long tile_x, long tile_y, int tile, int c,
                           int phase)
{
    double sum[2] = {0, 0};
    long n[2] = {0, 0};
    for (long y = tile_y; y < tile_y + tile && y < r->height; y++)
        for (long x = tile_x; x < tile_x + tile && x < r->width; x++) {
            long i = 3 * (y * r->width + x) + c;
            for (int whole = 0; whole < 2; whole++)
                if (whole || y % BLOCK * BLOCK + x % BLOCK == phase) {
                    sum[whole] += picture[i] - r->pixels.value[i];
                    n[whole]++;
                }
        }
    return n[0] > 0 ? sum[0] / (double)n[0] : sum[1] / (double)n[1];
}

struct batches conform_tiles(const struct side *pictures, const struct side *reference, int tile)
{
    const struct batches *b = &pictures->pixels;
    if (b->n_batches >= CONFORM_FEW || b->error != NULL)
        return batches_tiles(b, pictures->width, pictures->height, tile);
    struct batches of = batches_tiles(&reference->pixels, reference->width, reference->height, tile);
    struct batches out = batches_new(BLOCK * BLOCK * b->n_batches, of.n, false);
    out.across = of.across;
    for (int k = 0; k < out.n_batches; k++)
        for (long i = 0; i < out.n; i++)
            out.value[out.n * k + i] =
                of.value[i] + block_excess(b->value + b->n * (k / (BLOCK * BLOCK)), reference,
                                           i / 3 % of.across * tile, i / 3 / of.across * tile, tile, (int)(i % 3),
                                           k % (BLOCK * BLOCK));
    batches_free(&of);
    return out;
}

/* Take away what rounding may have done, see conform.h: only where noise is so much less that it cannot be noise. */
static void forgive_rounding(struct batches *a, struct batches *b)
{
    double error[2], mean_a = batches_mean(a, &error[0]), mean = batches_mean(b, &error[1]), factor = 1;
    if (sqrt(sqr(error[0]) + sqr(error[1])) <= CONFORM_ROUNDING / 10 * mean)
        factor = clamp(mean_a / mean, 1 - CONFORM_ROUNDING, 1 + CONFORM_ROUNDING);
    for (long i = 0; i < b->n; i++) {
        b->value[i] *= factor;
        b->error[i] *= factor;
        struct moments x = batches_moments(a, i), y = batches_moments(b, i);
        double small = CONFORM_ROUNDING * most_of(fabs(y.mean), mean / 10);
        if (!(fabs(x.mean - y.mean) <= small && sqrt(x.variance / x.n + y.variance / y.n) <= small / 10))
            continue;
        for (int k = 0; k < a->n_batches; k++)
            a->value[a->n * k + i] = 0; /* exact, equal values say nothing */
        b->value[i] = b->error[i] = 0;
    }
}

/* The share of all squared deviations from the mean that the largest has. */
static double largest_share(const struct batches *b)
{
    double sum = 0, largest = 0;
    for (long i = 0; i < b->n; i++) {
        double mean = batches_moments(b, i).mean;
        for (int k = 0; k < b->n_batches; k++) {
            double square = sqr(b->value[b->n * k + i] - mean);
            sum += square / 3; /* a sample has three channels */
            largest = most_of(largest, square);
        }
    }
    return sum > 0 ? largest / sum : 0;
}

/* --- directions -------------------------------------------------------------------------------------- */

/* p-value of "nothing of the difference of `other` from `base` is in the pictures". The noise of the base is in both
 * factors of the products that are summed: its square is taken away. 1 where there is no such difference. */
static double direction_p(const struct side *pictures, const struct side *base, const struct side *other)
{
    int phases = pictures->pixels.n_batches < CONFORM_FEW ? BLOCK * BLOCK : 1;
    struct batches share = batches_new(pictures->pixels.n_batches * phases, 1, false);
    double squares = 0, base_noise = 0;
    for (long i = 0; i < base->pixels.n; i += 3) {
        double step = other->pixels.value[i] - base->pixels.value[i], noise = sqr(base->pixels.error[i]);
        long x = i / 3 % base->width, y = i / 3 / base->width, phase = (y % BLOCK * BLOCK + x % BLOCK) % phases;
        squares += sqr(step);
        base_noise += sqr(step) * noise;
        for (int k = 0; k < pictures->pixels.n_batches; k++)
            share.value[k * phases + phase] +=
                phases * (step * (pictures->pixels.value[pictures->pixels.n * k + i] - base->pixels.value[i]) - noise);
    }
    struct moments m = batches_moments(&share, 0);
    batches_free(&share);
    return squares > 0 ? stats_welch_p(m.mean, m.variance, m.n, 0, base_noise * MANY, MANY) : 1;
}

/* The least of all directions. */
static double directions_p(const struct side *pictures, const struct conform_references *r)
{
    double least = 1;
    int n = 0;
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++)
        if (r->wrong[i].pixels.n > 0) {
            least = least_of(least, direction_p(pictures, &r->right, &r->wrong[i]));
            n++;
        }
    return stats_sidak(least, n);
}

/* --- verdicts ---------------------------------------------------------------------------------------- */

struct judgement conform_judge(const struct side *pictures, const struct conform_references *r, double level,
                               uint64_t seed)
{
    struct batches a = conform_tiles(pictures, &r->right, TILE);
    struct batches b = batches_tiles(&r->right.pixels, r->right.width, r->right.height, TILE);
    struct judgement j = {.why = ""};
    double error[2], mean_a = batches_mean(&a, &error[0]), mean_b = batches_mean(&b, &error[1]);
    forgive_rounding(&a, &b);
    j.verdict = verify_batches(&a, &b, seed);
    j.verdict.ratio = mean_a / mean_b;
    j.verdict.ratio_error = sqrt(sqr(error[0]) + sqr(error[1] * mean_a / mean_b)) / mean_b;
    if (j.verdict.n == 0) {
        j.verdict.p = 1;
        j.why = "without noise";
    } else {
        j.verdict.p = stats_sidak(least_of(j.verdict.p, directions_p(pictures, r)), 2);
        bool differs = !(j.verdict.p >= level);
        j.why = isnan(j.verdict.p)                         ? "NaN"
                : differs && mean_a == 0                   ? "black"
                : differs                                  ? ""
                : !(j.verdict.ratio_error < MOST_ERROR)    ? "too noisy"
                : largest_share(&a) > MOST_SHARE           ? "heavy tails"
                : !(batches_smallest_p(&a, &b) >= level) ? "rare samples"
                                                           : "";
        j.finding = differs ? FINDS_DIFFERENCE : j.why[0] != '\0' ? FINDS_DOUBT : FINDS_AGREEMENT;
    }
    batches_free(&a);
    batches_free(&b);
    return j;
}

/* The pictures as they would be without the mistake. To be freed. */
static struct batches undone(const struct side *s, const struct mistake *m)
{
    struct batches out = batches_new(s->pixels.n_batches, s->pixels.n, false);
    for (long k = 0; k < out.n_batches; k++)
        for (long i = 0; i < out.n; i++) {
            long x = i / 3 % s->width, y = i / 3 / s->width;
            x = m->flip_x ? s->width - 1 - x : x;
            y = m->flip_y ? s->height - 1 - y : y;
            double v = s->pixels.value[out.n * k + 3 * (y * s->width + x) + i % 3];
            v = m->srgb ? srgb_decode(v) : v;
            out.value[out.n * k + i] = m->factor > 0 ? v / m->factor : v;
        }
    return out;
}

double conform_fit_p(const struct side *pictures, const struct conform_references *r, int mistake)
{
    const struct mistake *m = &CONFORM_MISTAKES[mistake];
    const struct side *reference = m->picture == 0 ? &r->right : &r->wrong[mistake];
    if (reference->pixels.n == 0)
        return -1;
    struct side mended = {pictures->name, pictures->width, pictures->height, undone(pictures, m)};
    struct batches a = conform_tiles(&mended, reference, TILE);
    struct batches b = batches_tiles(&reference->pixels, reference->width, reference->height, TILE);
    double error[2];
    forgive_rounding(&a, &b);
    double mean_a = batches_mean(&a, &error[0]), mean_b = batches_mean(&b, &error[1]), n = a.n_batches;
    double mean = stats_welch_p(mean_a, sqr(error[0]) * n, n, mean_b, sqr(error[1]) * MANY, MANY);
    double smallest = batches_smallest_p(&a, &b); /* NaN: without noise */
    double direction = m->picture > 0 ? direction_p(&mended, reference, &r->right) : 1;
    double p = isnan(smallest) ? 1 : stats_sidak(least_of(smallest, least_of(mean, direction)), 3);
    batches_free(&mended.pixels);
    batches_free(&a);
    batches_free(&b);
    return p;
}
