/* curve.h: curves that have a width: cubic Bezier curves, each with a tube around it or a ribbon along it.
 *
 * A curve of n pieces is a net: rows of points across it at 0, 1/n, ... 1, eight around a tube, two across a ribbon,
 * with two triangles between each four of them. The net is never stored: a row follows from the control points and the
 * frames at both ends of the curve. Two pieces compute the same numbers for the row that they share, so no ray slips
 * through. What a scene file calls a curve is cut into curves of a few pieces (strand.c), which share the frames at
 * their ends.
 *
 * Tests: test_curve.c.
 */
#ifndef ASBDPT_CURVE_H
#define ASBDPT_CURVE_H

#include <stdint.h>

#include "base/error.h"
#include "base/transform.h"
#include "geometry/triangle.h"

enum {
    CURVE_SIDES = 8, /* of a tube's cross section */
    CURVE_PIECES = 8 /* of a curve, at most */
};

/* What tells how a curve becomes a net, in object space. With the index [2]: at both ends. */
struct net {
    float tangent[2][3]; /* unit */
    float guide[2][3];   /* unit: next to it is a ribbon's normal, or the direction from a tube's middle to v = 0 */
    float turn;          /* ribbon: the angle between both guides, by which it turns evenly; tube: 0 */
    float radius[2];     /* of a tube's points, or half a ribbon's width */
    float u[2];
    int16_t pieces;
    bool ribbon;
};

/* A curve in object space. */
struct strand {
    vec3 P[4]; /* all the same: it fills the gap where a curve of a file has a corner */
    struct net net;
};

/* A curve in the world, or in the space of an object that instances place. */
struct curve {
    float P[4][3];
    struct net net;
    float slack; /* by which points of the net may be farther from the curve, since they are rounded to floats */
    int32_t place, group;
};

/* Curves with the same transform share it. */
struct curve_place {
    struct transform to_world;
    double stretch; /* no vector becomes longer by more than this factor */
    bool reverse;   /* ReverseOrientation */
};

struct curves {
    struct curve *curve;       /* [n] */
    struct curve_place *place; /* [n_places] */
    int n, n_places;
    size_t capacity;
};

/* curve_point: a point of a Bezier curve, and a tangent there: the chord where the derivative vanishes, as at
 * coinciding points, and z where that vanishes, too. */
vec3 curve_point(const vec3 P[4], double u, vec3 *tangent);

/* curves_add: place n of them in the world, one after the other. False, with nothing added, with a message if some of
 * it would be at no place (vec.h). curves_free releases all. */
bool curves_add(struct curves *all, const struct strand *s, int n, const struct transform *to_world, bool reverse,
                int group, struct error *err);
void curves_free(struct curves *all);

/* curve_bounds: a box around what a curve has in a closed box, which may be infinite; false if it has nothing there. */
bool curve_bounds(const struct curves *all, int curve, const float cell_lo[3], const float cell_hi[3], float lo[3],
                  float hi[3]);

/* curve_intersect: where is the first hit of a curve in (tmin, tmax)? False if there is none.
 *   begins, ends  the ray does so on this curve: where it meets it nearest to 0, or to tmax, does not count */
bool curve_intersect(const struct curves *all, int curve, const struct ray *ray, bool begins, bool ends,
                     struct hit *hit);

/* curve_triangle: the triangle of the net that was hit, and the hit's barycentric coordinates in it. */
void curve_triangle(const struct curves *all, int curve, const struct hit *hit, struct triangle *tri, double *b1,
                    double *b2);

#endif
