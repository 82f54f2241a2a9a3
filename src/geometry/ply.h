/* ply.h: triangle meshes from PLY files (ascii, binary little and big endian; header lines end in LF, CR LF or CR).
 *
 * Vertex: x y z [nx ny nz] [u v | s t | texture_u texture_v | texture_s texture_t], any scalar type. Faces:
 * a list property vertex_indices (or vertex_index) of any integer types; polygons are cut into triangles (polygon.h),
 * and those of fewer than 3 corners left out. Tristrips: such a list of strips of triangles, between which -1 stands.
 * Other properties and elements are read over. Normals and texture coordinates that
 * are not finite become 0.
 *
 * Tests: test_ply.c.
 */
#ifndef ASBDPT_PLY_H
#define ASBDPT_PLY_H

#include "base/error.h"
#include "geometry/shape.h"

/* Elements of a file, of which few are of use; its bytes for a triangle, which takes some 1000 as a light; and the
 * tests for each byte that cutting polygons may take. */
enum { PLY_MAX_ELEMENTS = 64, PLY_BYTES_PER_TRIANGLE = 2, PLY_TESTS_PER_BYTE = 256 };

/* ply_read: read a mesh. Returns false with a message "PATH: ..." (a line of the header, or a row of an element) on a
 * missing, truncated or malformed file, an index out of range, a non-finite position, or counts the file is
 * too short to hold, and when there are no faces; *out is then empty. */
bool ply_read(const char *path, struct mesh *out, struct error *err);

#endif
