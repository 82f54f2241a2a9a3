/* kd_plane.c: see kd_plane.h. The heuristic is that of [Wald & Havran 2006], with bins; polygons are clipped as
 * in [Sutherland & Hodgman 1974], one plane of the box after the other.
 *
 * Where a ray that crosses a cell of surface S meets a part of it of surface S' with probability S'/S, a cell cut
 * into parts that cost C0 and C1 to test costs
 *     C = KD_VISIT_COST + (C0 S0 + C1 S1) / S,    against its own test if it stays a leaf  [Wald & Havran 2006]
 * A leaf is tested in blocks of KD_LANES items, so its cost is the number of blocks. Counting the items that begin and
 * that end in each of BINS equal parts of an axis gives C at the bins' ends, in one pass and without sorting. The ends
 * of the items' common bounds are tried as well: they cut off empty space, and there the planes must be exact.
 *
 * With leaves of several blocks, trying every beginning and end of an item instead gains at most 3 % of the rays'
 * time and takes 20 to 40 % more of the builder's.
 */
#include "geometry/kd_plane.h"

#include "base/number.h"
#include "geometry/kd_block.h"

/* --- the cheapest plane ------------------------------------------------------------------------------- */

enum { FEW = 64, BINS_OF_FEW = 32, BINS = 128 };

/* C leaves out that a ray ends at its first hit. Where many items all cross a cell, as planes in three directions do,
 * no cut has a lower C (one through the middle of a cube has 10/9 of it), but a ray is at its end in the first of many
 * small parts. */
enum { MANY = 128 };
static const double LOSS = 1.2;

double kd_leaf_cost(size_t n) { return (double)((n + KD_LANES - 1) / KD_LANES); }

