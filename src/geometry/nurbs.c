/* nurbs.c: see nurbs.h. */
#include "geometry/nurbs.h"

#include <stdlib.h>

#include "base/mem.h"
#include "geometry/mesh.h"

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
                         MESH_MAX_SUBDIVIDED);
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

/* --- the row ------------------------------------------------------------------------------------------ */

struct axis_fields {
    int n, order;
    double from, to;
    struct field_list knots;
};

struct nurbs {
    struct axis_fields u, v;
    struct field_list P, Pw;
};

static bool axis(const struct axis_fields *f, char name, struct mesh_task *task, struct nurbs_axis *out)
{
    const double *knot = f->knots.number;
    bool ok = knot != NULL && f->order >= 2 && f->n >= f->order && f->knots.n == f->n + f->order;
    struct nurbs_axis a = {f->n, f->order, knot, ok && f->from == FIELD_NONE ? knot[f->order - 1] : f->from,
                           ok && f->to == FIELD_NONE ? knot[f->n] : f->to};
    *out = a;
    return (ok && nurbs_is_usable(&a)) ||
           error_set(&task->err, "a nurbs needs \"%corder\" from 2 to %d, \"n%c\" not less than that, as many numbers "
                     "as both together in \"%cknots\" that never fall, and \"%c0\" < \"%c1\" within the inner ones",
                     name, NURBS_MOST_ORDER, name, name, name, name);
}

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct nurbs *f = fields;
    struct nurbs_axis u, v;
    if (!axis(&f->u, 'u', task, &u) || !axis(&f->v, 'v', task, &v))
        return false;
    int n = f->P.number != NULL ? f->P.n : f->Pw.n;
    if (n != u.n * v.n)
        return error_set(&task->err, "a nurbs needs nu nv = %d points \"P\" or \"Pw\", not %d", u.n * v.n, n);
    double *Pw = mem_alloc((size_t)n, 4 * sizeof *Pw);
    for (int i = 0; i < 4 * n; i++)
        Pw[i] = f->P.number == NULL ? f->Pw.number[i] : i % 4 == 3 ? 1 : f->P.number[i / 4 * 3 + i % 4];
    bool ok = nurbs_mesh(&u, &v, Pw, out, task->room, &task->err);
    free(Pw);
    task->room -= out->n_triangles;
    return ok;
}

#define AT(member) offsetof(struct nurbs, member)
static const struct field FIELDS[] = {{"P", .kind = FIELD_POINTS, .place = AT(P)},
                                      {"Pw", FIELD_FLOATS, AT(Pw), .low = 4},
                                      {"nu", FIELD_INTEGER, AT(u.n), 0, 0, .high = 1 << 14},
                                      {"nv", FIELD_INTEGER, AT(v.n), 0, 0, .high = 1 << 14},
                                      {"uorder", FIELD_INTEGER, AT(u.order), 0, 0, .high = NURBS_MOST_ORDER},
                                      {"vorder", FIELD_INTEGER, AT(v.order), 0, 0, .high = NURBS_MOST_ORDER},
                                      {"uknots", FIELD_FLOATS, AT(u.knots), .low = 1},
                                      {"vknots", FIELD_FLOATS, AT(v.knots), .low = 1},
                                      {"u0", FIELD_NUMBER, AT(u.from), .fallback = FIELD_NONE},
                                      {"u1", FIELD_NUMBER, AT(u.to), .fallback = FIELD_NONE},
                                      {"v0", FIELD_NUMBER, AT(v.from), .fallback = FIELD_NONE},
                                      {"v1", FIELD_NUMBER, AT(v.to), .fallback = FIELD_NONE},
                                      {.name = NULL}};

const struct shape_row shape_nurbs = {.name = "nurbs", .fields = FIELDS, .size = sizeof(struct nurbs), .mesh = mesh,
                                      .may_shine = true};
