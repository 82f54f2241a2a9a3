/* sheet.c: see sheet.h. */
#include "lab/sheet.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/picture.h"

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

void sheet_paste(struct sheet *s, int x, int y, const float *pixels, int width, int height, int k)
{
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++)
            fill(s, x + i * k, y + j * k, k, pixels + 3 * ((size_t)j * (size_t)width + (size_t)i));
}

void sheet_text(struct sheet *s, int x, int y, int size, double grey, const char *text)
{
    float value = (float)srgb_decode(grey), ink[3] = {value, value, value};
    for (; *text != '\0'; text++, x += FONT_ADVANCE * size)
        for (int j = 0; j < FONT_HEIGHT; j++)
            for (int i = 0; i < FONT_WIDTH; i++)
                if (font_pixel(*text, i, j))
                    fill(s, x + i * size, y + j * size, size, ink);
}

int sheet_text_width(const char *text, int size) { return (int)strlen(text) * FONT_ADVANCE * size; }

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
