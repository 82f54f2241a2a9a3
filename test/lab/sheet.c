/* sheet.c: see sheet.h. */
#include "lab/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "image/image.h"
#include "lab/files.h"

static float *pixel_at(struct sheet *s, int x, int y)
{
    return s->pixels + 3 * ((size_t)y * (size_t)s->width + (size_t)x);
}

/* A square of one colour. */
static void fill(struct sheet *s, int x0, int y0, int size, const float colour[3])
{
    int x1 = x0 + size < s->width ? x0 + size : s->width, y1 = y0 + size < s->height ? y0 + size : s->height;
    for (int y = y0 > 0 ? y0 : 0; y < y1; y++)
        for (int x = x0 > 0 ? x0 : 0; x < x1; x++)
            memcpy(pixel_at(s, x, y), colour, 3 * sizeof *colour);
}

void sheet_init(struct sheet *s, int width, int height, double grey)
{
    float value = (float)srgb_decode(grey);
    s->width = width;
    s->height = height;
    s->pixels = mem_alloc((size_t)width * (size_t)height * 3, sizeof *s->pixels);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 3; i++)
        s->pixels[i] = value;
}

void sheet_free(struct sheet *s)
{
    free(s->pixels);
    s->pixels = NULL;
}

bool sheet_write(struct sheet *s, const char *directory, const char *name, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    bool ok = image_write(path, s->width, s->height, s->pixels, err);
    sheet_free(s);
    return ok;
}

void sheet_paste(struct sheet *s, int x, int y, const float *pixels, int width, int height, int k)
{
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++)
            fill(s, x + i * k, y + j * k, k, pixels + 3 * ((size_t)j * (size_t)width + (size_t)i));
}

void sheet_cell(struct sheet *s, int x, int y, const float *pixels, int width, int height, int shrink, int k,
                double exposure)
{
    int w = width / shrink, h = height / shrink;
    float *cell = sheet_shrink(pixels, width, height, shrink);
    for (size_t i = 0; i < (size_t)w * (size_t)h * 3; i++)
        cell[i] = float_within((double)cell[i] * exposure);
    sheet_paste(s, x, y, cell, w, h, k);
    free(cell);
}

static void blend(struct sheet *s, int x, int y, float value, float share)
{
    if (x < 0 || x >= s->width || y < 0 || y >= s->height)
        return;
    float *p = pixel_at(s, x, y);
    for (int c = 0; c < 3; c++)
        p[c] += share * (value - p[c]);
}

static bool ink(char letter, int x, int y)
{
    return x >= 0 && x < FONT_WIDTH && y >= 0 && y < FONT_HEIGHT && font_pixel(letter, x, y);
}

/* How far a point, in the font's pixels, is from a letter's strokes: lines between neighbouring pixels of ink, across
 * corners where no straight way joins them. */
static double from_stroke(char letter, double x, double y)
{
    static const int way[5][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 1}};
    double least = 9;
    for (int j = (int)y - 2; j <= (int)y + 2; j++)
        for (int i = (int)x - 2; i <= (int)x + 2; i++)
            for (int k = 0; k < 5 && ink(letter, i, j); k++) {
                int dx = way[k][0], dy = way[k][1], length2 = dx * dx + dy * dy;
                bool joined = ink(letter, i + dx, j + dy) &&
                              (length2 < 2 || (!ink(letter, i + dx, j) && !ink(letter, i, j + dy)));
                double along = length2 > 0 ? clamp(((x - i) * dx + (y - j) * dy) / length2, 0, 1) : 0;
                if (joined)
                    least = fmin(least, sqr(x - i - along * dx) + sqr(y - j - along * dy));
            }
    return sqrt(least);
}

void sheet_text(struct sheet *s, int x, int y, int size, double grey, const char *text)
{
    float value = (float)srgb_decode(grey);
    for (; *text != '\0'; text++, x += FONT_ADVANCE * size)
        for (int j = 0; j < FONT_HEIGHT * size; j++)
            for (int i = 0; i < FONT_WIDTH * size; i++) {
                double far = from_stroke(*text, (i + 0.5) / size - 0.5, (j + 0.5) / size - 0.5);
                blend(s, x + i, y + j, value, (float)clamp((0.5 - far) * size + 0.5, 0, 1));
            }
}

