/* nurbs.c: see nurbs.h. */
#include "geometry/nurbs.h"

#include "geometry/subdivide.h"

bool nurbs_is_usable(const struct nurbs_axis *a)
{
    for (int i = 1; i < a->n + a->order; i++)
        if (!(a->knot[i - 1] <= a->knot[i]))
            return false;
    return a->order >= 2 && a->order <= NURBS_MOST_ORDER && a->n >= a->order && a->knot[a->order - 1] <= a->from &&
           a->from < a->to && a->to <= a->knot[a->n];
}

/* The control points that count at a parameter, first to first + order - 1, and how much: values and derivatives. */
struct basis {
    int first;
    double value[NURBS_MOST_ORDER], slope[NURBS_MOST_ORDER];
};

/* Each order's functions from those of the order below, of which the last step gives the derivatives, too.
 * [Piegl & Tiller 1997] */
static void evaluate(const struct nurbs_axis *a, double t, struct basis *out)
{
    const double *knot = a->knot;
    int span = a->order - 1;
    while (span < a->n - 1 && (t > knot[span + 1] || knot[span] == knot[span + 1]))
        span++;
    out->first = span - a->order + 1;
    double N[NURBS_MOST_ORDER + 1] = {1};
    for (int degree = 1; degree < a->order; degree++) {
        double before = 0, slope_before = 0;
        for (int i = 0; i <= degree; i++) {
            int k = span - degree + i + 1; /* N[i] of the degree below lives on knot[k] to knot[k + degree] */
            double per = i < degree ? N[i] / (knot[k + degree] - knot[k]) : 0;
            double slope = degree * per, rising = (t - knot[k]) * per;
            out->slope[i] = slope_before - slope;
            N[i] = before + (i < degree ? (knot[k + degree] - t) * per : 0);
            before = rising;
            slope_before = slope;
        }
    }
    for (int i = 0; i < a->order; i++)
        out->value[i] = N[i];
}

/* A point, and its derivatives by u and v: of a quotient of which the last component is the denominator. */
static bool surface(const struct nurbs_axis *u, const struct basis *bu, const struct nurbs_axis *v,
                    const struct basis *bv, const double *Pw, vec3 *p, vec3 *normal)
{
    double sum[4] = {0}, du[4] = {0}, dv[4] = {0};
    for (int j = 0; j < v->order; j++)
        for (int i = 0; i < u->order; i++) {
            const double *at = Pw + 4 * ((bv->first + j) * u->n + bu->first + i);
            for (int k = 0; k < 4; k++) {
                sum[k] += bu->value[i] * bv->value[j] * at[k];
                du[k] += bu->slope[i] * bv->value[j] * at[k];
                dv[k] += bu->value[i] * bv->slope[j] * at[k];
            }
        }
    double w = sum[3];
    *p = mul(vec(sum[0], sum[1], sum[2]), 1 / w);
    vec3 dpdu = mul(sub(vec(du[0], du[1], du[2]), mul(*p, du[3])), 1 / w);
    vec3 dpdv = mul(sub(vec(dv[0], dv[1], dv[2]), mul(*p, dv[3])), 1 / w);
    vec3 n = cross(dpdu, dpdv);
    *normal = length2(n) > 0 && isfinite(length2(n)) ? normalize(n) : vec(0, 0, 0);
    return w > 0 && is_place(*p);
}

bool nurbs_mesh(const struct nurbs_axis *u, const struct nurbs_axis *v, const double *Pw, struct mesh *m, int most,
                struct error *err)
{
    struct basis bu, bv;
    vec3 p, n;
    if (most < 2 * (NURBS_DICE - 1) * (NURBS_DICE - 1))
        return error_set(err, "curves and other subdivided surfaces have more than %d triangles in all; leave some out",
                         SUBDIVIDE_MAX_TRIANGLES);
    mesh_grid(m, NURBS_DICE, NURBS_DICE, true);
    for (int i = 0; i < NURBS_DICE * NURBS_DICE; i++) {
        double s = (i % NURBS_DICE) / (NURBS_DICE - 1.0), t = (i / NURBS_DICE) / (NURBS_DICE - 1.0);
        s = (1 - s) * u->from + s * u->to;
        t = (1 - t) * v->from + t * v->to;
        evaluate(u, s, &bu);
        evaluate(v, t, &bv);
        if (!surface(u, &bu, v, &bv, Pw, &p, &n))
            return error_set(err, "these weights leave no point at (u,v) = (%g,%g)", s, t);
        store3(m->P, (size_t)i, p);
        store3(m->N, (size_t)i, n);
        m->UV[2 * i] = (float)s;
        m->UV[2 * i + 1] = (float)t;
    }
    return true;
}
