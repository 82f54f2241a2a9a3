/* sheet.h: a sheet that pictures are pasted on and labels written on: figures as one file.
 *
 * Tests: test_sheet.c.
 */
#ifndef ASBDPT_SHEET_H
#define ASBDPT_SHEET_H

#include "lab/font.h"

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
 * sheet_text: one line of letters of this grey, `size` pixels for one of the font's; its top left is (x,y). */
void sheet_paste(struct sheet *s, int x, int y, const float *pixels, int width, int height, int k);
void sheet_text(struct sheet *s, int x, int y, int size, double grey, const char *text);

/* sheet_text_width: of a line, in pixels. */
int sheet_text_width(const char *text, int size);

/* sheet_shrink: average squares of k x k pixels, k not above width or height; what is left at the right and lower edge
 * is cut off. [(height/k)*(width/k)*3], to be freed. */
float *sheet_shrink(const float *pixels, int width, int height, int k);

#endif
