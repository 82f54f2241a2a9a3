/* splat.c: see splat.h. */
#include "scene/splat.h"

#include <math.h>

#include "base/number.h"

/* First pixel whose filter covers the raster coordinate p on one axis, and the one after the last. */
static void filter_span(double p, double radius, int low, int high, int *first, int *end)
{
    double a = floor(p - radius + 0.5), b = floor(p + radius - 0.5); /* |p - (i + 0.5)| <= radius */
    if (2 * radius == 1) /* half-open: a point belongs to exactly one pixel */
        a = b = floor(p);
    *first = int_within(a, low, high); /* a NaN covers nothing */
    *end = int_within(b + 1, low, high);
}

struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within)
{
    struct pixel_rect r = {0, 0, 0, 0, 0, 0};
    filter_span(s->px, filter->radius[0], within.x0, within.x1, &r.x0, &r.x1);
    filter_span(s->py, filter->radius[1], within.y0, within.y1, &r.y0, &r.y1);
    return r;
}

bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3])
{
    rgb part = rgb_scale(s->value, filter_eval(filter, s->px - (x + 0.5), s->py - (y + 0.5)));
    if (!rgb_fits_float(part))
        return false;
    out[0] = (float)part.r;
    out[1] = (float)part.g;
    out[2] = (float)part.b;
    return true;
}
