/* kd_clip.h: which part of a triangle lies in a box? "Perfect splits" of [Wald & Havran 2006, 2.3]: a triangle
 * belongs to a cell only where it really passes, not where merely its bounding box does.
 *
 * Used by: kd_build.
 */
#ifndef ASBDPT_KD_CLIP_H
#define ASBDPT_KD_CLIP_H

#include <stdbool.h>

struct box {
    float lo[3], hi[3];
};

/* kd_split_triangle: bounds of the two parts into which the plane at `split` of `axis` cuts the triangle v (three
 * corners) within the closed box `cell`: part[0] below, part[1] above. The true bounds are rounded outwards to
 * float, but not beyond the half of the box. filled[i] tells whether there is anything of the triangle in it. */
void kd_split_triangle(const float v[9], const struct box *cell, int axis, float split, struct box part[2],
                       bool filled[2]);

#endif
