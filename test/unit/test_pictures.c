/* test_pictures.c: figures made of images: the pyramid of strategies, and what a place is worth. test_report.c has the
 * sheet of an experiment. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "image/image.h"
#include "lab/numbers.h"
#include "lab/sheet.h"
#include "lab/strategies.h"
#include "lab/worth.h"
#include "parser/parser.h"
#include "helpers.h"
#include "suites.h"

/* --- the pyramid ------------------------------------------------------------------------------------- */

/* Images of 4 iterations in which strategy (s,t) has this mean everywhere, unweighted and weighted. */
static void plant(struct strategy_images *images, int s, int t, double unweighted, double weighted)
{
    long n = 3L * rect_width(images->rect) * rect_height(images->rect);
    for (long i = 0; i < n; i++) {
        images->unweighted[n * strategy_index(s, t) + i] = 4 * unweighted;
        images->weighted[n * strategy_index(s, t) + i] = 4 * weighted;
    }
}

/* Pixels of the picture that have this byte in all channels. */
static long count_grey(const struct image *img, int byte)
{
    long n = 0;
    for (long i = 0; i < (long)img->width * img->height; i++)
        n += img->u8[3 * i] == byte && img->u8[3 * i + 1] == byte && img->u8[3 * i + 2] == byte;
    return n;
}

/* The pyramid of images that are then freed, to be freed. */
static bool drawn(struct test *t, struct strategy_images *images, struct image *out)
{
    struct error err = {.text = ""};
    char path[512];
    snprintf(path, sizeof path, "%s/pyramid.png", test_tmp(t));
    bool ok = CHECK(t, pyramid_write(test_tmp(t), images, 2, &err), "%s", err.text) &&
              CHECK(t, image_read(path, NULL, out, &err), "%s", err.text);
    strategies_free(images);
    return ok;
}

/* Every strategy has a cell on both halves, except in first rows without light; a row whose shares sum to 1/8 is
 * brightened by 8, above and below. */
static void test_pyramid(struct test *t)
{
    struct strategy_images images;
    struct image img;
    struct pixel_rect rect = {0, 0, 8, 4};
    strategies_init(&images, rect, 2);
    images.iterations = 4;
    plant(&images, 1, 3, 0.015625, 0.015625); /* depth 2: 1/64 + 3/64, twice as bright 1/8 */
    plant(&images, 2, 2, 0.03125, 0.046875);
    float *one = strategies_picture(&images, 2, 2, 2, true);
    CHECK(t, one[0] == 0.09375f && one[95] == 0.09375f, "the image of (2,2) holds %g", (double)one[0]);
    free(one);
    if (!drawn(t, &images, &img))
        return;
    long cell = count_grey(&img, 0) / 4, letters = cell / 20; /* whose edges have all greys */
    static const struct { double grey; int cells; } EXPECTED[] = {{0.25, 2}, {0.5, 1}, {0.75, 1}};
    for (int i = 0; i < 3; i++) { /* (1,3) above and below, (2,2) unweighted and weighted */
        long n = count_grey(&img, srgb_byte(EXPECTED[i].grey)), least = EXPECTED[i].cells * cell;
        CHECK(t, cell > 100 && n >= least && n <= least + letters, "%ld pixels of %g, not %ld", n, EXPECTED[i].grey,
              least);
    }
    /* 4 strategies, twice, four of them not black. */
    CHECK(t, count_grey(&img, 0) == 4 * cell, "%ld black pixels, cells have %ld", count_grey(&img, 0), cell);
    image_free(&img);
}

/* What is black has no part in a row's exposure: of 3/32 in one pixel of 32, it is 8. */
static void test_dark_pyramid(struct test *t)
{
    struct strategy_images images;
    struct image img;
    struct pixel_rect rect = {0, 0, 8, 4};
    strategies_init(&images, rect, 2);
    images.iterations = 4;
    for (int c = 0; c < 3; c++)
        images.weighted[96 * strategy_index(1, 2) + c] = 2 * 0.09375f; /* twice as bright */
    if (!drawn(t, &images, &img))
        return;
    long pixel = count_grey(&img, 0) / (14 * 32), n = count_grey(&img, srgb_byte(0.75));
    CHECK(t, pixel > 3 && n >= pixel, "%ld pixels of 3/4, where one of the picture's has %ld", n, pixel);
    image_free(&img);
}

/* --- what was learnt --------------------------------------------------------------------------------- */

