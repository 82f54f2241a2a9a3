/* pixel_rect.h: rectangles of pixels, [x0,x1) x [y0,y1). */
#ifndef ASBDPT_PIXEL_RECT_H
#define ASBDPT_PIXEL_RECT_H

#include <stddef.h>

struct pixel_rect {
    int x0, y0, x1, y1;
};

static inline int rect_width(struct pixel_rect r) { return r.x1 - r.x0; }
static inline int rect_height(struct pixel_rect r) { return r.y1 - r.y0; }
static inline size_t rect_pixels(struct pixel_rect r) { return (size_t)rect_width(r) * (size_t)rect_height(r); }

#endif
