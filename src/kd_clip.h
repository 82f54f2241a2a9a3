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

/* kd_clip_triangle: bounds of the triangle v (three corners) within the closed box; the true bounds are
 * rounded outwards to float, but not beyond the box. Returns false where nothing of the triangle is inside. */
bool kd_clip_triangle(const float v[9], const struct box *cell, struct box *out);

#endif
