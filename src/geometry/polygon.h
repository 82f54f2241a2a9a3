/* polygon.h: polygons in triangles.
 *
 * A fan around the first corner fits all convex polygons and many others: it is pbrt-v3's cut of a quadrilateral. Where
 * it leaves the polygon or covers a part twice, ears are cut off one by one: an ear is a triangle of three corners in
 * a row, in which no other corner lies. Every simple polygon has two (Meisters 1975).
 * Tests: test_ply.c.
 */
#ifndef ASBDPT_POLYGON_H
#define ASBDPT_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

/* polygon_fan_fits: does this fan lie in its polygon, seen along the polygon's normal?
 *   P      [n_vertices*3] points
 *   index  [3*(n-2)] into P: the fan (0,1,2), (3,0,2), (4,0,3) ... of the corners 0 ... n-1; n >= 4
 * polygon_cut_ears: cut the polygon of such a fan by ears, into as many triangles, in its place. Takes 3 n^2 tests of a
 * corner against a triangle at most. Of one that crosses itself some triangles lie anywhere. */
bool polygon_fan_fits(const float *P, const uint32_t *index, int n);
void polygon_cut_ears(const float *P, uint32_t *index, int n);

#endif
