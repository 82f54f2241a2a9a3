/* sheet.h: a sheet that pictures are pasted on and labels written on: figures as one file; its letters and
 * colours.
 *
 * Tests: test_pictures.c.
 */
#ifndef ASBDPT_SHEET_H
#define ASBDPT_SHEET_H

#include <stdbool.h>

#include "base/error.h"

struct sheet {
    int width, height;
    float *pixels; /* [height*width*3], linear, top row first; owned */
};

/* Greys, 0 black to 1 white, as sRGB has it: of the figures' ground and letters. */
#define SHEET_PAPER 0.12
#define SHEET_INK 0.92

/* sheet_init: an empty one of a grey. Released by sheet_free. */
void sheet_init(struct sheet *s, int width, int height, double grey);
void sheet_free(struct sheet *s);

/* What is drawn beyond the sheet's edges is cut off.
 * sheet_paste: a picture, its top left pixel at (x,y), each pixel a square of k x k.
 *   pixels  [height*width*3] linear
 * sheet_cell: the same of a picture whose squares of shrink x shrink pixels are averaged first, times `exposure`.
 * sheet_text: one line of letters of this grey, in round strokes, `size` pixels wide as one of the font's; its top left
 * is (x,y). */
void sheet_paste(struct sheet *s, int x, int y, const float *pixels, int width, int height, int k);
void sheet_cell(struct sheet *s, int x, int y, const float *pixels, int width, int height, int shrink, int k,
                double exposure);
void sheet_text(struct sheet *s, int x, int y, int size, double grey, const char *text);

/* sheet_bar: the colours of viridis from left to right, and below them what the ends stand for and, between these, what
 * the numbers are. SHEET_BAR pixels high in all; letters are as large as there is room for. */
enum { SHEET_BAR = 34 };
void sheet_bar(struct sheet *s, int x, int y, int width, const char *least, const char *unit, const char *most);

/* sheet_text_width: of a line, in pixels. */
int sheet_text_width(const char *text, int size);

/* sheet_shrink: average squares of k x k pixels, k not above width or height; what is left at the right and lower edge
 * is cut off. [(height/k)*(width/k)*3], to be freed. */
float *sheet_shrink(const float *pixels, int width, int height, int k);

/* sheet_write: as DIRECTORY/NAME, a picture; the sheet is freed. False with a message. */
bool sheet_write(struct sheet *s, const char *directory, const char *name, struct error *err);

/* font_pixel: is pixel (x,y) of a letter ink? Letters are 5 x 7 pixels and a row for descenders; (0,0) is the top left
 * one. Others than printable ASCII are drawn as '?'. */
enum { FONT_WIDTH = 5, FONT_HEIGHT = 8, FONT_ADVANCE = FONT_WIDTH + 1 };
bool font_pixel(char letter, int x, int y);

/* viridis: the colour of t in a map that rises evenly in lightness and reads the same without one kind of cone
 * [Smith 2015], as linear light; below 0 and NaN are as 0, above 1 as 1. */
void viridis(double t, float out[3]);

#endif
