/* kd_clip.c: see kd_clip.h. Sutherland and Hodgman's polygon clipping, one plane of the box after the other. */
#include "geometry/kd_clip.h"

#include <float.h>
#include <math.h>

/* Each of the seven planes adds one corner to a convex polygon, which makes 10. Rounding can bend a sliver so that
 * a plane cuts it more often; half as many corners again is the most one plane can leave: 3 4 6 9 13 19 28 42. */
enum { MAX_CORNERS = 42 };

struct polygon {
    double p[MAX_CORNERS][3];
    int n;
};

/* Out: what of `in` is on the side of `sign` (+1: above, -1: below) of the plane at `plane` of the axis. */
static void clip_to_plane(const struct polygon *in, int axis, double plane, double sign, struct polygon *out)
{
    out->n = 0;
    for (int i = 0; i < in->n; i++) {
        const double *a = in->p[i], *b = in->p[i + 1 < in->n ? i + 1 : 0];
        double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
        if (da >= 0) {
            double *q = out->p[out->n++];
            for (int k = 0; k < 3; k++)
                q[k] = a[k];
        }
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            double *q = out->p[out->n++], along = da / (da - db);
            for (int k = 0; k < 3; k++)
                q[k] = a[k] + (b[k] - a[k]) * along;
            q[axis] = plane;
        }
    }
}

/* The triangle within the cell, in buffer[0] or buffer[1]. Planes that all corners are inside of are skipped. */
static struct polygon *clip_to_cell(const float v[9], const struct box *cell, struct polygon buffer[2])
{
    struct polygon *in = &buffer[0], *out = &buffer[1];
    in->n = 3;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            in->p[i][k] = v[3 * i + k];
    for (int side = 0; side < 6; side++) {
        int k = side / 2;
        float plane = side % 2 == 0 ? cell->lo[k] : cell->hi[k];
        float sign = side % 2 == 0 ? 1.0f : -1.0f;
        if (sign * v[k] >= sign * plane && sign * v[3 + k] >= sign * plane && sign * v[6 + k] >= sign * plane)
            continue;
        clip_to_plane(in, k, plane, sign, out);
        struct polygon *swap = in;
        in = out;
        out = swap;
    }
    return in;
}

static float round_down(double x)
{
    float f = (float)x;
    return (double)f > x ? nextafterf(f, -FLT_MAX) : f;
}

static void bounds_of(const struct polygon *poly, const struct box *cell, struct box *out)
{
    for (int k = 0; k < 3; k++) {
        double lo = poly->p[0][k], hi = lo;
        for (int i = 1; i < poly->n; i++) {
            lo = poly->p[i][k] < lo ? poly->p[i][k] : lo;
            hi = poly->p[i][k] > hi ? poly->p[i][k] : hi;
        }
        float low = round_down(lo), high = -round_down(-hi);
        out->lo[k] = low > cell->lo[k] ? low : cell->lo[k];
        out->hi[k] = high < cell->hi[k] ? high : cell->hi[k];
    }
}

void kd_split_triangle(const float v[9], const struct box *cell, int axis, float split, struct box part[2],
                       bool filled[2])
{
    struct polygon buffer[2], half;
    const struct polygon *whole = clip_to_cell(v, cell, buffer);
    for (int side = 0; side < 2; side++) {
        struct box half_cell = *cell;
        if (side == 0)
            half_cell.hi[axis] = split;
        else
            half_cell.lo[axis] = split;
        clip_to_plane(whole, axis, split, side == 0 ? -1 : 1, &half);
        filled[side] = half.n > 0;
        if (filled[side])
            bounds_of(&half, &half_cell, &part[side]);
    }
}
