/* curve.c: see curve.h. */
#include "geometry/curve.h"

#include "base/frame.h"
#include "base/number.h"
#include "geometry/mesh.h"

enum { SIDES = 8, MOST_PIECES = 1024 }; /* of the tube's cross section; of a segment */

int curve_segments(const struct curve *c)
{
    if (c->n < c->degree + 1)
        return 0;
    if (c->bspline)
        return c->n - c->degree;
    return (c->n - 1) % c->degree == 0 ? (c->n - 1) / c->degree : 0;
}

static vec3 point(const struct curve *c, int i) { return vec(c->P[3 * i], c->P[3 * i + 1], c->P[3 * i + 2]); }

/* The Bezier points of a segment: of a B-spline its blossom at the knots around; a quadratic is a cubic, too. */
static void bezier(const struct curve *c, int segment, vec3 b[4])
{
    int first = c->bspline ? segment : segment * c->degree;
    vec3 p[4];
    for (int i = 0; i <= c->degree; i++)
        p[i] = point(c, first + i);
    if (c->bspline && c->degree == 3) {
        b[1] = lerp3(1.0 / 3, p[1], p[2]);
        b[2] = lerp3(2.0 / 3, p[1], p[2]);
        b[0] = lerp3(0.5, lerp3(2.0 / 3, p[0], p[1]), b[1]);
        b[3] = lerp3(0.5, b[2], lerp3(1.0 / 3, p[2], p[3]));
    } else if (c->degree == 3) {
        for (int i = 0; i < 4; i++)
            b[i] = p[i];
    } else {
        b[0] = c->bspline ? lerp3(0.5, p[0], p[1]) : p[0];
        b[3] = c->bspline ? lerp3(0.5, p[1], p[2]) : p[2];
        b[1] = lerp3(2.0 / 3, b[0], p[1]);
        b[2] = lerp3(2.0 / 3, b[3], p[1]);
    }
}

/* A point of a segment, and the unit tangent there. Where that vanishes, as at coinciding points, the chord. */
static vec3 evaluate(const vec3 b[4], double u, vec3 *tangent)
{
    vec3 q[3], r[2];
    for (int i = 0; i < 3; i++)
        q[i] = lerp3(u, b[i], b[i + 1]);
    for (int i = 0; i < 2; i++)
        r[i] = lerp3(u, q[i], q[i + 1]);
    vec3 d = sub(r[1], r[0]), chord = sub(b[3], b[0]);
    d = length2(d) > 0 ? d : chord;
    *tangent = length2(d) > 0 ? normalize(d) : vec(0, 0, 1);
    return lerp3(u, r[0], r[1]);
}

/* A ribbon's normals at both ends of a segment, and the angle between them; that of a tube is 0. */
static double ribbon_turn(const struct curve *c, int segment, vec3 n[2])
{
    for (int i = 0; i < 2 && c->N != NULL; i++) {
        const double *at = c->N + 3 * (segment + i);
        n[i] = normalize(vec(at[0], at[1], at[2]));
    }
    return c->N != NULL ? m_acos(fmin(fmax(dot(n[0], n[1]), 0), 1)) : 0;
}

/* So many straight pieces stay within a twentieth of the width. [PBRT3 3.7] Where a ribbon turns by a tenth, what is
 * seen of it lies within a thousandth of what is seen of a straight piece. */
static int pieces(const vec3 b[4], double width, double turn)
{
    double bend = 0;
    for (int i = 0; i < 2; i++)
        bend = fmax(bend, length(add(sub(b[i], mul(b[i + 1], 2)), b[i + 2])));
    double n = ceil(fmax(sqrt(sqrt(2) * 6 * bend / (8 * 0.05 * width)), turn / 0.1));
    return n >= 1 ? n < MOST_PIECES ? (int)n : MOST_PIECES : 1;
}

/* A row of the mesh around or across the curve at p, where x is a normal of it and y across both. */
static void put_row(struct mesh *m, int row, bool tube, vec3 p, vec3 x, vec3 y, double width)
{
    int n = tube ? SIDES + 1 : 2;
    /* A tube of many sides is seen as wide as a round one, on average over all directions, if as long around. */
    double radius = tube ? width * PI / (2 * SIDES * m_sin(PI / SIDES)) : width / 2;
    for (int i = 0; i < n; i++) {
        double v = (double)i / (n - 1);
        vec3 around = cylindrical(1, 2 * PI * (i % SIDES) / SIDES, 0);
        vec3 across = tube ? add(mul(x, around.x), mul(y, around.y)) : mul(y, 2 * v - 1);
        size_t k = (size_t)(row * n + i);
        store3(m->P, k, add(p, mul(across, radius)));
        store3(m->N, k, tube ? across : x);
        m->UV[2 * k + 1] = (float)v;
    }
}

