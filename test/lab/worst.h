/* worst.h: which samples are worth telling of: those of a render that contribute most to a pixel, by observers.
 *
 * Tests: test_trace.c.
 */
#ifndef ASBDPT_WORST_H
#define ASBDPT_WORST_H

#include "render/render.h"

/* What a sample contributes to one pixel: its own, or, of its light sub-path, another. */
struct brought {
    double luminance;
    int x, y; /* the sample */
    long iteration;
    int to_x, to_y; /* the pixel */
};

/* The samples that contribute most to a pixel, each with its most, in that order; equal ones by iteration and pixel:
 * what is in the list does not depend on the order of offers. All zeros except `most`: empty. */
enum { WORST_MOST = 64 };
struct worst {
    int n, most; /* 1 <= most <= WORST_MOST */
    struct brought item[WORST_MOST];
};

/* worst_offer: take it in, if it is among them. What no film takes is not. */
void worst_offer(struct worst *worst, struct brought b);

/* worst_render: render_scene, all samples being offered. */
bool worst_render(const struct scene *scene, const struct render_options *options, struct film *film,
                  struct worst *worst, struct error *err);

#endif