enum { SIZE = 32 };

static double mean_of(const float *value, int x0, int x1, int y0, int y1)
{
    double sum = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            sum += (double)value[y * SIZE + x];
    return sum / ((y1 - y0) * (x1 - x0));
}

/* A point on the floor of the Cornell box: the floor itself, in whose plane it lies, is worth little more than the
 * share that ignores what was learnt; the ceiling is worth much. Draws are probabilities. */
static void test_worth(struct test *t)
{
    static float worth[SIZE * SIZE], draws[SIZE * SIZE];
    struct scene scene;
    struct error err = {.text = ""};
    struct render_job options = {.integrator = method_named("asbdpt"), .end = 256, .n_threads = 2};
    if (!CHECK(t, parse_scene("scenes/cornell-box.pbrt", NULL, &scene, NULL, &err), "%s", err.text))
        return;
    scene.width = scene.height = SIZE;
    scene_prepare(&scene);
    if (CHECK(t, worth_values(&scene, &options, 16, 29, worth, draws, &err), "%s", err.text)) {
        double floor_worth = mean_of(worth, 4, 12, 29, 31), above = mean_of(worth, 12, 20, 2, 5);
        CHECK(t, floor_worth < 0.5 * above, "the floor is worth %g to itself, the ceiling %g", floor_worth, above);
        double sum = mean_of(draws, 0, SIZE, 0, SIZE) * SIZE * SIZE;
        CHECK(t, sum > 0.3 && sum < 1 + 1e-6, "the camera sees %g of the draws", sum);
        CHECK(t, !worth_values(&scene, &options, SIZE, 0, worth, draws, &err) && strstr(err.text, "outside") != NULL,
              "a pixel outside the film: \"%s\"", err.text);
        const double corner[4] = {0, 0.5, 0, 0.5};
        struct sheet whole = {0}, cropped = {0};
        bool ok = worth_picture(&scene, &options, 16, 29, 1, &whole, &err);
        memcpy(scene.crop, corner, sizeof corner);
        ok = ok && worth_picture(&scene, &options, 16, 29, 1, &cropped, &err);
        CHECK(t, ok && memcmp(whole.pixels, cropped.pixels,
                              3 * (size_t)whole.width * (size_t)whole.height * sizeof *whole.pixels) == 0,
              "a crop window changes the picture of the whole film");
        sheet_free(&cropped);
        /* Lit from the camera the floor's grey of 0.7 is dim there, but not black, and the back wall is bright. */
        double dim = ok ? (double)whole.pixels[3 * ((24 + 30) * whole.width + 8)] : 0;
        double bright = ok ? (double)whole.pixels[3 * ((24 + 10) * whole.width + 16)] : 0;
        CHECK(t, dim > 0.1 && bright > 2 * dim && bright < 0.8, "the scene's floor is %g, its wall %g", dim, bright);
        sheet_free(&whole);
        CHECK(t, worth_picture(&scene, &options, 16, 29, 0, &whole, &err) && whole.width >= 3 * 320,
              "the picture is %d pixels wide", whole.width);
        sheet_free(&whole);
        options.integrator = method_named("bdpt");
        CHECK(t, !worth_values(&scene, &options, 0, 0, worth, draws, &err), "bdpt learns nothing");
    }
    scene_free(&scene);
}

void test_pictures(struct test *t)
{
    test_pyramid(t);
    test_dark_pyramid(t);
    test_worth(t);
}

/* --- the suite sheet ------------------------------------------------------------------------------------------ */

/* A letter as 40 bits, row by row. */
static uint64_t letter_bits(char letter)
{
    uint64_t bits = 0;
    for (int y = 0; y < FONT_HEIGHT; y++)
        for (int x = 0; x < FONT_WIDTH; x++)
            bits = bits << 1 | font_pixel(letter, x, y);
    return bits;
}

static void test_font(struct test *t)
{
    for (int a = ' '; a <= '~'; a++) {
        CHECK(t, (letter_bits((char)a) == 0) == (a == ' '), "letter '%c' is empty, or space is not", a);
        for (int b = ' '; b < a; b++)
            CHECK(t, letter_bits((char)a) != letter_bits((char)b), "letters '%c' and '%c' look the same", b, a);
    }
    CHECK(t, letter_bits('L') == 0x84210843e0, "L is %010llx", (unsigned long long)letter_bits('L'));
    CHECK(t, letter_bits('\n') == letter_bits('?') && letter_bits((char)200) == letter_bits('?'),
          "what is no letter is drawn as a question mark");
}

