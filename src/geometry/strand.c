/* strand.c: pbrt-v3's curves as a scene file gives them.
 *
 * A curve is a row of segments with a width: a strip that turns to each ray ("flat", or "cylinder" with the normals of
 * a tube), or one that follows normals ("ribbon"). What turns to each ray is no surface on which light could go both
 * ways, so both of the former become the tube that looks as wide. u runs along each segment, v around the tube or
 * across the ribbon.
 *
 * Tests: test_curve.c.
 */
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/vec.h"
#include "geometry/mesh.h"

enum { BEZIER, BSPLINE };
enum { FLAT, RIBBON, CYLINDER };
enum { MOST_PIECES = 1024 }; /* of a segment */

struct curve_fields {
    int degree, basis, type; /* degree 2 or 3; segments of a BEZIER share their end points, a BSPLINE is uniform */
    double width[2];         /* at both ends, >= 0 */
    struct field_list P, N;  /* control points; of a ribbon the normals at the ends of segments */
};

/* How many the control points make; 0 if they are too few or too many for whole ones. */
static int segments_of(const struct curve_fields *c)
{
    if (c->P.n < c->degree + 1)
        return 0;
    if (c->basis == BSPLINE)
        return c->P.n - c->degree;
    return (c->P.n - 1) % c->degree == 0 ? (c->P.n - 1) / c->degree : 0;
}

static vec3 entry(struct field_list list, int i)
{
    return vec(list.number[3 * i], list.number[3 * i + 1], list.number[3 * i + 2]);
}

/* The Bezier points of a segment: of a B-spline its blossom at the knots around; a quadratic is a cubic, too. */
static void bezier(const struct curve_fields *c, int segment, vec3 b[4])
{
    int first = c->basis == BSPLINE ? segment : segment * c->degree;
    vec3 p[4];
    for (int i = 0; i <= c->degree; i++)
        p[i] = entry(c->P, first + i);
    if (c->basis == BSPLINE && c->degree == 3) {
        b[1] = lerp3(1.0 / 3, p[1], p[2]);
        b[2] = lerp3(2.0 / 3, p[1], p[2]);
        b[0] = lerp3(0.5, lerp3(2.0 / 3, p[0], p[1]), b[1]);
        b[3] = lerp3(0.5, b[2], lerp3(1.0 / 3, p[2], p[3]));
    } else if (c->degree == 3) {
        for (int i = 0; i < 4; i++)
            b[i] = p[i];
    } else {
        b[0] = c->basis == BSPLINE ? lerp3(0.5, p[0], p[1]) : p[0];
        b[3] = c->basis == BSPLINE ? lerp3(0.5, p[1], p[2]) : p[2];
        b[1] = lerp3(2.0 / 3, b[0], p[1]);
        b[2] = lerp3(2.0 / 3, b[3], p[1]);
    }
}

