/* curve.h: pbrt-v3's curves as triangles.
 *
 * A curve is a row of segments with a width: a strip that turns to each ray ("flat", or "cylinder" with the normals of
 * a tube), or one that follows normals ("ribbon"). What turns to each ray is no surface on which light could go both
 * ways, so both of the former become the tube that looks as wide.
 *
 * Tests: test_curve.c.
 */
#ifndef ASBDPT_CURVE_H
#define ASBDPT_CURVE_H

#include "geometry/shape.h"

struct curve {
    const double *P;     /* [n*3] control points */
    int n, degree;       /* degree 2 or 3 */
    bool bspline;        /* uniform B-spline, else Bezier, of which segments share their end points */
    double width[2];     /* at both ends, >= 0 */
    const double *N;     /* [(curve_segments + 1)*3] normals of a ribbon, or NULL: a tube */
};

/* curve_segments: how many segments the control points make; 0 if they are too few or too many for whole ones. */
int curve_segments(const struct curve *c);

/* curve_mesh: fill *m, an empty mesh, with a curve that has segments, within about a twentieth of its width, as pbrt-v3
 * refines it. u runs along each segment, v around the tube or across the ribbon. A curve without width leaves the mesh
 * empty. Returns false with a message when there would be more than `most` triangles. */
bool curve_mesh(const struct curve *c, struct mesh *m, int most, struct error *err);

#endif