int sheet_text_width(const char *text, int size) { return (int)strlen(text) * FONT_ADVANCE * size; }

void sheet_bar(struct sheet *s, int x, int y, int width, const char *least, const char *unit, const char *most)
{
    enum { HEIGHT = SHEET_BAR - 2 * FONT_HEIGHT - 4 };
    int all = (int)(strlen(least) + strlen(unit) + strlen(most)) + 4; /* letters, and gaps between three texts */
    int size = all * 2 * FONT_ADVANCE <= width ? 2 : 1, end = x + width - sheet_text_width(most, size);
    int free = end - x - sheet_text_width(least, size) - sheet_text_width(unit, size);
    for (int i = 0; i < width; i++) {
        float colour[3];
        viridis(i / (width - 1.0), colour);
        for (int j = 0; j < HEIGHT; j++)
            sheet_paste(s, x + i, y + j, colour, 1, 1, 1);
    }
    sheet_text(s, x, y + HEIGHT + 4, size, SHEET_INK, least);
    sheet_text(s, x + sheet_text_width(least, size) + free / 2, y + HEIGHT + 4, size, SHEET_INK, unit);
    sheet_text(s, end, y + HEIGHT + 4, size, SHEET_INK, most);
}

float *sheet_shrink(const float *pixels, int width, int height, int k)
{
    int w = width / k, h = height / k;
    float *out = mem_alloc((size_t)w * (size_t)h * 3, sizeof *out);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            for (size_t c = 0; c < 3; c++) {
                double sum = 0;
                for (int j = 0; j < k; j++)
                    for (int i = 0; i < k; i++)
                        sum += (double)pixels[3 * ((size_t)(y * k + j) * (size_t)width + (size_t)(x * k + i)) + c];
                out[3 * ((size_t)y * (size_t)w + (size_t)x) + c] = (float)(sum / ((double)k * k));
            }
    return out;
}

/* --- letters, drawn as they look ---------------------------------------------------------------------- */

