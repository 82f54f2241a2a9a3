/* nurbs.h: non-uniform rational B-spline surfaces as triangles [Piegl & Tiller 1997].
 *
 * Tests: test_curve.c.
 */
#ifndef ASBDPT_NURBS_H
#define ASBDPT_NURBS_H

#include "geometry/shape.h"

enum { NURBS_MOST_ORDER = 32, NURBS_DICE = 30 };

/* One of the two parameters. */
struct nurbs_axis {
    int n, order;       /* control points; degree + 1, from 2 to NURBS_MOST_ORDER */
    const double *knot; /* [n + order], never falling */
    double from, to;    /* the part that is seen, knot[order - 1] <= from < to <= knot[n] */
};

/* nurbs_is_usable: does the axis keep what its comments say? */
bool nurbs_is_usable(const struct nurbs_axis *a);

/* nurbs_mesh: fill *m, an empty mesh, with as many triangles as pbrt-v3 does, the corners' normals and parameters.
 *   Pw  [v.n][u.n][4] control points, x y z times their weight, and that
 * Returns false with a message if these are more than `most`, or a point of the surface is nowhere: where weights add
 * up to 0 or less. */
bool nurbs_mesh(const struct nurbs_axis *u, const struct nurbs_axis *v, const double *Pw, struct mesh *m, int most,
                struct error *err);

#endif
