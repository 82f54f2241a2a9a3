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

#include "base/vec.h"

/* polygon_cut: if this fan does not lie in its polygon, seen along the polygon's normal, put ears in its place. Of a
 * polygon that crosses itself some triangles lie anywhere.
 *   P      [n_vertices] points
 *   index  [3*(n-2)] into P: the fan (0,1,2), (3,0,2), (4,0,3) ... of the corners 0 ... n-1; n >= 4
 *   room   in-out: how many tests of a corner against a triangle it may take; false if that is too few */
bool polygon_cut(const vec3 *P, uint32_t *index, int n, double *room);

#endif