/* A ribbon's normals at both ends of a segment, and the angle between them; that of a tube is 0. */
static double ribbon_turn(const struct curve_fields *c, int segment, vec3 n[2])
{
    for (int i = 0; i < 2 && c->type == RIBBON; i++)
        n[i] = normalize(entry(c->N, segment + i));
    return c->type == RIBBON ? m_acos(fmin(fmax(dot(n[0], n[1]), 0), 1)) : 0;
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

/* A ribbon's normal, turned evenly from one end of the segment to the other. */
static vec3 ribbon_normal(const vec3 n[2], double angle, double u)
{
    if (!(angle > 1e-6))
        return n[0];
    return add(mul(n[0], m_sin((1 - u) * angle)), mul(n[1], m_sin(u * angle)));
}

/* A segment on its way into curves. The frames of its rows are as in struct net. */
struct segment {
    vec3 P[4], tangent[MOST_PIECES + 1], guide[MOST_PIECES + 1];
    double radius[2], turn;
    int pieces;
    bool ribbon;
};

/* A tube's frame is the one before, turned as little as can be. */
static void make_frames(struct segment *s, const vec3 normal[2], vec3 x)
{
    for (int i = 0; i <= s->pieces; i++) {
        double u = (double)i / s->pieces;
        curve_point(s->P, u, &s->tangent[i]);
        x = s->ribbon ? normalize(ribbon_normal(normal, s->turn, u)) : frame_from_tangent(s->tangent[i], x).s;
        s->guide[i] = x;
    }
}

/* The control points of a part: its blossom where each is at one end or at the other. */
static vec3 blossom(const vec3 P[4], double a, double b, double c)
{
    vec3 q[3], r[2];
    for (int i = 0; i < 3; i++)
        q[i] = lerp3(a, P[i], P[i + 1]);
    for (int i = 0; i < 2; i++)
        r[i] = lerp3(b, q[i], q[i + 1]);
    return lerp3(c, r[0], r[1]);
}

/* Pieces first to last - 1. */
static void add_strand(struct mesh *out, const struct segment *s, int first, int last)
{
    double u[2] = {(double)first / s->pieces, (double)last / s->pieces};
    out->strand = mem_append(out->strand, (size_t)out->n_strands, sizeof *out->strand);
    struct strand *to = &out->strand[out->n_strands++];
    memset(to, 0, sizeof *to); /* padding, too, for hash_content */
    for (int i = 0; i < 4; i++)
        to->P[i] = blossom(s->P, u[i > 2], u[i > 1], u[i > 0]);
    to->net.pieces = (int16_t)(last - first);
    to->net.ribbon = s->ribbon;
    to->net.turn = (float)(s->turn * (u[1] - u[0]));
    for (int i = 0; i < 2; i++) {
        store3(to->net.tangent[i], 0, s->tangent[i == 0 ? first : last]);
        store3(to->net.guide[i], 0, s->guide[i == 0 ? first : last]);
        to->net.radius[i] = (float)((1 - u[i]) * s->radius[0] + u[i] * s->radius[1]);
        to->net.u[i] = (float)u[i];
    }
}

/* Halve it until it is short and nearly straight: then boxes are tight, and frames are near to those at the ends. */
static void add_strands(struct mesh *out, const struct segment *s, int first, int last)
{
    bool bent = dot(s->tangent[first], s->tangent[last]) < 0.5 || dot(s->guide[first], s->guide[last]) < 0.5;
    if (last - first > 1 && (last - first > CURVE_PIECES || bent)) {
        add_strands(out, s, first, (first + last) / 2);
        add_strands(out, s, (first + last) / 2, last);
    } else {
        add_strand(out, s, first, last);
    }
}

/* A segment begins in the frame in which the curve before it ends. If there is a corner, a curve without length fills
 * the gap. */
static void join(struct mesh *out, struct segment *s)
{
    const struct net before = out->strand[out->n_strands - 1].net;
    vec3 tangent = load3(before.tangent[1], 0), guide = load3(before.guide[1], 0);
    if (length2(sub(s->tangent[0], tangent)) < 1e-12) {
        s->tangent[0] = tangent;
        s->guide[0] = guide;
        return;
    }
    add_strand(out, s, 0, 0);
    struct net *corner = &out->strand[out->n_strands - 1].net;
    corner->pieces = 1;
    store3(corner->tangent[0], 0, tangent);
    store3(corner->guide[0], 0, guide);
}

static double width_at(const struct curve_fields *c, double along)
{
    return (1 - along) * c->width[0] + along * c->width[1];
}

/* Is there memory for so many curves? */
static bool curves_fit(struct mesh_task *task, double n)
{
    const double bytes = sizeof(struct strand) + sizeof(struct curve) + 200; /* here, in the scene, in the kd-tree */
    struct error why;
    return budget_has(task->memory, bytes * n, &why) || error_set(&task->err, "%.4g parts of a curve: %s", n, why.text);
}

/* Without width it leaves the mesh empty. */
static bool make(const struct curve_fields *c, int segments, struct mesh_task *task, struct mesh *out)
{
    double widest = fmax(c->width[0], c->width[1]);
    struct segment s = {.ribbon = c->type == RIBBON};
    /* A tube of many sides is seen as wide as a round one, on average over all directions, if as long around. */
    double radius = s.ribbon ? 0.5 : PI / (2 * CURVE_SIDES * m_sin(PI / CURVE_SIDES));
    for (int i = 0; i < segments && widest > 0; i++) {
        vec3 normal[2] = {{0, 0, 0}, {0, 0, 0}}, guide = vec(0, 0, 0);
        if (i > 0)
            guide = load3(out->strand[out->n_strands - 1].net.guide[1], 0);
        bezier(c, i, s.P);
        s.turn = ribbon_turn(c, i, normal);
        s.pieces = pieces(s.P, widest, s.turn);
        for (int k = 0; k < 2; k++)
            s.radius[k] = radius * width_at(c, (double)(i + k) / segments);
        if (!curves_fit(task, (double)out->n_strands + s.pieces + 1))
            return false;
        make_frames(&s, normal, guide);
        if (i > 0)
            join(out, &s);
        add_strands(out, &s, 0, s.pieces);
    }
    return true;
}

/* What turns to each ray in pbrt-v3 is drawn as a tube, of which "cylinder" has the normals already. */
static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct curve_fields *c = fields;
    int segments = segments_of(c);
    if (segments == 0)
        return error_set(&task->err, "%d points \"P\" are no curve of degree %d: of a bezier one there are 1 + a "
                         "multiple of it, of a bspline more than it", c->P.n, c->degree);
    if (c->type == RIBBON && (c->N.number == NULL || c->N.n != segments + 1))
        return error_set(&task->err, "this ribbon needs %d normals \"N\", one at each end of a segment", segments + 1);
    if (!make(c, segments, task, out))
        return false;
    if (c->type == FLAT)
        task->warn(task, "a flat curve turns to the viewer, which no surface does: it is drawn as the tube that "
                   "looks as wide");
    return true;
}

static const char *const TYPES[] = {"flat", "ribbon", "cylinder", NULL}, *const BASES[] = {"bezier", "bspline", NULL};
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
