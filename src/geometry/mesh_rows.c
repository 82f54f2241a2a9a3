/* mesh_rows.c: the shapes of triangles; see mesh.h. A new one is a new file and a line here. */
#include "geometry/mesh.h"

extern const struct shape_row shape_trianglemesh, shape_plymesh, shape_loopsubdiv, shape_curve;

const struct shape_row *const shape_rows[] = {&shape_trianglemesh, &shape_plymesh, &shape_loopsubdiv, &shape_curve,
                                              NULL};