/* A ribbon's normal, turned evenly from one end of the segment to the other. */
static vec3 ribbon_normal(const vec3 n[2], double angle, double u)
{
    if (!(angle > 1e-6))
        return n[0];
    return add(mul(n[0], m_sin((1 - u) * angle)), mul(n[1], m_sin(u * angle)));
}

bool curve_mesh(const struct curve *c, struct mesh *m, int most, struct error *err)
{
    int segments = curve_segments(c), columns = c->N == NULL ? SIDES + 1 : 2, row = 0;
    double widest = fmax(c->width[0], c->width[1]);
    vec3 b[4], ends[2], tangent, x = vec(0, 0, 0);
    int64_t rows = 0; /* of which a curve may have more than an int */
    for (int s = 0; s < segments; s++) {
        bezier(c, s, b);
        rows += pieces(b, widest, ribbon_turn(c, s, ends)) + 1;
    }
    if (widest == 0)
        return true;
    if (2 * rows * (columns - 1) > most)
        return error_set(err, "curves and other subdivided surfaces have more than %d triangles in all; leave some out",
                         MESH_MAX_SUBDIVIDED);
    mesh_grid(m, columns, (int)rows, true);
    for (int s = 0; s < segments; s++) {
        bezier(c, s, b);
        double turn = ribbon_turn(c, s, ends);
        int n = pieces(b, widest, turn);
        for (int i = 0; i <= n; i++) {
            double u = (double)i / n, along = (s + u) / segments;
            vec3 p = evaluate(b, u, &tangent);
            /* The tube's frame is the one before, turned as little as can be. */
            x = frame_from_tangent(tangent, c->N != NULL ? ribbon_normal(ends, turn, u) : x).s;
            for (int k = 0; k < columns; k++)
                m->UV[2 * (row * columns + k)] = (float)u;
            put_row(m, row++, c->N == NULL, p, x, cross(x, tangent), (1 - along) * c->width[0] + along * c->width[1]);
        }
    }
    return true;
}

/* --- the row ------------------------------------------------------------------------------------------ */

enum { FLAT, RIBBON, CYLINDER };
static const char *const TYPES[] = {"flat", "ribbon", "cylinder", NULL}, *const BASES[] = {"bezier", "bspline", NULL};

struct curve_fields {
    int degree, basis, type;
    double width[2];
    struct field_list P, N;
};

/* What turns to each ray in pbrt-v3 is drawn as a tube, of which "cylinder" has the normals already. */
static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct curve_fields *f = fields;
    struct curve c = {f->P.number, f->P.n, f->degree, f->basis == 1, {f->width[0], f->width[1]},
                      f->type == RIBBON ? f->N.number : NULL};
    int segments = curve_segments(&c);
    if (segments == 0)
        return error_set(&task->err, "%d points \"P\" are no curve of degree %d: of a bezier one there are 1 + a "
                         "multiple of it, of a bspline more than it", c.n, c.degree);
    if (f->type == RIBBON && (c.N == NULL || f->N.n != segments + 1))
        return error_set(&task->err, "this ribbon needs %d normals \"N\", one at each end of a segment", segments + 1);
    if (!curve_mesh(&c, out, task->room, &task->err))
        return false;
    task->room -= out->n_triangles;
    if (f->type == FLAT)
        task->warn(task, "a flat curve turns to whoever looks, which no surface does: it is drawn as the tube that "
                   "looks as wide");
    return true;
}

#define AT(member) offsetof(struct curve_fields, member)
static const struct field FIELDS[] = {{"P", .kind = FIELD_POINTS, .place = AT(P)},
                                      {"N", .kind = FIELD_NORMALS, .place = AT(N)},
                                      {"width", FIELD_NUMBER, AT(width[0]), 1, 0, .high = NUMBER_MAX},
                                      {"width", FIELD_NUMBER, AT(width[1]), 1, 0, .high = NUMBER_MAX},
                                      {"width0", FIELD_NUMBER, AT(width[0]), FIELD_KEPT, 0, .high = NUMBER_MAX},
                                      {"width1", FIELD_NUMBER, AT(width[1]), FIELD_KEPT, 0, .high = NUMBER_MAX},
                                      {"degree", FIELD_INTEGER, AT(degree), 3, 2, .high = 3},
                                      {"basis", FIELD_WORD, AT(basis), .words = BASES},
                                      {"type", FIELD_WORD, AT(type), .words = TYPES},
                                      {"splitdepth", .kind = FIELD_IGNORED},
                                      {.name = NULL}};

const struct shape_row shape_curve = {
    .name = "curve", .fields = FIELDS, .size = sizeof(struct curve_fields), .mesh = mesh};
