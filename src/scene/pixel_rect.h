/* pixel_rect.h: rectangles of pixels, of which some columns and rows may be left out. */
#ifndef ASBDPT_PIXEL_RECT_H
#define ASBDPT_PIXEL_RECT_H

#include <stddef.h>

/* Pixels [x0,x1) x [y0,y1), but that after each column skip_x others are left out, and skip_y after each row. */
struct pixel_rect {
    int x0, y0, x1, y1;
    int skip_x, skip_y; /* 0 unless said otherwise */
};

/* rect_width, rect_height: columns and rows that are not left out. */
static inline int rect_width(struct pixel_rect r) { return (r.x1 - r.x0 + r.skip_x) / (r.skip_x + 1); }
static inline int rect_height(struct pixel_rect r) { return (r.y1 - r.y0 + r.skip_y) / (r.skip_y + 1); }
static inline size_t rect_pixels(struct pixel_rect r) { return (size_t)rect_width(r) * (size_t)rect_height(r); }

#endif