double kd_half_area(const struct box *b)
{
    double x = (double)b->hi[0] - b->lo[0], y = (double)b->hi[1] - b->lo[1], z = (double)b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

/* The planes across one axis of a cell. */
struct axis_bins {
    int number;
    float cell_lo, cell_hi;
    double fixed;         /* KD_VISIT_COST times the cell's half area */
    double below0, slope; /* the half area below x is below0 + slope x */
    double above0;        /* and above it above0 - slope x */
    float lo, hi;         /* bounds of the items */
    float scale;          /* bins per metre */
    int n_bins;
    int begin[BINS], end[BINS]; /* weight of the items that do so in each bin */
    int planar_lo, planar_hi;   /* of those that lie in the planes at lo, hi */
};

static void axis_start(struct axis_bins *a, int k, const struct box *cell, const struct kd_ref *ref, size_t n)
{
    double u = (double)cell->hi[(k + 1) % 3] - cell->lo[(k + 1) % 3];
    double v = (double)cell->hi[(k + 2) % 3] - cell->lo[(k + 2) % 3];
    float lo = ref[0].box.lo[k], hi = ref[0].box.hi[k];
    for (size_t i = 1; i < n; i++) {
        lo = ref[i].box.lo[k] < lo ? ref[i].box.lo[k] : lo;
        hi = ref[i].box.hi[k] > hi ? ref[i].box.hi[k] : hi;
    }
    a->number = k;
    a->cell_lo = cell->lo[k];
    a->cell_hi = cell->hi[k];
    a->fixed = KD_VISIT_COST * kd_half_area(cell);
    a->slope = u + v;
    a->below0 = u * v - a->slope * a->cell_lo;
    a->above0 = u * v + a->slope * a->cell_hi;
    a->lo = lo;
    a->hi = hi;
    a->n_bins = n <= FEW ? BINS_OF_FEW : BINS;
    a->scale = 0.999999f * (float)a->n_bins / (hi - lo); /* so that hi itself is in the last bin */
    a->planar_lo = a->planar_hi = 0;
    for (int i = 0; i < a->n_bins; i++)
        a->begin[i] = a->end[i] = 0;
}

/* lo - a->lo is within [0, hi - lo], finite because shapes lie within 1e12 (shape.c), and scale is below 1e30: a bin's
 * number is 0 to n_bins - 1. */
static void axis_fill(struct axis_bins *a, const struct kd_ref *ref, size_t n)
{
    int k = a->number;
    for (size_t i = 0; i < n; i++) {
        float lo = ref[i].box.lo[k], hi = ref[i].box.hi[k];
        int weight = kd_weight(&ref[i]);
        a->begin[(int)((lo - a->lo) * a->scale)] += weight;
        a->end[(int)((hi - a->lo) * a->scale)] += weight;
        a->planar_lo += hi <= a->lo ? weight : 0;
        a->planar_hi += lo >= a->hi ? weight : 0;
    }
}

static void try_plane(const struct axis_bins *a, float x, size_t below, size_t above, bool planar_below,
                     struct kd_plane *best)
{
    double cost = a->fixed + (a->below0 + a->slope * x) * kd_leaf_cost(below) +
                  (a->above0 - a->slope * x) * kd_leaf_cost(above);
    if (cost < best->cost) {
        best->cost = cost;
        best->axis = a->number;
        best->at = x;
        best->planar_below = planar_below;
    }
}

/* The planes at both ends of the items' bounds. On the cell's own face a plane is of use only to put what lies in
 * it into a cell of its own. */
static void try_ends(const struct axis_bins *a, size_t n, struct kd_plane *best)
{
    size_t planar_lo = (size_t)a->planar_lo, planar_hi = (size_t)a->planar_hi;
    if (a->lo > a->cell_lo)
        try_plane(a, a->lo, 0, n, false, best);
    if (planar_lo > 0 && a->lo < a->cell_hi)
        try_plane(a, a->lo, planar_lo, n - planar_lo, true, best);
    if (a->hi < a->cell_hi)
        try_plane(a, a->hi, n, 0, true, best);
    if (planar_hi > 0 && a->hi > a->cell_lo)
        try_plane(a, a->hi, n - planar_hi, planar_hi, false, best);
}

/* The planes between bins. */
static void try_bins(const struct axis_bins *a, size_t n, struct kd_plane *best)
{
    size_t below = 0, above = n;
    for (int i = 0; i + 1 < a->n_bins; i++) {
        float x = a->lo + (float)(i + 1) / a->scale;
        below += (size_t)a->begin[i];
        above -= (size_t)a->end[i];
        if (x > a->cell_lo && x < a->cell_hi)
            try_plane(a, x, below, above, true, best);
    }
}

struct kd_plane kd_best_plane(const struct kd_ref *ref, size_t n, const struct box *cell)
{
    size_t weight = 0;
    for (size_t i = 0; i < n; i++)
        weight += (size_t)kd_weight(&ref[i]);
    double loss = n > MANY ? LOSS : 1;
    struct kd_plane best = {-1, 0, false, loss * kd_leaf_cost(weight) * kd_half_area(cell)};
    for (int k = 0; k < 3 && n > 0; k++) {
        struct axis_bins a;
        axis_start(&a, k, cell, ref, n);
        if (a.lo == a.hi) {
            a.planar_lo = a.planar_hi = (int)weight;
            try_ends(&a, weight, &best);
        } else if (a.scale < 1e30f) {
            axis_fill(&a, ref, n);
            try_ends(&a, weight, &best);
            try_bins(&a, weight, &best);
        }
    }
    return best;
}

/* --- clipping ----------------------------------------------------------------------------------------- */

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

/* Bounds of what is left, rounded outwards, within the cell. */
static void polygon_bounds(const struct polygon *poly, const struct box *cell, struct box *out)
{
    for (int k = 0; k < 3; k++) {
        double lo = poly->p[0][k], hi = lo;
        for (int i = 1; i < poly->n; i++) {
            lo = poly->p[i][k] < lo ? poly->p[i][k] : lo;
            hi = poly->p[i][k] > hi ? poly->p[i][k] : hi;
        }
        float low = float_below(lo), high = float_above(hi);
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
            polygon_bounds(&half, &half_cell, &part[side]);
    }
}