/* The ends, and a lightness that rises evenly: that is what the map is for. */
static void test_colormap(struct test *t)
{
    float colour[3];
    double before = 0, smallest = 1, largest = 0;
    for (int i = 0; i <= 100; i++) {
        viridis(i / 100.0, colour);
        double y = 0.2126 * (double)colour[0] + 0.7152 * (double)colour[1] + 0.0722 * (double)colour[2];
        double lightness = y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y; /* L* of CIE 1976, 0 to 100 */
        if (i > 0) {
            smallest = least_of(smallest, lightness - before);
            largest = most_of(largest, lightness - before);
        }
        before = lightness;
    }
    CHECK(t, smallest > 0.6 && largest < 1.1, "lightness rises by %g to %g a hundredth", smallest, largest);
    static const double ends[][2] = {{-1, 0}, {NAN, 0}, {2, 1}, {HUGE_VAL, 1}};
    for (int i = 0; i < 4; i++) {
        float beyond[3];
        viridis(ends[i][0], beyond);
        viridis(ends[i][1], colour);
        CHECK(t, memcmp(beyond, colour, sizeof colour) == 0, "viridis(%g) is not viridis(%g)", ends[i][0], ends[i][1]);
    }
    CHECK(t, srgb_byte((double)colour[0]) == 253 && srgb_byte((double)colour[1]) == 231, "the bright end");
}

static float at(const struct sheet *s, int x, int y, int c) { return s->pixels[3 * (y * s->width + x) + c]; }

/* Pictures land where they should, each pixel a square, and nothing is drawn beyond the edges. */
static void test_paste(struct test *t)
{
    const float picture[2 * 3 * 3] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18};
    for (int x = -5; x <= 8; x++)
        for (int y = -5; y <= 8; y++) {
            struct sheet s;
            sheet_init(&s, 8, 7, 0);
            sheet_paste(&s, x, y, picture, 2, 3, 2);
            bool good = true;
            for (int j = 0; j < 7; j++)
                for (int i = 0; i < 8; i++) {
                    bool inside = i >= x && i < x + 4 && j >= y && j < y + 6;
                    int pixel = inside ? (j - y) / 2 * 2 + (i - x) / 2 : 0;
                    for (int c = 0; c < 3; c++)
                        good = good && at(&s, i, j, c) == (inside ? picture[3 * pixel + c] : 0);
                }
            CHECK(t, good, "a picture at (%d,%d)", x, y);
            sheet_free(&s);
        }
}

static void test_text(struct test *t)
{
    struct sheet s;
    int ink = 0;
    sheet_init(&s, 40, 20, 0);
    sheet_text(&s, 2, 3, 2, 1, "|L");
    for (int y = 0; y < 20; y++)
        for (int x = 0; x < 40; x++) {
            bool bar = x >= 6 && x < 8 && y >= 3 && y < 17;
            bool upright = x >= 14 && x < 16 && y >= 3 && y < 17, foot = x >= 14 && x < 24 && y >= 15 && y < 17;
            CHECK(t, (at(&s, x, y, 1) > 0.5f) == (bar || upright || foot), "pixel (%d,%d) of |L", x, y);
            ink += at(&s, x, y, 1) > 0.5f;
        }
    CHECK(t, ink == 28 + 28 + 16, "%d pixels of ink", ink);
    CHECK(t, sheet_text_width("|L", 2) == 24, "width of |L: %d", sheet_text_width("|L", 2));
    sheet_free(&s);
}

static void test_shrink(struct test *t)
{
    float picture[3 * 5 * 3];
    for (int i = 0; i < 45; i++)
        picture[i] = (float)(i / 3 % 5 + 10 * (i / 15) + 100 * (i % 3)); /* x + 10 y + 100 c */
    float *half = sheet_shrink(picture, 5, 3, 2);
    for (int x = 0; x < 2; x++)
        for (int c = 0; c < 3; c++)
            CHECK(t, half[3 * x + c] == (float)(2 * x + 0.5 + 5 + 100 * c), "square %d, channel %d: %g", x, c,
                  (double)half[3 * x + c]);
    free(half);
}

/* sheet: labelled images: letters, colours, and the layout of a sheet. */
void test_sheet(struct test *t)
{
    test_font(t);
    test_colormap(t);
    test_paste(t);
    test_text(t);
    test_shrink(t);
}
