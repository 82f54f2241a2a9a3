/* kd_clip.c: see kd_clip.h. Sutherland and Hodgman's polygon clipping, one plane of the box after the other. */
#include "kd_clip.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Each of the six planes adds one corner to a convex polygon, which makes 9. Rounding can bend a sliver so that a
 * plane cuts it more often; half as many corners again per plane is the most there can be, 3 4 6 9 13 19 28. */
enum { MAX_CORNERS = 28 };

struct polygon {
    double p[MAX_CORNERS][3];
    int n;
};

/* Keep what is on the side of `sign` (+1: above, -1: below) of the plane at `plane` of the axis. */
static void clip_to_plane(struct polygon *poly, int axis, double plane, double sign)
{
    struct polygon in;
    in.n = poly->n;
    memcpy(in.p, poly->p, (size_t)in.n * sizeof in.p[0]);
    poly->n = 0;
    for (int i = 0; i < in.n; i++) {
        const double *a = in.p[i], *b = in.p[i + 1 < in.n ? i + 1 : 0];
        double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
        if (da >= 0) {
            double *q = poly->p[poly->n++];
            for (int k = 0; k < 3; k++)
                q[k] = a[k];
        }
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            double *q = poly->p[poly->n++];
            for (int k = 0; k < 3; k++)
                q[k] = a[k] + (b[k] - a[k]) * (da / (da - db));
            q[axis] = plane;
        }
    }
}

static float round_down(double x)
{
    float f = (float)x;
    return f > x ? nextafterf(f, -FLT_MAX) : f;
}

bool kd_clip_triangle(const float v[9], const struct box *cell, struct box *out)
{
    struct polygon poly;
    poly.n = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            poly.p[i][k] = v[3 * i + k];
    for (int k = 0; k < 3; k++) {
        if (v[k] < cell->lo[k] || v[3 + k] < cell->lo[k] || v[6 + k] < cell->lo[k])
            clip_to_plane(&poly, k, cell->lo[k], 1);
        if (v[k] > cell->hi[k] || v[3 + k] > cell->hi[k] || v[6 + k] > cell->hi[k])
            clip_to_plane(&poly, k, cell->hi[k], -1);
    }
    if (poly.n == 0)
        return false;
    for (int k = 0; k < 3; k++) {
        double lo = poly.p[0][k], hi = lo;
        for (int i = 1; i < poly.n; i++) {
            lo = poly.p[i][k] < lo ? poly.p[i][k] : lo;
            hi = poly.p[i][k] > hi ? poly.p[i][k] : hi;
        }
        out->lo[k] = fmaxf(round_down(lo), cell->lo[k]);
        out->hi[k] = fminf(-round_down(-hi), cell->hi[k]);
    }
    return true;
}
