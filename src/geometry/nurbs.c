/* nurbs.c: non-uniform rational B-spline surfaces as triangles, as many as pbrt-v3 makes. [Piegl & Tiller 1997]
 *
 * Tests: test_curve.c.
 */
#include <stdlib.h>

#include "base/mem.h"
#include "geometry/mesh.h"

enum { MOST_ORDER = 32, DICE = 30 };

/* One of the two parameters. */
struct axis {
    int n, order;            /* control points; degree + 1, from 2 to MOST_ORDER */
    double from, to;         /* the part that is seen, knot[order - 1] <= from < to <= knot[n] */
    struct field_list knots; /* [n + order], never falling */
};

struct nurbs {
    struct axis u, v;
    struct field_list P, Pw; /* [v.n][u.n]; of Pw x y z times their weight, and that */
};

static bool is_usable(const struct axis *a)
{
    const double *knot = a->knots.number;
    if (knot == NULL || a->order < 2 || a->order > MOST_ORDER || a->n < a->order || a->knots.n != a->n + a->order)
        return false;
    for (int i = 1; i < a->n + a->order; i++)
        if (!(knot[i - 1] <= knot[i]))
            return false;
    return knot[a->order - 1] <= a->from && a->from < a->to && a->to <= knot[a->n];
}

/* The control points that count at a parameter, first to first + order - 1, and how much: values and derivatives. */
struct basis {
    int first;
    double value[MOST_ORDER], slope[MOST_ORDER];
};

/* Each order's functions from those of the order below, of which the last step gives the derivatives, too.
 * [Piegl & Tiller 1997] */
static void evaluate(const struct axis *a, double t, struct basis *out)
{
    const double *knot = a->knots.number;
    int span = a->order - 1;
    while (span < a->n - 1 && (t > knot[span + 1] || knot[span] == knot[span + 1]))
        span++;
    out->first = span - a->order + 1;
    double N[MOST_ORDER + 1] = {1};
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
static bool surface(const struct axis *u, const struct basis *bu, const struct axis *v,
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

/* With the corners' normals and parameters. */
static bool make(const struct axis *u, const struct axis *v, const double *Pw, struct mesh_task *task, struct mesh *m)
{
    struct basis bu, bv;
    vec3 p, n;
    if (!mesh_take_room(task, 2 * (DICE - 1) * (DICE - 1)))
        return false;
    mesh_grid(m, DICE, DICE, true);
    for (int i = 0; i < DICE * DICE; i++) {
        double s = (i % DICE) / (DICE - 1.0), t = (i / DICE) / (DICE - 1.0);
        s = (1 - s) * u->from + s * u->to;
        t = (1 - t) * v->from + t * v->to;
        evaluate(u, s, &bu);
        evaluate(v, t, &bv);
        if (!surface(u, &bu, v, &bv, Pw, &p, &n))
            return error_set(&task->err, "these weights leave no point at (u,v) = (%g,%g)", s, t);
        store3(m->P, (size_t)i, p);
        store3(m->N, (size_t)i, n);
        m->UV[2 * i] = (float)s;
        m->UV[2 * i + 1] = (float)t;
    }
    return true;
}

/* An axis of which all that may be seen is, unless its ends are given. */
static bool read_axis(const struct axis *given, char name, struct mesh_task *task, struct axis *out)
{
    *out = *given;
    if (out->from == FIELD_NONE && out->order > 0 && out->order <= out->knots.n)
        out->from = out->knots.number[out->order - 1];
    if (out->to == FIELD_NONE && out->n < out->knots.n)
        out->to = out->knots.number[out->n];
    return is_usable(out) ||
           error_set(&task->err, "a nurbs needs \"%corder\" from 2 to %d, \"n%c\" not less than that, as many numbers "
                     "as both together in \"%cknots\" that never fall, and \"%c0\" < \"%c1\" within the inner ones",
                     name, MOST_ORDER, name, name, name, name);
}

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct nurbs *f = fields;
    struct axis u, v;
    if (!read_axis(&f->u, 'u', task, &u) || !read_axis(&f->v, 'v', task, &v))
        return false;
    int n = f->P.number != NULL ? f->P.n : f->Pw.n;
    if (n != u.n * v.n)
        return error_set(&task->err, "a nurbs needs nu nv = %d points \"P\" or \"Pw\", not %d", u.n * v.n, n);
    double *Pw = mem_alloc((size_t)n, 4 * sizeof *Pw);
    for (int i = 0; i < 4 * n; i++)
        Pw[i] = f->P.number == NULL ? f->Pw.number[i] : i % 4 == 3 ? 1 : f->P.number[i / 4 * 3 + i % 4];
    bool ok = make(&u, &v, Pw, task, out);
    free(Pw);
    return ok;
}

#define AT(member) offsetof(struct nurbs, member)
static const struct field FIELDS[] = {{"P", .kind = FIELD_POINTS, .place = AT(P)},
                                      {"Pw", FIELD_FLOATS, AT(Pw), .low = 4},
                                      {"nu", FIELD_INTEGER, AT(u.n), 0, 0, .high = 1 << 14},
                                      {"nv", FIELD_INTEGER, AT(v.n), 0, 0, .high = 1 << 14},
                                      {"uorder", FIELD_INTEGER, AT(u.order), 0, 0, .high = MOST_ORDER},
                                      {"vorder", FIELD_INTEGER, AT(v.order), 0, 0, .high = MOST_ORDER},
                                      {"uknots", FIELD_FLOATS, AT(u.knots), .low = 1},
                                      {"vknots", FIELD_FLOATS, AT(v.knots), .low = 1},
                                      {"u0", FIELD_NUMBER, AT(u.from), .fallback = FIELD_NONE},
                                      {"u1", FIELD_NUMBER, AT(u.to), .fallback = FIELD_NONE},
                                      {"v0", FIELD_NUMBER, AT(v.from), .fallback = FIELD_NONE},
                                      {"v1", FIELD_NUMBER, AT(v.to), .fallback = FIELD_NONE},
                                      {.name = NULL}};

const struct shape_row shape_nurbs = {.name = "nurbs", .fields = FIELDS, .size = sizeof(struct nurbs), .mesh = mesh,
                                      .may_shine = true};