/* Sixteen letters a band, from space to tilde, each six columns wide. */
enum { FIRST = ' ', LAST = '~', PER_BAND = 16 };
static const char *const BAND[6][FONT_HEIGHT] = {
    {"        #    # #   # #    #   ##     ##     #      #   #",
     "        #    # #   # #   #### ##  # #  #    #     #     #     #     #                         #",
     "        #    # #  ##### # #      #  # #     #    #       #  # # #   #                        #",
     "        #          # #   ###    #    #           #       #   ###  #####       #####         #",
     "        #         #####   # #  #    # # #        #       #  # # #   #                      #",
     "                   # #  ####  #  ## #  #          #     #     #     #    ##          ##   #",
     "        #          # #    #      ##  ## #          #   #                  #          ##",
     "                                                                         #"},
    {" ###    #    ###  #####    #  #####   ##  #####  ###   ###                 #         #     ###",
     "#   #  ##   #   #    #    ##  #      #        # #   # #   #  ##    ##     #           #   #   #",
     "#  ##   #       #   #    # #  ####  #        #  #   # #   #  ##    ##    #    #####    #      #",
     "# # #   #      #     #  #  #      # ####    #    ###   ####             #               #    #",
     "##  #   #     #       # #####     # #   #  #    #   #     #  ##          #    #####    #    #",
     "#   #   #    #    #   #    #  #   # #   #  #    #   #    #   ##    ##     #           #",
     " ###   ###  #####  ###     #   ###   ###   #     ###   ##           #      #         #      #",
     "                                                                   #"},
    {" ###   ###  ####   ###  ###   ##### #####  ###  #   #  ###    ### #   # #     #   # #   #  ###",
     "#   # #   # #   # #   # #  #  #     #     #   # #   #   #      #  #  #  #     ## ## #   # #   #",
     "# ### #   # #   # #     #   # #     #     #     #   #   #      #  # #   #     # # # ##  # #   #",
     "# # # ##### ####  #     #   # ####  ####  # ### #####   #      #  ##    #     # # # # # # #   #",
     "# ### #   # #   # #     #   # #     #     #   # #   #   #      #  # #   #     #   # #  ## #   #",
     "#     #   # #   # #   # #  #  #     #     #   # #   #   #   #  #  #  #  #     #   # #   # #   #",
     " ###  #   # ####   ###  ###   ##### #      #### #   #  ###   ##   #   # ##### #   # #   #  ###",
     ""},
    {"####   ###  ####   #### ##### #   # #   # #   # #   # #   # #####  ###         ###    #",
     "#   # #   # #   # #       #   #   # #   # #   # #   # #   #     #  #    #        #   # #",
     "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #   #     #       #  #   #",
     "####  #   # ####   ###    #   #   # #   # # # #   #     #     #    #      #      #",
     "#     # # # # #       #   #   #   # #   # # # #  # #    #    #     #       #     #",
     "#     #  #  #  #      #   #   #   #  # #  # # # #   #   #   #      #        #    #",
     "#      ## # #   # ####    #    ###    #    # #  #   #   #   #####  ###         ###        #####",
     ""},
    {" #          #               #         ##        #       #      #  #      ##",
     "  #         #               #        #  #       #                 #       #",
     "       ###  ####   ###   ####  ###   #     #### ####   ##     ##  #  #    #   ## #  ####   ###",
     "          # #   # #     #   # #   # ###   #   # #   #   #      #  # #     #   # # # #   # #   #",
     "       #### #   # #     #   # #####  #    #   # #   #   #      #  ##      #   # # # #   # #   #",
     "      #   # #   # #   # #   # #      #     #### #   #   #      #  # #     #   # # # #   # #   #",
     "       #### ####   ###   ####  ###   #        # #   #  ###  #  #  #  #   ###  # # # #   #  ###",
     "                                           ###               ##"},
    {"                         #                                           #    #    #",
     "                         #                                          #     #     #",
     "####   #### # ##   #### ###   #   # #   # #   # #   # #   # #####   #     #     #    #  #",
     "#   # #   # ##  # #      #    #   # #   # #   #  # #  #   #    #   #      #      #  # # #",
     "#   # #   # #      ###   #    #   # #   # # # #   #   #   #   #     #     #     #   #  #",
     "####   #### #         #  #  # #  ##  # #  # # #  # #   ####  #      #     #     #",
     "#         # #     ####    ##   ## #   #    # #  #   #     # #####    #    #    #",
     "#         #                                            ###"},
};

bool font_pixel(char letter, int x, int y)
{
    int number = (letter >= FIRST && letter <= LAST ? letter : '?') - FIRST;
    const char *row = BAND[number / PER_BAND][y];
    size_t at = (size_t)(number % PER_BAND * FONT_ADVANCE + x);
    return at < strlen(row) && row[at] == '#';
}

/* --- colours for numbers ------------------------------------------------------------------------------ */

/* At equal distances, sRGB bytes; between two of them the map is linear in these. */
enum { VIRIDIS_STOPS = 10 };
static const uint8_t VIRIDIS[VIRIDIS_STOPS][3] = {{68, 1, 84},    {72, 40, 120},  {62, 73, 137},  {49, 104, 142},
                                           {38, 130, 142}, {31, 158, 137}, {53, 183, 121}, {110, 206, 88},
                                           {181, 222, 43}, {253, 231, 37}};

void viridis(double t, float out[3])
{
    double at = t > 0 ? (t < 1 ? t : 1) * (VIRIDIS_STOPS - 1) : 0; /* NaN too */
    int i = at < VIRIDIS_STOPS - 2 ? (int)at : VIRIDIS_STOPS - 2;
    for (int c = 0; c < 3; c++)
        out[c] = (float)srgb_decode((VIRIDIS[i][c] + (at - i) * (VIRIDIS[i + 1][c] - VIRIDIS[i][c])) / 255);
}
