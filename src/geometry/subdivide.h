/* subdivide.h: Loop subdivision of triangle meshes, as pbrt-v3's "loopsubdiv" defines it.
 *
 * Each level cuts every triangle in four and moves the vertices; at the end they are moved to where infinitely many
 * levels would take them, and get the normals of that limit surface. [Loop 1987] [PBRT3 3.8]
 *
 * Tests: test_subdivide.c.
 */
#ifndef ASBDPT_SUBDIVIDE_H
#define ASBDPT_SUBDIVIDE_H

#include "geometry/shape.h"

/* mesh_subdivide: replace the control mesh, of which N and UV are not looked at, by its surface after so many levels,
 * >= 0. Normals point as in pbrt-v3: to the side from which the corners of a triangle run clockwise. Points that no
 * triangle uses stay where they are. Returns false with a message, and the mesh as it was, when an edge has more than
 * two triangles, or two that run along it the same way, or when there would be more than `most` triangles. */
bool mesh_subdivide(struct mesh *m, int levels, int most, struct error *err);

#endif
