/* test_sheet.c: labelled images: letters, colours, and the layout of a sheet. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "image/image.h"
#include "lab/numbers.h"
#include "lab/sheet.h"
#include "suites.h"

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

void test_sheet(struct test *t)
{
    test_font(t);
    test_colormap(t);
    test_paste(t);
    test_text(t);
    test_shrink(t);
}
